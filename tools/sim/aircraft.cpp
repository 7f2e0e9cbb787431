#include "tools/sim/aircraft.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/sim/convert.hpp"

namespace swallowtail::sim {
namespace {

using data::VehicleMode;
using planner::Phase;
using planner::TimedPath;

constexpr std::size_t kMaxCoveragePlans = 16;
constexpr double kStill_mps = 1e-6;
/// On board the vehicle follows its robot, whose state comes in steps: a gap is closed at the robot's speed
/// or within this time, whichever is faster.
constexpr double kRideLag_s = 1.0;

VehicleMode mode_of(Phase phase) {
  switch (phase) {
    case Phase::kTakeOff:
      return VehicleMode::kTakingOff;
    case Phase::kTransfer:
      return VehicleMode::kTransfer;
    case Phase::kCover:
      return VehicleMode::kCovering;
    case Phase::kHold:
      return VehicleMode::kHolding;
    case Phase::kLanding:
      return VehicleMode::kLanding;
  }
  return VehicleMode::kHolding;
}

}  // namespace

Aircraft::Aircraft(std::uint32_t vehicle_id, const Vec3& start_m, planner::Terrain terrain)
    : vehicle_id_(vehicle_id), terrain_(std::move(terrain)) {
  motion_.position_m = start_m;
  rest(0.0);
}

Vec3 Aircraft::predicted_position_m(double time_s) const {
  for (auto flight = next_.rbegin(); flight != next_.rend(); ++flight) {
    if (flight->path.front().time_s <= time_s) return planner::position_at(flight->path, time_s);
  }
  return flight_ ? planner::position_at(flight_->path, time_s) : motion_.position_m;
}

Offer Aircraft::offer(const data::PathPlan& plan) {
  if (last_offered_ == plan.revision) return Offer::kKnown;
  last_offered_ = plan.revision;
  if (plan.verdict == data::PathVerdict::kNoSafePath) return Offer::kNoSafePath;
  if (plan.waypoints.empty()) return Offer::kNoWaypoints;
  Flight flight{.revision = plan.revision,
                .coverage_revision = plan.basis.coverage_revision,
                .verdict = plan.verdict,
                .path = to_path(plan.waypoints)};
  const double begin_s = flight.path.front().time_s;
  const double join_s = std::max(begin_s, motion_.time_s);
  const Vec3 gap_m = planner::position_at(flight.path, join_s) - predicted_position_m(join_s);
  if (!(gap_m.norm() <= kJoin_m)) return Offer::kStaleStart;
  while (!next_.empty() && next_.back().path.front().time_s >= begin_s) next_.pop_back();
  next_.push_back(std::move(flight));
  return Offer::kAccepted;
}

void Aircraft::learn_legs(const data::CoveragePlan& plan) {
  std::vector<LegEnd>& ends = leg_ends_[plan.revision];
  ends.clear();
  for (const data::Leg& leg : plan.legs) ends.push_back({.kind = leg.kind, .exit_m = to_vec(leg.exit)});
  if (leg_ends_.size() > kMaxCoveragePlans) leg_ends_.erase(leg_ends_.begin());
}

void Aircraft::replace(const Vec3& start_m) {
  const double time_s = motion_.time_s;
  motion_ = {};
  motion_.time_s = time_s;
  motion_.position_m = start_m;
  flight_.reset();
  next_.clear();
  covered_.clear();
  corners_.clear();
  rest(0.0);
}

bool Aircraft::ends_leg(const Flight& flight, std::size_t index) const {
  const planner::TimedWaypoint& here = flight.path[index];
  const auto plan = leg_ends_.find(flight.coverage_revision);
  const bool known = plan != leg_ends_.end() && here.leg_index < plan->second.size();
  const bool at_exit = known && (plan->second[here.leg_index].exit_m - here.position_m).norm() <= kLegEnd_m;
  if (known && plan->second[here.leg_index].kind == data::LegKind::kReposition) return at_exit;
  if (here.phase != Phase::kCover) return false;
  for (std::size_t i = index + 1; i < flight.path.size(); ++i) {
    if (flight.path[i].phase == Phase::kCover && flight.path[i].leg_index == here.leg_index) return false;
  }
  if (at_exit) return true;
  // The planner left the rest of the strip out: it flies on to another leg, or lands as planned.
  if (index + 1 >= flight.path.size()) return false;
  const planner::TimedWaypoint& after = flight.path[index + 1];
  return after.leg_index > here.leg_index ||
         (after.phase == Phase::kLanding && flight.verdict == data::PathVerdict::kCertified);
}

void Aircraft::note_covered(const Flight& flight, double from_s, double to_s) {
  for (std::size_t i = std::max<std::size_t>(flight.passed, 1); i < flight.path.size(); ++i) {
    const planner::TimedWaypoint& begin = flight.path[i - 1];
    const planner::TimedWaypoint& end = flight.path[i];
    if (begin.time_s >= to_s) return;
    if (end.phase != Phase::kCover || end.time_s <= from_s) continue;
    covered_.push_back({.from_m = planner::position_at(flight.path, std::max(from_s, begin.time_s)),
                        .to_m = planner::position_at(flight.path, std::min(to_s, end.time_s))});
  }
}

void Aircraft::pass_waypoints(Flight& flight, double until_s) {
  note_covered(flight, motion_.time_s, until_s);
  for (; flight.passed < flight.path.size() && flight.path[flight.passed].time_s <= until_s;
       ++flight.passed) {
    const planner::TimedWaypoint& corner = flight.path[flight.passed];
    if (corner.time_s > motion_.time_s) {
      Motion at = motion_;
      at.time_s = corner.time_s;
      at.position_m = corner.position_m;
      at.mode = mode_of(corner.phase);
      corners_.push_back(at);
    }
    if (!ends_leg(flight, flight.passed)) continue;
    motion_.legs_done = std::max(motion_.legs_done, flight.path[flight.passed].leg_index + 1);
  }
}

const Motion& Aircraft::advance(double to_s) {
  if (!(to_s >= motion_.time_s)) return motion_;
  const double duration_s = to_s - motion_.time_s;
  covered_.clear();
  corners_.clear();
  while (!next_.empty() && next_.front().path.front().time_s <= to_s) {
    if (flight_) pass_waypoints(*flight_, next_.front().path.front().time_s);
    flight_ = std::move(next_.front());
    next_.pop_front();
    // Waypoints that were behind when the path was accepted were flown by the path before.
    while (flight_->passed + 1 < flight_->path.size() &&
           flight_->path[flight_->passed].time_s < motion_.time_s) {
      ++flight_->passed;
    }
    motion_.path_revision = flight_->revision;
    motion_.coverage_revision = flight_->coverage_revision;
  }
  if (flight_) pass_waypoints(*flight_, to_s);
  motion_.time_s = to_s;
  if (flight_) {
    if (to_s < flight_->path.back().time_s) {
      fly(*flight_, to_s);
      return motion_;
    }
    motion_.position_m = flight_->path.back().position_m;
    motion_.leg_index = flight_->path.back().leg_index;
    flight_.reset();
  }
  rest(duration_s);
  return motion_;
}

void Aircraft::fly(const Flight& flight, double to_s) {
  const std::size_t ahead = std::max<std::size_t>(flight.passed, 1);
  const planner::TimedWaypoint& from = flight.path[ahead - 1];
  const planner::TimedWaypoint& to = flight.path[ahead];
  motion_.position_m = planner::position_at(flight.path, to_s);
  const double duration_s = to.time_s - from.time_s;
  motion_.velocity_mps =
      duration_s > 0.0 ? Vec3((to.position_m - from.position_m) / duration_s) : Vec3(Vec3::Zero());
  const Vec2 level_mps = motion_.velocity_mps.head<2>();
  if (level_mps.norm() > kStill_mps) motion_.yaw_rad = std::atan2(level_mps.y(), level_mps.x());
  motion_.mode = mode_of(to.phase);
  motion_.leg_index = to.leg_index;
  motion_.docked_charger_id = 0;
}

void Aircraft::rest(double duration_s) {
  const bool was_docked = motion_.mode == VehicleMode::kDocked;
  motion_.velocity_mps = Vec3::Zero();
  motion_.docked_charger_id = 0;
  const bool offered = charger_ && charger_->docked_vehicle_id == vehicle_id_;
  if (was_docked && offered) return ride(duration_s);
  const double ground_m = terrain_.height_at(motion_.position_m.x(), motion_.position_m.y());
  if (motion_.position_m.z() > ground_m + kTouchDown_m) {
    motion_.mode = VehicleMode::kHolding;
    return;
  }
  motion_.mode = VehicleMode::kLanded;
  if (offered && (to_vec(charger_->position) - motion_.position_m).head<2>().norm() <= kDockReach_m)
    ride(duration_s);
}

void Aircraft::ride(double duration_s) {
  motion_.mode = VehicleMode::kDocked;
  motion_.docked_charger_id = charger_->charger_id;
  if (!(duration_s > 0.0)) return;
  // The robot drives on the ground; its own height is only as good as the two ends of its way.
  Vec3 robot_m = to_vec(charger_->position);
  robot_m.z() = terrain_.height_at(robot_m.x(), robot_m.y());
  const Vec3 gap_m = robot_m - motion_.position_m;
  const double reach_m = std::max(charger_->speed_mps, gap_m.norm() / kRideLag_s) * duration_s;
  if (gap_m.norm() <= reach_m) {
    motion_.position_m += gap_m;
  } else {
    motion_.position_m += gap_m * (reach_m / gap_m.norm());
    motion_.velocity_mps = gap_m * (reach_m / gap_m.norm() / duration_s);
    motion_.position_m.z() = terrain_.height_at(motion_.position_m.x(), motion_.position_m.y());
  }
}

double Aircraft::charge_rate() const {
  const bool is_plugged = motion_.mode == VehicleMode::kDocked && charger_;
  return is_plugged && motion_.time_s - charger_->time_s <= kPlugSilence_s ? charger_->charge_rate : 0.0;
}

}  // namespace swallowtail::sim
