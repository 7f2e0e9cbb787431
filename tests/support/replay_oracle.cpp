#include "tests/support/replay_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "tests/support/replay_cover.hpp"

namespace swallowtail::test_support {
namespace {

using coverage::Leg;
using coverage::Rendezvous;
using coverage::Transfer;

constexpr double kPlace_m = 1e-3;
constexpr double kSlack = 1e-6;
constexpr double kRobotEnergy = 0.01;  ///< its ways are added up in single precision

double flat(const Vec3& a, const Vec3& b) { return std::hypot(a.x() - b.x(), a.y() - b.y()); }

class Replay {
 public:
  Replay(const coverage::Task& task, const coverage::Plan& plan, const ReplayQuestion& question)
      : task_(task),
        plan_(plan),
        question_(question),
        flight_(task, question.step_s),
        robot_(task, question.robot, question.ground_m) {}

  ReplayVerdict run() {
    check_order();
    if (plan_.legs.empty()) {
      fail("there is no leg");
      return verdict_;
    }
    fly_all();
    check_totals();
    for (std::string& fault : faults_of_cover(task_, plan_, question_, verdict_.covered_share))
      fail(std::move(fault));
    verdict_.least_energy = flight_.least_energy;
    return verdict_;
  }

 private:
  void fail(std::string what) { verdict_.faults.push_back(std::move(what)); }
  void claim(const std::string& what, double said, double found, double tolerance) {
    if (std::abs(said - found) <= tolerance) return;
    char text[160];
    std::snprintf(text, sizeof text, ": the plan says %.9g, the replay finds %.9g", said, found);
    fail(what + text);
  }
  void at_least(const std::string& what, double value, double least) {
    if (value >= least - kSlack) return;
    char text[120];
    std::snprintf(text, sizeof text, ": %.9g, at least %.9g is needed", value, least);
    fail(what + text);
  }

  void check_order();
  void fly_all();
  void take_off();
  void fly_leg(std::size_t i);
  void land(const std::string& name);
  void fly_way(std::vector<Vec3> way, double ends_m);
  std::vector<Vec3> way_to_next(std::size_t i) const;
  const Rendezvous* meeting(std::uint32_t id);
  void meet(std::uint32_t id, const Vec3& below);
  void visit_depot(const std::string& name);
  void drive_robot_home();
  void transfer(std::size_t i);
  void check_totals();

