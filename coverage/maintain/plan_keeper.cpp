#include "coverage/maintain/plan_keeper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kLeftSite_m = 3.0;
constexpr double kShiftEvery_s = 30.0;
constexpr double kFresh_s = 3.0;             ///< how old a battery state may be to decide on it
constexpr double kLandingSpareShare = 0.01;  ///< of the capacity
constexpr double kLastSeconds_s = 20.0;
constexpr double kOverdue_s =
    120.0;  ///< past the time to leave, before it is said that the robot holds it up

double flat_distance(const Vec3& a, const Vec3& b) { return (a - b).head<2>().norm(); }

}  // namespace

Result<PlanKeeper> PlanKeeper::make(Task task, planner::Terrain terrain, KeeperParams params) {
  const Result<Plan> plan = plan_coverage(task, terrain, params.planning);
  if (!plan) return plan.error();
  auto ways = std::make_shared<const Ways>(ways_of(task, plan->polygons));
  return PlanKeeper(std::move(task), std::move(terrain), params, live_plan(*plan), plan->fields,
                    std::move(ways));
}

PlanKeeper::PlanKeeper(Task task, planner::Terrain terrain, const KeeperParams& params, LivePlan plan)
    : PlanKeeper(
          task, terrain, params, std::move(plan), {},
          std::make_shared<const Ways>(ways_of(task, cut_fields(task, terrain, params.planning).polygons))) {}

PlanKeeper::PlanKeeper(Task task, planner::Terrain terrain, const KeeperParams& params, LivePlan plan,
                       std::vector<FieldReport> fields, std::shared_ptr<const Ways> ways)
    : task_(std::move(task)),
      capacity_as_asked_(task_.battery.capacity),
      terrain_(std::move(terrain)),
      params_(params),
      plan_(std::move(plan)),
      fields_(std::move(fields)),
      ways_(std::move(ways)) {
  for (const Leg& leg : plan_.legs) next_id_ = std::max(next_id_, leg.sub_cell_id + 1);
  plan_.battery_energy = task_.battery.capacity;
  told_legs_ = plan_.legs;
}

EnergyModel PlanKeeper::energy_model() const {
  EnergyModel out = task_.battery.model;
  out.correction = consumption_.correction();
  return out;
}

/// To keep at a landing besides the reserve. Consumption above what was allowed for comes from wind or a bad
/// model, and differs from flight to flight: then it is more; and never less than gusts may take in the last
/// seconds, when nothing can be changed any more.
double PlanKeeper::landing_spare() const {
  const bool unsteady = consumption_.correction().all > 1.0 + params_.planning.energy_margin;
  const double power = model().power(Vec3::Zero(), task_.start_m.z());
  const double gusts = consumption_.gust_deviation({kLastSeconds_s, kLastSeconds_s * power, 0.0});
  return std::max((unsteady ? 3.0 : 1.0) * kLandingSpareShare * task_.battery.capacity, gusts);
}

double PlanKeeper::energy_now() const {
  if (!battery_) return task_.battery.capacity;
  if (!vehicle_ || vehicle_->on_ground()) return battery_->energy;
  return battery_->energy - std::max(0.0, vehicle_->time_s - battery_->time_s) *
                                model().power(vehicle_->velocity_mps, vehicle_->position_m.z());
}

bool PlanKeeper::covers(std::size_t leg) const {
  if (!vehicle_ || vehicle_->on_ground() || leg >= plan_.legs.size() || vehicle_->leg_index != leg)
    return false;
  if (plan_.legs[leg].kind != LegKind::kCover) return false;
  const StripTrack line(plan_.legs[leg],
                        {0.5, task_.height_tolerance_m, 0.5, task_.vehicle.cruise_speed_mps});
  const double along = line.along_m(vehicle_->position_m);
  return line.on_line(vehicle_->position_m) && along > 0.1;
}

