#pragma once

#include <cstddef>
#include <vector>

#include "planner/path/path.hpp"

namespace swallowtail::planner {

/// A route and the times it is flown at, kept together: `arrivals[r]` is the index in `path` of route point r
/// (the last waypoint there, its stops included). The route spells out every corner that the timing added, so
/// that cutting it anywhere leaves the rest of the flight where it was.
struct TimedRoute {
  Vec3 start_m = Vec3::Zero();
  double start_time_s = 0.0;
  std::vector<RoutePoint> route;
  TimedPath path;
  std::vector<std::size_t> arrivals;

  static TimedRoute make(const Vec3& start, double start_time_s, const std::vector<RoutePoint>& route,
                         const VehicleLimits& limits);

  double end_time_s() const { return path.back().time_s; }
  /// The segment (index of its last waypoint) flown at that time; at least 1 where there is one.
  std::size_t segment_at(double time_s) const;
};

/// What replaces the stretch of a route from one time to another.
struct Splice {
  double leave_s = 0.0;        ///< on the old timing
  double rejoin_s = 0.0;       ///< on the old timing
  double wait_s = 0.0;         ///< stop where it leaves
  bool keeps_between = false;  ///< the old route is flown after the stop, nothing is left out
  std::vector<Vec3> points;    ///< the way round, if the old route is not kept
};

struct Spliced {
  TimedRoute timed;
  std::size_t leave_index = 0;   ///< in timed.path: where the old route is left
  std::size_t rejoin_index = 0;  ///< in timed.path: where it is joined again
  double skipped_cover_m = 0.0;  ///< of strips that the detour leaves out
};

/// The rejoined point and the way round are transfers, what is left of the strips stays cover. Of a leg whose
/// strip is left out altogether one cover waypoint stays, on the way round, so that legs are still counted in
/// order.
Spliced splice(const TimedRoute& old, const Splice& change, const VehicleLimits& limits);

}  // namespace swallowtail::planner
