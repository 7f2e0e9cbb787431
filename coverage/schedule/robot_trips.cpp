#include "coverage/schedule/robot_trips.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kRounding = 1e-9;

/// What a rendezvous asks of the robot.
struct Stop {
  Vec3 site_m = Vec3::Zero();
  Vec3 end_m = Vec3::Zero();  ///< where the robot is afterwards
  double carry_s = 0.0;
  double charged = 0.0;       ///< given to the aircraft
  double from_last_s = 0.0;   ///< drive
  double from_depot_s = 0.0;  ///< drive
  double home_s = 0.0;        ///< drive
};

/// What changes at a rendezvous when the robot comes from the depot.
struct Change {
  double arrives_late_s = 0.0;
  double waits_s = 0.0;  ///< the aircraft, besides
  double drained = 0.0;  ///< of the aircraft's battery meanwhile
  double delay_s = kNever;
};

class Trips {
 public:
  Trips(const Task& task, const FlightModel& model, Plan& plan)
      : task_(task), robot_(task.charger.battery), model_(model), plan_(plan) {
    depot_m_ = model.ground(task.charger.start_m);
    Vec3 at_m = depot_m_;
    for (const Rendezvous& meeting : plan.rendezvous) {
      Stop stop;
      stop.site_m = meeting.site_m;
      stop.end_m = meeting.carry ? meeting.carry_to_m : meeting.site_m;
      stop.carry_s = meeting.carry ? drive_s(task.charger, stop.site_m, stop.end_m) : 0.0;
      stop.charged = std::max(0.0, meeting.charge_to - meeting.energy_from);
      stop.from_last_s = drive_s(task.charger, at_m, stop.site_m);
      stop.from_depot_s = drive_s(task.charger, depot_m_, stop.site_m);
      stop.home_s = drive_s(task.charger, stop.end_m, depot_m_);
      at_m = stop.end_m;
      stops_.push_back(stop);
    }
    for (std::size_t i = 0; i < stops_.size(); ++i) changes_.push_back(change_before(i));
  }

  Status run();

 private:
  Change change_before(std::size_t i) const;
  double used(std::size_t first, std::size_t last) const;
  void apply(const std::vector<std::size_t>& fetches);
  std::vector<Vec3> bends(const Vec3& from_m, const Vec3& to_m) const;

  const Task& task_;
  const RobotBattery& robot_;
  const FlightModel& model_;
  Plan& plan_;
  Vec3 depot_m_ = Vec3::Zero();
  std::vector<Stop> stops_;
  std::vector<Change> changes_;
};

/// The first begins at the depot anyway.
Change Trips::change_before(std::size_t i) const {
  if (i == 0) return {0.0, 0.0, 0.0, 0.0};
  Change out;
  const Rendezvous& meeting = plan_.rendezvous[i];
  const double arrives_s =
      plan_.rendezvous[i - 1].depart_s + stops_[i - 1].home_s + robot_.refill_s + stops_[i].from_depot_s;
  if (!std::isfinite(arrives_s)) return out;
  out.arrives_late_s = std::max(0.0, arrives_s - meeting.robot_arrives_s);
  out.waits_s = std::max(meeting.land_s, arrives_s) - std::max(meeting.land_s, meeting.robot_arrives_s);
  out.waits_s = std::max(0.0, out.waits_s);
  out.drained = task_.battery.model.landed_per_s * out.waits_s;
  const double held = meeting.energy_from - out.drained;
  if (held < task_.battery.reserve) return out;
  const ChargingCurve charging = task_.battery.charging();
  const double needs = std::max(meeting.charge_to, held);
  const double before_s =
      std::max(stops_[i].carry_s, charging.seconds(meeting.energy_from, meeting.charge_to));
  const double after_s = std::max(stops_[i].carry_s, charging.seconds(held, needs));
  out.delay_s = out.waits_s + after_s - before_s;
  return out;
}

/// From the depot to rendezvous `first`, on to the one before `last`, and home.
double Trips::used(std::size_t first, std::size_t last) const {
  double driven_s = stops_[first].from_depot_s + stops_[last - 1].home_s;
  double given = changes_[first].drained;
  for (std::size_t i = first; i < last; ++i) {
    driven_s += stops_[i].carry_s + (i > first ? stops_[i].from_last_s : 0.0);
    given += stops_[i].charged;
  }
  return robot_.drive_per_s * driven_s + robot_.per_charged * given;
}

