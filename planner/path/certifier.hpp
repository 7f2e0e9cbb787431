#pragma once

#include <cstddef>
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
  double time_s = 0.0;  ///< when it is worst, or when it begins
  Vec3 where_m = Vec3::Zero();
  std::uint32_t obstacle_id = 0;
  std::size_t segment = 0;  ///< index of the waypoint that ends the segment
  std::string detail;       ///< value and rule, for people
};

inline constexpr std::size_t kMaxViolations = 64;

struct Certificate {
  bool certified = false;
  std::vector<Violation> violations;  ///< the first kMaxViolations, in time
  /// Least distance of the centre line to obstacles and (vertically) to the ground outside take-off and
  /// landing; obstacles farther than 50 m + clearance do not count, infinite where there is nothing else. 0
  /// if malformed.
  double clearance_min_m = 0.0;
};

/// Decides whether a timed path may be flown: continuous in space and time, the whole path, nothing sampled.
/// With R = radius + margin the rules are:
/// - well formed: limits that validate, at least one waypoint, every number finite (places within ±1e7 m,
/// times within ±1e10 s), times not decreasing; else kMalformed and nothing more is looked at;
/// - bounds: every position within the world's bounds (a box is convex: its waypoints decide);
/// - obstacles: distance ≥ R + the obstacle's margin at every instant, moving obstacles included, and never
/// touching, even where R is 0;
/// - terrain: no ground within R. Shown for each piece of a segment by either of two sufficient conditions,
/// pieces being halved down to kTerrainPiece_m before the segment is refused:
///   height above ground × cos(atan(s)) ≥ R, s the steepest slope within R of the piece, or lowest point −
///   highest ground within R of the piece ≥ R. A vertical segment (or stop) of phase take-off or landing is
///   exempt, but must not go below ground by more than 0.05 m;
/// - speed: ≤ cruise speed along a segment that is not vertical; climb and descent speed on every segment; a
/// place is not left in no time;
/// - climb: angle ≤ climb_max_rad on segments that are not vertical;
/// - turn: between two segments flown one after the other, with less than kStopToTurn_s of stop between, the
/// direction changes by ≤ turn_max_rad; between vertical and not vertical it counts as at least 90°. Relative
/// tolerance 1e-6 on limits and on the stop, none on clearances. Displacements up to kSamePlace_m are stops.
/// Departs from "exact" on one side only: a path may be refused within 1e-6·(1 + distance) of an obstacle's
/// limit, or above ground that is rough within R; it is never certified wrongly. It is the only judge of what
/// is published as flyable and stands behind `swallowtail check`.
inline constexpr double kTerrainPiece_m = 0.05;
Certificate certify(const TimedPath& path, const ClearanceQuery& query, const VehicleLimits& limits);

}  // namespace swallowtail::planner
