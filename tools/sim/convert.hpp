#pragma once

#include "idl/data/types.hpp"
#include "planner/base/vec.hpp"
#include "planner/path/path.hpp"

namespace swallowtail::sim {

inline Vec3 to_vec(const data::Vec3& v) { return {v.x_m, v.y_m, v.z_m}; }
inline data::Vec3 to_data(const Vec3& v) { return {.x_m = v.x(), .y_m = v.y(), .z_m = v.z()}; }

inline data::VehicleLimits to_data(const planner::VehicleLimits& limits) {
  return {.radius_m = limits.radius_m,
          .margin_m = limits.margin_m,
          .cruise_speed_mps = limits.cruise_speed_mps,
          .climb_speed_mps = limits.climb_speed_mps,
          .descent_speed_mps = limits.descent_speed_mps,
          .turn_max_rad = limits.turn_max_rad,
          .climb_max_rad = limits.climb_max_rad};
}

inline planner::Phase to_phase(data::PathPhase phase) {
  switch (phase) {
    case data::PathPhase::kTakeOff:
      return planner::Phase::kTakeOff;
    case data::PathPhase::kTransfer:
      return planner::Phase::kTransfer;
    case data::PathPhase::kCover:
      return planner::Phase::kCover;
    case data::PathPhase::kHold:
      return planner::Phase::kHold;
    case data::PathPhase::kLanding:
      return planner::Phase::kLanding;
  }
  return planner::Phase::kHold;
}

inline planner::TimedPath to_path(const std::vector<data::TimedWaypoint>& waypoints) {
  planner::TimedPath path;
  path.reserve(waypoints.size());
  for (const data::TimedWaypoint& waypoint : waypoints) {
    path.push_back({.time_s = waypoint.time_s,
                    .position_m = to_vec(waypoint.position),
                    .phase = to_phase(waypoint.phase),
                    .leg_index = waypoint.leg_index});
  }
  return path;
}

}  // namespace swallowtail::sim
