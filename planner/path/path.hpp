#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::planner {

enum class Phase : std::uint8_t { kTakeOff, kTransfer, kCover, kHold, kLanding };

/// What the aircraft can do. It is a multirotor: it may stop anywhere, turn on the spot and climb vertically.
struct VehicleLimits {
  double radius_m = 0.5;
  double margin_m = 2.0;                         ///< kept between hull and everything else
  double cruise_speed_mps = 8.0;                 ///< greatest speed along a segment that is not vertical
  double climb_speed_mps = 3.0;                  ///< greatest vertical speed up, on every segment
  double descent_speed_mps = 3.0;                ///< greatest vertical speed down, on every segment
  double turn_max_rad = std::numbers::pi / 3.0;  ///< change of direction at a waypoint that is flown through;
                                                 ///< none where it stops for kStopToTurn_s
  double climb_max_rad =
      std::numbers::pi / 4.0;  ///< climb or descent angle of a segment that is not vertical

  double clearance_m() const { return radius_m + margin_m; }
};
/// Errors name the limit, its value and the rule: radius, margin ≥ 0 with a positive sum, speeds > 0, turn in
/// [0, π], climb in [0, π/2]; all finite.
Status validate(const VehicleLimits& limits);

/// A stop of at least this long lets the direction change freely.
inline constexpr double kStopToTurn_s = 1.0;
/// Places nearer than this are one place: no flight between them, a stop. A segment that covers no more than
/// this of ground is vertical.
inline constexpr double kSamePlace_m = 1e-6;

/// A place and the mission time to be there. `phase` and `leg_index` belong to the segment that ends here.
/// Between waypoints the flight is straight at constant velocity; two waypoints at one place are a stop.
struct TimedWaypoint {
  double time_s = 0.0;
  Vec3 position_m = Vec3::Zero();
  Phase phase = Phase::kTransfer;
  std::uint32_t leg_index = 0;
};

using TimedPath = std::vector<TimedWaypoint>;

/// Position at a time; clamped to the path's ends. Where two waypoints share a time, the later counts. The
/// path must not be empty.
Vec3 position_at(const TimedPath& path, double time_s);
double length_m(const TimedPath& path);

/// A place still without a time; what routes are made of. dwell_s: stop here for at least so long.
struct RoutePoint {
  Vec3 position_m = Vec3::Zero();
  Phase phase = Phase::kTransfer;
  std::uint32_t leg_index = 0;
  double dwell_s = 0.0;
};

/// Gives times to `start` and the route within the limits: cruise speed or what climb and descent speed
/// allow, and a stop of kStopToTurn_s wherever the turn limit would be broken or a vertical segment begins or
/// ends. A segment steeper than climb_max_rad that is not vertical is flown as a vertical part and a level
/// part (climb first, descend last). The result begins with a waypoint at `start` and has one for each route
/// point, in order, with its phase and leg; those added between carry the phase and leg of the route point
/// they lead to, stops those of the point they stop at. Whatever the route, the certifier finds nothing to
/// say about speed, climb or turn; clearances are not looked at. `limits` must validate.
TimedPath time_route(const Vec3& start, double start_time_s, const std::vector<RoutePoint>& route,
                     const VehicleLimits& limits);

}  // namespace swallowtail::planner
