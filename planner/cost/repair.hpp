#pragma once

#include <span>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::planner {

/// What every segment and corner of a path must keep, the last ones included.
struct KinematicLimits {
  double turn_max_rad = 0.0;   ///< change of direction from a segment to the next, (0, π]
  double climb_max_rad = 0.0;  ///< climb or descent of a segment, (0, π/2]
  double segment_min_m = 0.0;  ///< shortest segment, ≥ 0
};

/// Whether a polyline keeps them, to a relative 1e-9.
bool keeps(const KinematicLimits& limits, std::span<const Vec3> polyline);

/// A polyline between the same ends that keeps the limits, near the given one: it comes back as it is if it
/// keeps them. Waypoints too near to another are left out, heights are brought within what the climb limit
/// allows from either end, and a corner that is too sharp is moved towards the middle of its neighbours just
/// as far as it must, in sweeps until nothing is left to do; a path that does not settle becomes the straight
/// line. So it never has more points than before, and it exists whenever the straight line keeps the limits.
/// (Clamping variables, as the code of [NMOPSO] does, leaves the last segment out.) Obstacles are not looked
/// at. Errors: fewer than two points, one that is not finite, limits out of range, ends that are nearer than
/// segment_min_m or steeper than climb_max_rad above one another.
Result<std::vector<Vec3>> repair(std::span<const Vec3> polyline, const KinematicLimits& limits);

}  // namespace swallowtail::planner