/// Legs that the aircraft begins before a change can reach it must stay as they are, in their order: it flies
/// them by the plan before, and counts them as done by their index.
PlanKeeper::Commitment PlanKeeper::committed() const {
  Commitment out;
  if (!vehicle_ || vehicle_->on_ground()) return out;
  if (is_path_of_plan()) return committed_on_path();
  const FlightModel flight = model();
  const double speed = task_.vehicle.cruise_speed_mps;
  double time_s = 0.0;
  Vec3 at = vehicle_->position_m;
  std::optional<Vec3> direction;
  if (vehicle_->velocity_mps.head<2>().norm() > 0.5) direction = vehicle_->velocity_mps;
  if (covers(plan_.legs_done)) {
    const Leg& current = plan_.legs[plan_.legs_done];
    out = {1, (at - current.entry_m).norm() + speed * params_.reaction_s};
    time_s = flight.level(at, current.exit_m).time_s;
    at = current.exit_m;
    direction = current.exit_m - current.entry_m;
  }
  for (std::size_t i = plan_.legs_done + out.legs; i < plan_.legs.size(); ++i) {
    if (i > plan_.legs_done && plan_.legs[i - 1].transfer != Transfer::kFF) break;
    const Leg& leg = plan_.legs[i];
    time_s += flight.transfer(at, leg.entry_m, {direction, leg.exit_m - leg.entry_m}).time_s;
    if (time_s > params_.reaction_s) break;
    out = {out.legs + 1, speed * (params_.reaction_s - time_s)};
    time_s += flight.level(leg.entry_m, leg.exit_m).time_s;
    at = leg.exit_m;
    direction = leg.exit_m - leg.entry_m;
  }
  return out;
}

std::optional<FlightCost> PlanKeeper::to_next_landing() const {
  if (!vehicle_ || vehicle_->on_ground()) return std::nullopt;
  FlightCost out = legs_to_next_landing();
  out.energy += surcharge();
  return out;
}

FlightCost PlanKeeper::legs_to_next_landing() const {
  return flight_to(plan_.rendezvous.empty() ? nullptr : &plan_.rendezvous.front(), start_in_air());
}

/// To the exit of the last of these legs, which are the next to fly.
FlightCost PlanKeeper::flight_over(std::span<const Leg> legs, const ScheduleStart& start) const {
  const FlightModel flight = model();
  FlightCost cost;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Leg& leg = legs[i];
    if (i > 0) {
      const Leg& before = legs[i - 1];
      cost += flight.transfer(before.exit_m, leg.entry_m,
                              {before.exit_m - before.entry_m, leg.exit_m - leg.entry_m});
    } else if (start.kind == StartKind::kAir && covers(plan_.legs_done)) {
      cost += flight.level(start.position_m, leg.exit_m);
      continue;
    } else {
      cost += lift_to_first(flight, start, {leg.entry_m, leg.exit_m});
    }
    cost += flight.level(leg.entry_m, leg.exit_m);
  }
  return cost;
}

/// Over the legs ahead to a meeting, or (none) to the end of the plan.
FlightCost PlanKeeper::flight_to(const Rendezvous* landing, const ScheduleStart& start) const {
  const FlightModel flight = model();
  const std::size_t size = plan_.legs.size();
  if (size == 0) return flight.landing(start.position_m);
  const std::size_t past = landing != nullptr ? std::min(size, legs_before(landing->id)) : size;
  const bool at_entry = landing != nullptr && is_at_entry(landing->id) && past < size;
  if (past <= plan_.legs_done) {
    const Vec3 above = at_entry ? plan_.legs[past].entry_m : plan_.legs[past - 1].exit_m;
    return flight.transfer_and_land(start.position_m, start.direction, above);
  }
  const Leg& last = plan_.legs[past - 1];
  const FlightCost cost =
      flight_over(std::span(plan_.legs).subspan(plan_.legs_done, past - plan_.legs_done), start);
  return cost + (at_entry ? flight.transfer_and_land(last.exit_m, last.exit_m - last.entry_m,
                                                     plan_.legs[past].entry_m)
                          : flight.landing(last.exit_m));
}

std::optional<double> PlanKeeper::energy_at_next_landing() const {
  const auto cost = to_next_landing();
  if (!cost) return std::nullopt;
  return energy_now() - cost->energy;
}