  const coverage::Task& task_;
  const coverage::Plan& plan_;
  const ReplayQuestion& question_;
  ReplayFlight flight_;
  ReplayRobot robot_;
  ReplayVerdict verdict_;
  double took_off_with_ = 0.0;
  double used_ = 0.0;
  double waited_s_ = 0.0;
  double least_landed_ = 0.0;
  int recharges_ = 0;
  std::size_t meetings_ = 0;
  std::size_t visits_ = 0;
};

/// Every sub-cell once, from one end to the other.
void Replay::check_order() {
  std::map<std::uint32_t, int> flown;
  for (const Leg& leg : plan_.legs) ++flown[leg.sub_cell_id];
  for (const coverage::SubCell& cell : plan_.sub_cells) {
    if (flown[cell.id] != 1) fail("sub-cell " + std::to_string(cell.id) + " is not flown once");
    for (const Leg& leg : plan_.legs) {
      if (leg.sub_cell_id != cell.id) continue;
      const bool forth = (leg.entry_m - cell.alpha_m).norm() + (leg.exit_m - cell.beta_m).norm() < kPlace_m;
      const bool back = (leg.entry_m - cell.beta_m).norm() + (leg.exit_m - cell.alpha_m).norm() < kPlace_m;
      if (!forth && !back) fail("sub-cell " + std::to_string(cell.id) + " is not flown from end to end");
    }
  }
  if (flown.size() != plan_.sub_cells.size()) fail("there are legs of no sub-cell");
}

void Replay::take_off() { took_off_with_ = flight_.energy; }

void Replay::land(const std::string& name) {
  flight_.land(question_.ground_m(flight_.at_m.x(), flight_.at_m.y()));
  const double used = took_off_with_ - flight_.energy;
  used_ += used;
  least_landed_ = std::min(least_landed_, flight_.energy);
  at_least(name + ", energy on landing", flight_.energy + question_.energy_tolerance,
           task_.battery.reserve + used * question_.energy_margin + question_.energy_spare);
}

/// Up to the way's altitude, along it, not down at its end.
void Replay::fly_way(std::vector<Vec3> way, double ends_m) {
  const double altitude = altitude_over(way, ends_m, task_, question_.ground_m);
  for (Vec3& place : way) flight_.fly_to({place.x(), place.y(), altitude});
  for (std::string& fault : faults_of_way(task_, way)) fail(std::move(fault));
}

std::vector<Vec3> Replay::way_to_next(std::size_t i) const {
  std::vector<Vec3> out{plan_.legs[i].exit_m};
  out.insert(out.end(), plan_.legs[i].transfer_m.begin(), plan_.legs[i].transfer_m.end());
  out.push_back(plan_.legs[i + 1].entry_m);
  return out;
}

void Replay::fly_leg(std::size_t i) {
  const Leg& leg = plan_.legs[i];
  const std::string name = "leg " + std::to_string(i);
  flight_.fly_to(leg.entry_m);
  // A stop to turn into the leg belongs to the transfer before: it is found by flying a hair's breadth of it.
  const ReplayFlight before = flight_;
  flight_.fly_to(leg.exit_m);
  const double length = (leg.exit_m - leg.entry_m).norm();
  const double cover_s = length / task_.vehicle.cruise_speed_mps;
  const double stop_s = flight_.time_s - before.time_s - cover_s;
  claim(name + " start", leg.start_s, before.time_s + stop_s, question_.time_tolerance_s);
  claim(name + " end", leg.end_s, flight_.time_s, question_.time_tolerance_s);
  const double stop_energy = stop_s * power_of(task_, Vec3::Zero(), leg.entry_m.z());
  claim(name + " energy before", leg.energy_before, before.energy - stop_energy, question_.energy_tolerance);
  claim(name + " energy after", leg.energy_after, flight_.energy, question_.energy_tolerance);
}

const Rendezvous* Replay::meeting(std::uint32_t id) {
  if (meetings_ >= plan_.rendezvous.size() || plan_.rendezvous[meetings_].id != id) {
    fail("rendezvous " + std::to_string(id) + " is asked for by a transfer, and not there");
    return nullptr;
  }
  return &plan_.rendezvous[meetings_++];
}

/// Landed at the meeting: docked, charged, carried, ready.
void Replay::meet(std::uint32_t id, const Vec3& below) {
  const Rendezvous* found = meeting(id);
  if (found == nullptr) return;
  const Rendezvous& r = *found;
  const std::string name = "rendezvous " + std::to_string(id);
  const double ground = question_.ground_m(below.x(), below.y());
  if ((r.site_m - Vec3(below.x(), below.y(), ground)).norm() > kPlace_m)
    fail(name + " is not on the ground below its leg's end");
  land(name);
  claim(name + " landing", r.land_s, flight_.time_s, question_.time_tolerance_s);
  visit_depot(name);
  const double arrives = robot_.free_s + robot_.drive_to(r.robot_bends_m, r.site_m, verdict_.faults);
  at_least(name + ", robot's arrival", r.robot_arrives_s, arrives - question_.time_tolerance_s);
  robot_.tell(question_.watch_robot, r.robot_arrives_s);
  const double wait = std::max(0.0, r.robot_arrives_s - flight_.time_s);
  claim(name + " waiting", r.wait_s, wait, question_.time_tolerance_s);
  const double docked = flight_.time_s + wait + task_.charger.landing_s;
  const double held = flight_.energy - task_.battery.model.landed_per_s * (wait + task_.charger.landing_s);
  at_least(name + ", energy when docked", held + question_.energy_tolerance, task_.battery.reserve);
  least_landed_ = std::min(least_landed_, held);
  claim(name + " energy from", r.energy_from, held, question_.energy_tolerance);
  at_least(name + ", charge", r.charge_to, held - question_.energy_tolerance);
  at_least(name + ", capacity", task_.battery.capacity, r.charge_to);
  const bool is_limited = std::isfinite(task_.charger.battery.capacity);
  if (is_limited) claim(name + " robot's energy", r.robot_energy, robot_.held, kRobotEnergy);
  robot_.give(std::max(0.0, r.charge_to - held));
  if (r.charge_to > r.energy_from + 1e-9) ++recharges_;
  double together = charging_s(task_, held, r.charge_to);
  if (r.carry) {
    const double carry_s = robot_.drive_to(r.carry_bends_m, r.carry_to_m, verdict_.faults);
    robot_.tell(question_.watch_robot, docked + carry_s);
    together = std::max(together, carry_s);
  }
  if (is_limited) claim(name + " robot's energy left", r.robot_energy_left, robot_.held, kRobotEnergy);
  at_least(name + ", departure", r.depart_s + question_.time_tolerance_s * 2.0,
           docked + together + task_.charger.take_off_s + question_.lead_s);
  robot_.free_s = r.depart_s;
  waited_s_ += wait;
  const Vec3 from = r.carry ? r.carry_to_m : r.site_m;
  flight_.stand_at(from, r.depart_s, r.charge_to);
  take_off();
}

/// Before the meeting just found, if the plan says so.
void Replay::visit_depot(const std::string& name) {
  const bool visits =
      visits_ < plan_.depot_visits.size() && plan_.depot_visits[visits_].before + 1 == meetings_;
  if (visits != plan_.rendezvous[meetings_ - 1].by_depot)
    fail(name + ": the robot comes by its depot, or does not, and the plan says otherwise");
  if (!visits) return;
  const coverage::DepotVisit& visit = plan_.depot_visits[visits_++];
  const double there_s =
      robot_.free_s + robot_.drive_to(visit.bends_m, task_.charger.start_m, verdict_.faults);
  at_least(name + ", the robot's energy when back at its depot", robot_.held + kSlack,
           task_.charger.battery.reserve);
  at_least(name + ", the robot's arrival at its depot", visit.arrives_s,
           there_s - question_.time_tolerance_s);
  robot_.tell(question_.watch_robot, visit.arrives_s);
  at_least(name + ", the robot's departure from its depot", visit.leaves_s,
           there_s + task_.charger.battery.refill_s - question_.time_tolerance_s);
  robot_.free_s = visit.leaves_s;
  robot_.held = task_.charger.battery.capacity;
}

void Replay::drive_robot_home() {
  if (visits_ != plan_.depot_visits.size()) fail("the robot visits its depot before no rendezvous");
  const bool may_stay = std::isinf(task_.charger.battery.capacity) && plan_.robot_home_s == 0.0;
  if (may_stay || plan_.rendezvous.empty()) return;
  const double home_s =
      robot_.free_s + robot_.drive_to(plan_.home_bends_m, task_.charger.start_m, verdict_.faults);
  at_least("the robot's energy when it is home", robot_.held + kSlack, task_.charger.battery.reserve);
  at_least("the robot's arrival at home", plan_.robot_home_s, home_s - question_.time_tolerance_s);
  robot_.tell(question_.watch_robot, plan_.robot_home_s);
}

void Replay::transfer(std::size_t i) {
  const Leg& leg = plan_.legs[i];
  const Leg& next = plan_.legs[i + 1];
  const auto id = static_cast<std::uint32_t>(2 * i + 1);
  const std::vector<Vec3> way = way_to_next(i);
  const double higher = std::max(leg.exit_m.z(), next.entry_m.z());
  if (leg.field_id == next.field_id && leg.transfer != Transfer::kFDTU) {
    for (std::string& fault : faults_of_way_inside(task_, way)) fail(std::move(fault));
  }
  switch (leg.transfer) {
    case Transfer::kFF:
      fly_way(way, higher);
      break;
    case Transfer::kFFDU:
      fly_way(way, higher);
      meet(id + 1, next.entry_m);
      break;
    case Transfer::kFDUF:
      meet(id, leg.exit_m);
      fly_way(way, next.entry_m.z());
      break;
    case Transfer::kFDUFDU:
      meet(id, leg.exit_m);
      fly_way(way, next.entry_m.z());
      meet(id + 1, next.entry_m);
      break;
    case Transfer::kFDTU:
      meet(id, leg.exit_m);
      if (flat(flight_.at_m, next.entry_m) > kPlace_m)
        fail("rendezvous " + std::to_string(id) + " does not carry to the next leg");
      break;
    case Transfer::kEnd:
      fail("leg " + std::to_string(i) + " ends the plan, and is not the last");
      break;
  }
}

void Replay::fly_all() {
  const double ground = question_.ground_m(task_.start_m.x(), task_.start_m.y());
  flight_.watch = question_.watch;
  flight_.stand_at({task_.start_m.x(), task_.start_m.y(), ground}, question_.take_off_s,
                   task_.battery.capacity);
  flight_.least_energy = task_.battery.capacity;
  least_landed_ = task_.battery.capacity;
  take_off();
  std::vector<Vec3> approach{flight_.at_m};
  approach.insert(approach.end(), plan_.approach_m.begin(), plan_.approach_m.end());
  approach.push_back(plan_.legs.front().entry_m);
  if (flat(flight_.at_m, plan_.legs.front().entry_m) > kPlace_m)
    fly_way(std::move(approach), plan_.legs.front().entry_m.z());
  for (std::size_t i = 0; i < plan_.legs.size(); ++i) {
    fly_leg(i);
    if (i + 1 < plan_.legs.size()) transfer(i);
  }
  if (plan_.legs.back().transfer != Transfer::kEnd) fail("the last leg does not end the plan");
  land("the last landing");
  verdict_.end_s = flight_.time_s;
  drive_robot_home();
  if (meetings_ != plan_.rendezvous.size()) fail("there are rendezvous that no transfer asks for");
  at_least("the least energy aloft", flight_.least_energy + question_.energy_tolerance,
           task_.battery.reserve);
}

void Replay::check_totals() {
  const auto parts = static_cast<double>(plan_.rendezvous.size() + 1);
  const double time = question_.time_tolerance_s * parts;
  const double energy = question_.energy_tolerance * parts;
  claim("the makespan", plan_.makespan_s, verdict_.end_s, time);
  claim("the cost", plan_.cost, verdict_.end_s, time);
  claim("the time in flight", plan_.flight_s, flight_.flown_s, time);
  claim("the length of flight", plan_.flight_m, flight_.flown_m, time * task_.vehicle.cruise_speed_mps);
  claim("the energy used", plan_.energy_used, used_, energy);
  claim("the least energy on landing", plan_.energy_min, least_landed_, energy);
  claim("the waiting time", plan_.wait_s, waited_s_, time);
  claim("the number of recharges", plan_.recharges, recharges_, 0.0);
  const bool is_whole = std::ranges::all_of(plan_.fields, [](const coverage::FieldReport& field) {
    return field.status == coverage::FieldStatus::kPlanned;
  });
  if (is_whole != (plan_.status == coverage::PlanStatus::kComplete))
    fail("the plan says that it is complete, or that it is not, and its fields say otherwise");
}

}  // namespace

ReplayVerdict replay(const coverage::Task& task, const coverage::Plan& plan, const ReplayQuestion& question) {
  return Replay(task, plan, question).run();
}

}  // namespace swallowtail::test_support
