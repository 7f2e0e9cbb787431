#include "tests/property/coverage/validate_schedule.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace swallowtail::coverage::test {
namespace {

constexpr double kSmall = 1e-6;

class Judge {
 public:
  Judge(const Plan& plan, const Task& task, double lead_s) : plan_(plan), task_(task), lead_s_(lead_s) {}

  std::vector<std::string> judge() {
    check_sub_cells();
    check_flight_times();
    check_meetings();
    check_robot();
    return faults_;
  }

 private:
  void expect(bool good, const std::string& what) {
    if (!good) faults_.push_back(what);
  }
  static double flat(const Vec3& a, const Vec3& b) { return std::hypot(a.x() - b.x(), a.y() - b.y()); }

  void check_sub_cells() {
    std::map<std::uint32_t, int> flown;
    for (const Leg& leg : plan_.legs) {
      ++flown[leg.sub_cell_id];
      const auto cell = std::find_if(plan_.sub_cells.begin(), plan_.sub_cells.end(),
                                     [&](const SubCell& c) { return c.id == leg.sub_cell_id; });
      if (cell == plan_.sub_cells.end()) {
        expect(false, "a leg of no sub-cell");
        continue;
      }
      const bool forth = leg.entry_m == cell->alpha_m && leg.exit_m == cell->beta_m;
      const bool back = leg.entry_m == cell->beta_m && leg.exit_m == cell->alpha_m;
      expect(forth || back, "leg " + std::to_string(leg.sub_cell_id) + " does not run along its sub-cell");
    }
    expect(flown.size() == plan_.sub_cells.size(), "not every sub-cell is flown");
    for (const auto& [id, times] : flown)
      expect(times == 1, "sub-cell " + std::to_string(id) + " is flown " + std::to_string(times) + " times");
  }

  void check_flight_times() {
    const double speed = task_.vehicle.cruise_speed_mps;
    for (std::size_t i = 0; i < plan_.legs.size(); ++i) {
      const Leg& leg = plan_.legs[i];
      expect(leg.end_s - leg.start_s >= (leg.exit_m - leg.entry_m).norm() / speed - kSmall,
             "leg " + std::to_string(i) + " is too fast");
      expect(leg.energy_after >= task_.battery.reserve,
             "leg " + std::to_string(i) + " ends below the reserve");
      if (i + 1 == plan_.legs.size()) {
        expect(leg.transfer == Transfer::kEnd, "the last leg does not end");
        continue;
      }
      const Leg& next = plan_.legs[i + 1];
      if (leg.transfer == Transfer::kFDTU) continue;
      expect(next.start_s - leg.end_s >= flat(leg.exit_m, next.entry_m) / speed - kSmall,
             "transfer " + std::to_string(i) + " is too fast");
      if (leg.transfer == Transfer::kFF) {
        expect(std::abs((leg.energy_after - next.energy_before) - (next.start_s - leg.end_s)) < 1e-6,
               "energy and time of hop " + std::to_string(i) + " differ");
      }
    }
  }

  /// Which meetings the legs' transfers ask for.
  std::vector<std::uint32_t> wanted_ids() const {
    std::vector<std::uint32_t> out;
    for (std::size_t i = 0; i < plan_.legs.size(); ++i) {
      const Transfer t = plan_.legs[i].transfer;
      const auto id = static_cast<std::uint32_t>(2 * i + 1);
      if (t == Transfer::kFDUF || t == Transfer::kFDUFDU || t == Transfer::kFDTU) out.push_back(id);
      if (t == Transfer::kFFDU || t == Transfer::kFDUFDU) out.push_back(id + 1);
    }
    return out;
  }

  void check_meetings() {
    std::vector<std::uint32_t> ids;
    for (const Rendezvous& r : plan_.rendezvous) ids.push_back(r.id);
    expect(ids == wanted_ids(), "rendezvous and transfers do not agree");
    double energy = task_.battery.capacity;
    double left_s = 0.0;
    for (const Rendezvous& r : plan_.rendezvous) {
      const std::string name = "rendezvous " + std::to_string(r.id);
      expect(std::abs(energy - (r.land_s - left_s) - r.energy_from) < 1e-6,
             name + ": energy on landing is not what the flight leaves");
      expect(r.energy_from >= task_.battery.reserve - kSmall, name + " is reached below the reserve");
      expect(r.charge_to <= task_.battery.capacity + kSmall && r.charge_to >= r.energy_from - kSmall,
             name + " charges out of range");
      // The leg before it.
      const auto leg = static_cast<std::size_t>((r.id - 1) / 2);
      const Vec3& above = r.id % 2 == 1 ? plan_.legs.at(leg).exit_m : plan_.legs.at(leg + 1).entry_m;
      expect(flat(above, r.site_m) < kSmall, name + " is not below its leg's end");
      if (r.carry)
        expect(flat(plan_.legs.at(leg + 1).entry_m, r.carry_to_m) < kSmall, name + " carries elsewhere");
      energy = r.charge_to;
      left_s = r.depart_s;
    }
    const double last_down = plan_.makespan_s;
    expect(energy - (last_down - left_s) >= task_.battery.reserve - kSmall,
           "the last landing is below the reserve");
  }

  void check_robot() {
    Vec3 at = task_.charger.start_m;
    double free_s = 0.0;
    for (const Rendezvous& r : plan_.rendezvous) {
      const std::string name = "rendezvous " + std::to_string(r.id);
      expect(r.robot_arrives_s - free_s >= flat(at, r.site_m) / task_.charger.speed_mps - kSmall,
             name + ": the robot is faster than it drives");
      const double docked = std::max(r.robot_arrives_s, r.land_s) + task_.charger.landing_s;
      const double drive = r.carry ? flat(r.site_m, r.carry_to_m) / task_.charger.speed_mps : 0.0;
      const double charging = (r.charge_to - r.energy_from) * task_.battery.charge_s_per_unit;
      expect(r.depart_s - docked >= std::max(drive, charging) + task_.charger.take_off_s + lead_s_ - 1e-5,
             name + " is left too early");
      expect(std::abs(r.wait_s - std::max(0.0, r.robot_arrives_s - r.land_s)) < kSmall,
             name + ": waiting is wrong");
      at = r.carry ? r.carry_to_m : r.site_m;
      free_s = r.depart_s;
    }
  }

  const Plan& plan_;
  const Task& task_;
  double lead_s_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> faults_of(const Plan& plan, const Task& task, double lead_s) {
  return Judge(plan, task, lead_s).judge();
}

}  // namespace swallowtail::coverage::test
