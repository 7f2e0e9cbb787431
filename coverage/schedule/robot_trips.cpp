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

std::vector<Stop> stops_of(const Task& task, const RobotStart& start, const Vec3& depot_m,
                           std::span<const Rendezvous> meetings) {
  std::vector<Stop> out;
  Vec3 at_m = start.at_m;
  for (const Rendezvous& meeting : meetings) {
    const double held = out.empty() && start.aircraft_energy ? *start.aircraft_energy : meeting.energy_from;
    Stop stop;
    stop.end_m = meeting.carry ? meeting.carry_to_m : meeting.site_m;
    stop.carry_s = meeting.carry ? drive_s(task.charger, meeting.site_m, stop.end_m) : 0.0;
    stop.charged = std::max(0.0, meeting.charge_to - held);
    stop.from_last_s = drive_s(task.charger, at_m, meeting.site_m);
    stop.from_depot_s = drive_s(task.charger, depot_m, meeting.site_m);
    stop.home_s = drive_s(task.charger, stop.end_m, depot_m);
    at_m = stop.end_m;
    out.push_back(stop);
  }
  return out;
}

class Trips {
 public:
  Trips(const Task& task, const FlightModel& model, const RobotStart& start, std::span<Leg> legs,
        std::span<Rendezvous> meetings)
      : task_(task),
        robot_(task.charger.battery),
        model_(model),
        start_(start),
        legs_(legs),
        meetings_(meetings),
        depot_m_(model.ground(task.charger.start_m)),
        stops_(stops_of(task, start, depot_m_, meetings)) {
    start_home_s_ = drive_s(task.charger, start.at_m, depot_m_);
    for (std::size_t i = 0; i < stops_.size(); ++i) changes_.push_back(change_before(i));
  }

  Status choose();
  void choose_late();
  RobotTrips apply();

 private:
  Change change_before(std::size_t i) const;
  double use(std::size_t i, double drive_s) const;
  Error why_none() const;
  std::vector<Vec3> bends(const Vec3& from_m, const Vec3& to_m) const;
  double shift_to(std::size_t i, bool fetches, double shift_s, RobotTrips& out);

  const Task& task_;
  const RobotBattery& robot_;
  const FlightModel& model_;
  const RobotStart& start_;
  std::span<Leg> legs_;
  std::span<Rendezvous> meetings_;
  Vec3 depot_m_;
  std::vector<Stop> stops_;
  std::vector<Change> changes_;
  double start_home_s_ = 0.0;
  std::vector<bool> fetches_;  ///< before which
};

Change Trips::change_before(std::size_t i) const {
  Change out;
  const Rendezvous& meeting = meetings_[i];
  const double free_s = i == 0 ? start_.free_s : meetings_[i - 1].depart_s;
  const double home_s = i == 0 ? start_home_s_ : stops_[i - 1].home_s;
  const double arrives_s = free_s + home_s + robot_.refill_s + stops_[i].from_depot_s;
  if (!std::isfinite(arrives_s) || (i == 0 && start_.has_aircraft)) return out;
  out.arrives_late_s = std::max(0.0, arrives_s - meeting.robot_arrives_s);
  out.waits_s = std::max(meeting.land_s, arrives_s) - std::max(meeting.land_s, meeting.robot_arrives_s);
  out.waits_s = std::max(0.0, out.waits_s);
  out.drained = task_.battery.model.landed_per_s * out.waits_s;
  const double held = meeting.energy_from - out.drained;
  if (held < task_.battery.reserve && out.waits_s > 0.0) return out;
  const ChargingCurve charging = task_.battery.charging();
  const double needs = std::max(meeting.charge_to, held);
  const double before_s =
      std::max(stops_[i].carry_s, charging.seconds(meeting.energy_from, meeting.charge_to));
  const double after_s = std::max(stops_[i].carry_s, charging.seconds(held, needs));
  out.delay_s = out.waits_s + after_s - before_s;
  return out;
}

/// To drive so long and keep a meeting.
double Trips::use(std::size_t i, double drive_s) const {
  return robot_.drive_per_s * (drive_s + stops_[i].carry_s) +
         robot_.per_charged * start_.charge_factor * stops_[i].charged;
}