/// The least delay with new energy before each rendezvous, over the one before which it was fetched last.
Status Trips::run() {
  const std::size_t count = stops_.size();
  std::vector<double> least(count + 1, kNever);
  std::vector<std::size_t> before(count + 1, 0);
  least[0] = 0.0;
  for (std::size_t last = 1; last <= count; ++last) {
    for (std::size_t first = 0; first < last; ++first) {
      if (!(least[first] < kNever) || used(first, last) > robot_.capacity + kRounding) continue;
      const double delay_s = least[first] + (last < count ? changes_[last].delay_s : 0.0);
      if (delay_s >= least[last]) continue;
      least[last] = delay_s;
      before[last] = first;
    }
  }
  if (!(least[count] < kNever)) {
    for (std::size_t i = 0; i < count; ++i) {
      // Alone, whatever it costs the aircraft to wait.
      const double needs = used(i, i + 1) - robot_.per_charged * changes_[i].drained;
      if (needs <= robot_.capacity + kRounding) continue;
      return infeasible("The ground robot's battery holds " + std::to_string(robot_.capacity) +
                        " units; the rendezvous at " + place_text(stops_[i].site_m.head<2>()) +
                        " and the way there and back take " + std::to_string(needs) + ".");
    }
    return infeasible(
        "The ground robot's battery does not last, and while it fetches new energy the aircraft would have "
        "to "
        "wait on the ground beyond its reserve.");
  }
  std::vector<std::size_t> fetches;
  for (std::size_t at = before[count]; at > 0; at = before[at]) fetches.push_back(at);
  std::reverse(fetches.begin(), fetches.end());
  apply(fetches);
  return {};
}

std::vector<Vec3> Trips::bends(const Vec3& from_m, const Vec3& to_m) const {
  std::vector<Vec3> out;
  if (!task_.charger.travel) return out;
  for (const Vec2& p : task_.charger.travel->bends(from_m.head<2>(), to_m.head<2>()))
    out.push_back(model_.ground(Vec3(p.x(), p.y(), 0.0)));
  return out;
}

void Trips::apply(const std::vector<std::size_t>& fetches) {
  double shift_s = 0.0;
  auto next = fetches.begin();
  std::size_t leg = 0;
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    Rendezvous& meeting = plan_.rendezvous[i];
    for (; leg < plan_.legs.size() && leg < legs_before(meeting.id); ++leg) {
      plan_.legs[leg].start_s += shift_s;
      plan_.legs[leg].end_s += shift_s;
    }
    const double free_s = i > 0 ? plan_.rendezvous[i - 1].depart_s : 0.0;
    meeting.land_s += shift_s;
    meeting.arrive_by_s += shift_s;
    meeting.robot_arrives_s += shift_s;
    if (next != fetches.end() && *next == i) {
      const Change& change = changes_[i];
      const Vec3& last_m = stops_[i - 1].end_m;
      plan_.depot_visits.push_back({i, free_s + stops_[i - 1].home_s,
                                    free_s + stops_[i - 1].home_s + robot_.refill_s,
                                    bends(last_m, depot_m_)});
      meeting.robot_bends_m = bends(depot_m_, meeting.site_m);
      meeting.robot_arrives_s += change.arrives_late_s;
      meeting.wait_s += change.waits_s;
      plan_.wait_s += change.waits_s;
      const bool was_charged = meeting.charge_to > meeting.energy_from + kRounding;
      meeting.energy_from -= change.drained;
      if (!was_charged && meeting.charge_to > meeting.energy_from + kRounding) ++plan_.recharges;
      plan_.energy_min = std::min(plan_.energy_min, meeting.energy_from);
      shift_s += change.delay_s;
      ++next;
    }
    meeting.depart_s += shift_s;
  }
  for (; leg < plan_.legs.size(); ++leg) {
    plan_.legs[leg].start_s += shift_s;
    plan_.legs[leg].end_s += shift_s;
  }
  plan_.makespan_s += shift_s;
  plan_.cost = plan_.makespan_s;
  plan_.home_bends_m = bends(stops_.back().end_m, depot_m_);
  plan_.robot_home_s = plan_.rendezvous.back().depart_s + stops_.back().home_s;
}

}  // namespace

Status limit_robot(const Task& task, const FlightModel& model, Plan& plan) {
  if (!std::isfinite(task.charger.battery.capacity) || plan.rendezvous.empty()) return {};
  return Trips(task, model, plan).run();
}

}  // namespace swallowtail::coverage
