#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/path/path.hpp"
#include "planner/world/clearance.hpp"

namespace swallowtail::planner {

enum class ViolationKind : std::uint8_t { kMalformed, kBounds, kTerrain, kObstacle, kTurn, kClimb, kSpeed };
const char* name(ViolationKind kind);

struct Violation {
  ViolationKind kind = ViolationKind::kMalformed;
  double time_s = 0.0;          ///< when it is worst, or when it begins
  Vec3 where_m = Vec3::Zero();
  std::uint32_t obstacle_id = 0;
  std::size_t segment = 0;      ///< index of the waypoint that ends the segment
  std::string detail;           ///< value and rule, for people
};

struct Certificate {
  bool certified = false;
  std::vector<Violation> violations;  ///< the first kMaxViolations, in time
  double clearance_min_m = 0.0;       ///< least distance of the centre line to obstacles and (vertically) to the ground outside take-off and landing
};

/// Decides whether a timed path may be flown: continuous in space and time, the whole path, nothing sampled. Rules:
/// - every waypoint finite, times not decreasing, at least one waypoint; every position within the world's bounds;
/// - distance to each obstacle ≥ radius + margin + the obstacle's margin at every instant, moving obstacles included;
/// - height above ground × cos(atan(steepest slope nearby)) ≥ radius + margin, except on vertical segments of phase take-off or landing;
/// - speed, climb rate, climb angle, turn: see VehicleLimits. Relative tolerance 1e-6 on limits, none on clearances.
/// It is the only judge of what is published as flyable and stands behind `swallowtail check`.
Certificate certify(const TimedPath& path, const ClearanceQuery& query, const VehicleLimits& limits);

}  // namespace swallowtail::planner