/// The least delay with new energy before each rendezvous, over the one before which it was fetched last.
Status Trips::choose() {
  const std::size_t count = stops_.size();
  constexpr std::size_t kStart = std::numeric_limits<std::size_t>::max();
  std::vector<double> least(count + 1, kNever);
  std::vector<std::size_t> before(count + 1, kStart);
  const auto go_on = [&](std::size_t from, double energy) {
    const bool begins = from == kStart;
    const std::size_t first = begins ? 0 : from;
    const double until_now_s = begins ? 0.0 : least[from];
    double used = begins ? 0.0 : robot_.per_charged * changes_[from].drained;
    for (std::size_t i = first; i < count; ++i) {
      used += use(i, i > first || begins ? stops_[i].from_last_s : stops_[i].from_depot_s);
      if (used > energy + kRounding) break;
      if (used + robot_.drive_per_s * stops_[i].home_s > energy + kRounding) continue;
      const double delay_s = until_now_s + (i + 1 < count ? changes_[i + 1].delay_s : 0.0);
      if (delay_s >= least[i + 1]) continue;
      least[i + 1] = delay_s;
      before[i + 1] = from;
    }
  };
  go_on(kStart, start_.energy - robot_.reserve);
  const bool is_full_at_depot = start_.energy >= robot_.capacity && start_home_s_ <= 0.0;
  if (!is_full_at_depot) least[0] = changes_[0].delay_s;
  for (std::size_t first = 0; first < count; ++first) {
    if (least[first] < kNever) go_on(first, robot_.capacity - robot_.reserve);
  }
  if (!(least[count] < kNever)) return why_none();
  fetches_.assign(count, false);
  for (std::size_t at = before[count]; at != kStart; at = at > 0 ? before[at] : kStart) fetches_[at] = true;
  return {};
}

Error Trips::why_none() const {
  const double usable = robot_.capacity - robot_.reserve;
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    // Alone, whatever it costs the aircraft to wait.
    const double needs = use(i, stops_[i].from_depot_s + stops_[i].home_s);
    if (needs <= usable + kRounding) continue;
    return infeasible("The ground robot's battery holds " + std::to_string(usable) +
                      " units; the rendezvous at " + place_text(meetings_[i].site_m.head<2>()) +
                      " and the way there and back take " + std::to_string(needs) + ".");
  }
  return infeasible(
      "The ground robot's battery does not last, and while it fetches new energy the aircraft would have to "
      "wait on the ground beyond its reserve.");
}

void Trips::choose_late() {
  fetches_.assign(stops_.size(), false);
  double left = start_.energy - robot_.reserve;
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    const double home = robot_.drive_per_s * stops_[i].home_s;
    const double goes_on = use(i, stops_[i].from_last_s);
    if (goes_on + home > left + kRounding && !(i == 0 && start_.has_aircraft)) {
      fetches_[i] = true;
      left = robot_.capacity - robot_.reserve - use(i, stops_[i].from_depot_s);
    } else {
      left -= goes_on;
    }
    left = std::max(left, home);
  }
}

std::vector<Vec3> Trips::bends(const Vec3& from_m, const Vec3& to_m) const {
  std::vector<Vec3> out;
  if (!task_.charger.travel) return out;
  for (const Vec2& p : task_.charger.travel->bends(from_m.head<2>(), to_m.head<2>()))
    out.push_back(model_.ground(Vec3(p.x(), p.y(), 0.0)));
  return out;
}

/// Moves a meeting by what those before it were delayed; returns that and its own delay.
double Trips::shift_to(std::size_t i, bool fetches, double shift_s, RobotTrips& out) {
  Rendezvous& meeting = meetings_[i];
  const double free_s = i > 0 ? meetings_[i - 1].depart_s : start_.free_s;
  meeting.land_s += shift_s;
  meeting.arrive_by_s += shift_s;
  meeting.robot_arrives_s += shift_s;
  meeting.by_depot = fetches;
  if (fetches) {
    const Change& change = changes_[i];
    const Vec3& last_m = i > 0 ? stops_[i - 1].end_m : start_.at_m;
    const double there_s = free_s + (i > 0 ? stops_[i - 1].home_s : start_home_s_);
    out.visits.push_back({i, there_s, there_s + robot_.refill_s, bends(last_m, depot_m_)});
    meeting.robot_bends_m = bends(depot_m_, meeting.site_m);
    meeting.robot_arrives_s += change.arrives_late_s;
    meeting.wait_s += change.waits_s;
    out.wait_s += change.waits_s;
    const bool was_charged = meeting.charge_to > meeting.energy_from + kRounding;
    meeting.energy_from -= change.drained;
    if (!was_charged && meeting.charge_to > meeting.energy_from + kRounding) ++out.recharges;
    out.energy_min = std::min(out.energy_min, meeting.energy_from);
    if (std::isfinite(change.delay_s)) shift_s += change.delay_s;
  }
  meeting.depart_s += shift_s;
  return shift_s;
}