/// Where it is carried to it is only on the robot.
bool PlanKeeper::at_meeting(const AircraftView& vehicle) const {
  return std::any_of(plan_.rendezvous.begin(), plan_.rendezvous.end(), [&](const Rendezvous& meeting) {
    return flat_distance(meeting.site_m, vehicle.position_m) < kAtSite_m ||
           (meeting.carry && vehicle.mode == AircraftMode::kDocked &&
            flat_distance(meeting.carry_to_m, vehicle.position_m) < kAtSite_m);
  });
}

/// The aircraft has left the ground: what lay before is over.
void PlanKeeper::pass_meeting(const Vec3& from_m) {
  for (std::size_t i = 0; i < plan_.rendezvous.size(); ++i) {
    const Rendezvous& meeting = plan_.rendezvous[i];
    if (flat_distance(meeting.carry ? meeting.carry_to_m : meeting.site_m, from_m) > kLeftSite_m) continue;
    if (legs_before(meeting.id) > plan_.legs_done + 1) break;
    plan_.rendezvous.erase(plan_.rendezvous.begin(),
                           plan_.rendezvous.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    break;
  }
}

bool PlanKeeper::refuse() {
  ++refused_;
  return false;
}

bool PlanKeeper::on_vehicle(const AircraftView& vehicle) {
  const bool finite =
      is_finite(vehicle.time_s) && is_finite(vehicle.position_m) && is_finite(vehicle.velocity_mps);
  if (!finite || (vehicle_ && vehicle.time_s < vehicle_->time_s)) return refuse();
  if (vehicle.legs_done < (vehicle_ ? vehicle_->legs_done : plan_.legs_done))
    return replace_aircraft(vehicle);
  const std::optional<AircraftView> before = vehicle_;
  vehicle_ = vehicle;
  // This keeper may be younger than the mission.
  has_flown_ = has_flown_ || (!before && (vehicle.legs_done > 0 || !vehicle.on_ground()));
  if (before) note_flight(*before, vehicle);
  if (before && before->on_ground() && !vehicle.on_ground()) {
    const bool times_off =
        !plan_.rendezvous.empty() && has_flown_ &&
        std::abs(vehicle.time_s - plan_.rendezvous.front().depart_s) > params_.time_tolerance_s &&
        at_meeting(*before);
    const double late = times_off ? vehicle.time_s - plan_.rendezvous.front().depart_s : 0.0;
    pass_meeting(before->position_m);
    has_flown_ = true;
    solved_slack_.reset();
    lands_at_once_ = false;
    told_overdue_.clear();
    promised_s_.reset();
    told_no_plan_ = false;
    told_short_ = false;
    follow_progress(before, vehicle);
    if (times_off) {
      shift_times(plan_, plan_.legs_done, late);
      note_revision("times: the take-off was " + std::to_string(std::lround(late)) + " s late");
    }
    // What was lost just before may call for coming down again at once.
    const bool is_known = battery_ && battery_->time_s >= vehicle.time_s - kFresh_s;
    return (is_known && review_flight()) || times_off;
  }
  if (before && !before->on_ground() && vehicle.on_ground()) {
    landed_since_s_ = vehicle.time_s;
    if (!lands_at_once_ && at_meeting(vehicle)) detour_energy_ = 0.0;
  }
  follow_progress(before, vehicle);
  if (!vehicle.on_ground()) return tell_given_up(review_gaps());
  const bool changed = review_ground();
  return tell_given_up(review_wait() || changed);
}

/// Long past the time to leave, whoever waits for the mission is told what holds it up, and what else later.
bool PlanKeeper::review_wait() {
  if (told_no_plan_ || !has_flown_ || plan_.rendezvous.empty() || plan_.legs_done >= plan_.legs.size())
    return false;
  const double due_s = std::max(plan_.rendezvous.front().depart_s, landed_since_s_);
  if (vehicle_->time_s < std::max(due_s, told_overdue_s_) + kOverdue_s) return false;
  std::string holder = what_holds_it_up();
  if (holder == told_overdue_) return false;
  told_overdue_ = std::move(holder);
  told_overdue_s_ = vehicle_->time_s;
  note_revision("waits since " + std::to_string(std::lround(due_s)) + " s for " + told_overdue_);
  return true;
}

std::string PlanKeeper::what_holds_it_up() const {
  if (!robot_ || vehicle_->time_s - robot_->time_s > kOverdue_s) return "the robot, which is silent";
  if (vehicle_->mode != AircraftMode::kDocked) return "the robot to come";
  return robot_->is_ready ? "a safe path from the robot" : "the robot to let it go";
}

/// What is given up is news, whether or not anything else has changed.
bool PlanKeeper::tell_given_up(bool changed) {
  if (!std::exchange(gives_up_, false)) return changed;
  if (!changed) note_revision("a stretch is left out for good");
  return true;
}

bool PlanKeeper::on_battery(const BatteryView& battery) {
  const bool finite =
      is_finite(battery.time_s) && is_non_negative(battery.energy) && is_non_negative(battery.capacity);
  if (!finite || (battery_ && battery.time_s < battery_->time_s)) return refuse();
  if (battery_) learn_consumption(*battery_, battery);
  battery_ = battery;
  const bool shrunk = review_capacity(battery.capacity);
  if (!vehicle_ || shrunk) return shrunk;
  if (vehicle_->on_ground()) return review_ground();
  return review_flight();
}

bool PlanKeeper::on_robot(const RobotView& robot) {
  const bool finite = is_finite(robot.time_s) && is_finite(robot.position_m) && is_non_negative(robot.energy);
  if (!finite || (robot_ && robot.time_s < robot_->time_s)) return refuse();
  if (robot_) note_refill(*robot_, robot);
  robot_ = robot;
  if (is_robot_stranded()) return tell_stranded();
  told_stranded_ = false;
  if (review_robot_energy()) return true;
  // Where the aircraft stays, the robot cannot be late.
  if (!vehicle_ || told_no_plan_ || plan_.rendezvous.empty() || robot.has_vehicle ||
      vehicle_->mode == AircraftMode::kDocked)
    return false;
  Rendezvous& next = plan_.rendezvous.front();
  const double there_s = next.by_depot ? drive_s(task_.charger, robot.position_m, task_.charger.start_m) +
                                             task_.charger.battery.refill_s +
                                             drive_s(task_.charger, task_.charger.start_m, next.site_m)
                                       : drive_s(task_.charger, robot.position_m, next.site_m);
  const double arrives = robot.time_s + there_s;
  const double late = arrives - std::max(next.land_s, next.robot_arrives_s);
  // Where no way is known from where it is, it may still be on one.
  if (!std::isfinite(late) || late < params_.time_tolerance_s || robot.time_s < last_shift_s_ + kShiftEvery_s)
    return false;
  last_shift_s_ = robot.time_s;
  const double land_s = next.land_s;
  shift_times(plan_, legs_before(next.id), late);
  next.land_s = land_s;
  next.arrive_by_s = land_s;
  next.wait_s = std::max(0.0, next.robot_arrives_s - land_s);
  if (!promised_s_) promised_s_ = arrives - late;
  note_revision("times: the robot is " + std::to_string(std::lround(arrives - *promised_s_)) + " s late");
  return true;
}

void PlanKeeper::note_revision(const std::string& reason) {
  send_robot(plan_);
  ++plan_.revision;
  if (!same_sortie(told_legs_, plan_.legs, plan_.legs_done)) {
    legs_revision_ = plan_.revision;
    later_.clear();
  }
  told_legs_ = plan_.legs;
  plan_.reason = reason;
  for (const std::string& lacks : {plan_.lacks, given_up_}) {
    if (!lacks.empty()) plan_.reason += "; " + lacks;
  }
  plan_.vehicle_time_s = vehicle_ ? vehicle_->time_s : 0.0;
  plan_.battery_time_s = battery_ ? battery_->time_s : 0.0;
  plan_.battery_energy = energy_now();
}

}  // namespace swallowtail::coverage
