#include <algorithm>
#include <cmath>

#include "coverage/maintain/plan_keeper.hpp"

/// How PlanKeeper keeps a robot with a battery of its own going.
namespace swallowtail::coverage {
namespace {

/// What the aircraft uses and what was foreseen differ, and so do charges.
constexpr double kChargeFactor = 1.1;
constexpr double kReviewEvery_s = 5.0;
/// Of the capacity: what it may lack against the plan before that is news.
constexpr double kShortShare = 0.02;
constexpr double kAtDepot_m = 1.0;
/// Of the capacity: more than before is a refill.
constexpr double kRefillShare = 0.01;

std::vector<bool> trips_of(const LivePlan& plan) {
  std::vector<bool> out;
  for (const Rendezvous& meeting : plan.rendezvous) out.push_back(meeting.by_depot);
  return out;
}

}  // namespace

RobotStart PlanKeeper::robot_start() const {
  RobotStart out;
  out.at_m = robot_ ? robot_->position_m : task_.charger.start_m;
  out.energy = robot_energy();
  out.free_s = robot_arrives_s(out.at_m);
  out.has_aircraft = vehicle_ && vehicle_->mode == AircraftMode::kDocked;
  if (vehicle_ && vehicle_->on_ground() && has_flown_ && battery_) out.aircraft_energy = battery_->energy;
  out.charge_factor = kChargeFactor;
  return out;
}

/// Trips to the depot for the meetings ahead.
void PlanKeeper::send_robot(LivePlan& plan) const {
  if (!is_robot_limited() || plan.rendezvous.empty()) return;
  const FlightModel flight = model();
  const RobotStart start = robot_start();
  const Result<RobotTrips> chosen = plan_trips(task_, flight, start, plan.legs, plan.rendezvous);
  plan.end_s +=
      chosen ? chosen->delay_s : plan_late_trips(task_, flight, start, plan.legs, plan.rendezvous).delay_s;
}

/// Whoever has more energy than before has been at its depot: that trip is over.
void PlanKeeper::note_refill(const RobotView& before, const RobotView& now) {
  if (!is_robot_limited() || now.energy < before.energy + kRefillShare * task_.charger.battery.capacity)
    return;
  const auto trip = std::ranges::find_if(plan_.rendezvous, &Rendezvous::by_depot);
  if (trip != plan_.rendezvous.end()) trip->by_depot = false;
}

bool PlanKeeper::is_robot_stranded() const {
  return is_robot_limited() && robot_->energy <= 0.0 &&
         (robot_->position_m - task_.charger.start_m).head<2>().norm() > kAtDepot_m;
}

/// It neither drives nor charges any more: all that is left is to say so.
bool PlanKeeper::tell_stranded() {
  if (told_stranded_ || plan_.legs_done >= plan_.legs.size()) return false;
  told_stranded_ = true;
  note_revision("the robot's own battery is empty at (" +
                std::to_string(std::lround(robot_->position_m.x())) + ", " +
                std::to_string(std::lround(robot_->position_m.y())) + "), away from its depot");
  return true;
}

/// Does its energy do until it fetches new?
bool PlanKeeper::review_robot_energy() {
  if (!is_robot_limited() || plan_.rendezvous.empty() || robot_->time_s < robot_reviewed_s_ + kReviewEvery_s)
    return false;
  robot_reviewed_s_ = robot_->time_s;
  RobotStart start = robot_start();
  start.energy += kShortShare * task_.charger.battery.capacity;
  if (lasts(task_, model(), start, plan_.rendezvous)) return false;
  LivePlan changed = plan_;
  send_robot(changed);
  if (trips_of(changed) == trips_of(plan_)) return false;
  plan_ = std::move(changed);
  note_revision("the robot's energy " + std::to_string(std::lround(robot_->energy)) +
                " does not do: it fetches new");
  return true;
}

}  // namespace swallowtail::coverage