RobotTrips Trips::apply() {
  RobotTrips out;
  out.energy_min = kNever;
  double held = start_.energy;
  std::size_t leg = 0;
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    Rendezvous& meeting = meetings_[i];
    for (; leg < legs_.size() && leg < legs_before(meeting.id); ++leg) {
      legs_[leg].start_s += out.delay_s;
      legs_[leg].end_s += out.delay_s;
    }
    out.delay_s = shift_to(i, fetches_[i], out.delay_s, out);
    if (fetches_[i]) held = robot_.capacity;
    held -= robot_.drive_per_s * (fetches_[i] ? stops_[i].from_depot_s : stops_[i].from_last_s);
    meeting.robot_energy = std::max(0.0, held);
    const double drained = fetches_[i] ? changes_[i].drained : 0.0;
    held -= robot_.drive_per_s * stops_[i].carry_s + robot_.per_charged * (stops_[i].charged + drained);
    meeting.robot_energy_left = std::max(0.0, held);
  }
  for (; leg < legs_.size(); ++leg) {
    legs_[leg].start_s += out.delay_s;
    legs_[leg].end_s += out.delay_s;
  }
  out.home_bends_m = bends(stops_.back().end_m, depot_m_);
  out.home_s = meetings_.back().depart_s + stops_.back().home_s;
  return out;
}

}  // namespace

Result<RobotTrips> plan_trips(const Task& task, const FlightModel& model, const RobotStart& start,
                              std::span<Leg> legs, std::span<Rendezvous> meetings) {
  Trips trips(task, model, start, legs, meetings);
  if (Status chosen = trips.choose(); !chosen) return chosen.error();
  return trips.apply();
}

RobotTrips plan_late_trips(const Task& task, const FlightModel& model, const RobotStart& start,
                           std::span<Leg> legs, std::span<Rendezvous> meetings) {
  Trips trips(task, model, start, legs, meetings);
  trips.choose_late();
  return trips.apply();
}

bool lasts(const Task& task, const FlightModel& model, const RobotStart& start,
           std::span<const Rendezvous> meetings) {
  const RobotBattery& robot = task.charger.battery;
  const Vec3 depot_m = model.ground(task.charger.start_m);
  const std::vector<Stop> stops = stops_of(task, start, depot_m, meetings);
  double home_s = drive_s(task.charger, start.at_m, depot_m);
  double used = 0.0;
  for (std::size_t i = 0; i < stops.size() && !meetings[i].by_depot; ++i) {
    used +=
        robot.drive_per_s * (stops[i].from_last_s + stops[i].carry_s) + robot.per_charged * stops[i].charged;
    home_s = stops[i].home_s;
  }
  return used + robot.drive_per_s * home_s <= start.energy - robot.reserve;
}

Status limit_robot(const Task& task, const FlightModel& model, Plan& plan) {
  if (!std::isfinite(task.charger.battery.capacity) || plan.rendezvous.empty()) return {};
  RobotStart start;
  start.at_m = model.ground(task.charger.start_m);
  start.energy = task.charger.battery.capacity;
  Result<RobotTrips> trips = plan_trips(task, model, start, plan.legs, plan.rendezvous);
  if (!trips) return trips.error();
  plan.depot_visits = std::move(trips->visits);
  plan.home_bends_m = std::move(trips->home_bends_m);
  plan.robot_home_s = trips->home_s;
  plan.wait_s += trips->wait_s;
  plan.recharges += trips->recharges;
  plan.energy_min = std::min(plan.energy_min, trips->energy_min);
  plan.makespan_s += trips->delay_s;
  plan.cost = plan.makespan_s;
  return {};
}

}  // namespace swallowtail::coverage
