#include "planner/replan/timed_route.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::planner {
namespace {

bool same_place(const Vec3& a, const Vec3& b) { return (a - b).norm() <= kSamePlace_m; }

/// Every waypoint of a path as a route point; stops longer than a turn needs become dwells.
std::vector<RoutePoint> spelled_out(const TimedPath& path) {
  std::vector<RoutePoint> route;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const TimedWaypoint& w = path[i];
    const double duration = w.time_s - path[i - 1].time_s;
    if (!same_place(w.position_m, path[i - 1].position_m)) {
      route.push_back({w.position_m, w.phase, w.leg_index, 0.0});
    } else if (duration > 0.0) {
      if (route.empty()) route.push_back({w.position_m, w.phase, w.leg_index, 0.0});
      route.back().dwell_s += duration;
    } else if (!route.empty() && (route.back().phase != w.phase || route.back().leg_index != w.leg_index)) {
      route.push_back({w.position_m, w.phase, w.leg_index, 0.0});
    }
  }
  // Stops for turning come by themselves where they are needed; after a change they may not be.
  for (RoutePoint& point : route) {
    if (point.dwell_s <= kStopToTurn_s * (1.0 + 1e-9)) point.dwell_s = 0.0;
  }
  return route;
}

std::vector<std::size_t> arrivals_of(const TimedPath& path, const std::vector<RoutePoint>& route) {
  std::vector<std::size_t> arrivals;
  std::size_t i = 0;
  for (std::size_t r = 0; r < route.size(); ++r) {
    while (i + 1 < path.size() && !same_place(path[i].position_m, route[r].position_m)) ++i;
    const bool same_next = r + 1 < route.size() && same_place(route[r].position_m, route[r + 1].position_m);
    while (!same_next && i + 1 < path.size() && same_place(path[i + 1].position_m, route[r].position_m)) ++i;
    arrivals.push_back(i);
  }
  return arrivals;
}

bool has_cover(const std::vector<RoutePoint>& route, std::uint32_t leg) {
  return std::any_of(route.begin(), route.end(),
                     [leg](const RoutePoint& p) { return p.phase == Phase::kCover && p.leg_index == leg; });
}

/// Leaves a cover waypoint to each leg that lost all of its own to the way round; returns how many were
/// added.
std::size_t keep_legs_counted(const std::vector<RoutePoint>& removed, std::vector<RoutePoint>& route,
                              std::size_t first, std::size_t last) {
  std::vector<std::uint32_t> lost;
  for (const RoutePoint& p : removed) {
    if (p.phase != Phase::kCover || has_cover(route, p.leg_index)) continue;
    if (lost.empty() || lost.back() != p.leg_index) lost.push_back(p.leg_index);
  }
  std::size_t at = last;
  for (std::size_t i = lost.size(); i-- > 0;) {
    RoutePoint marked = route[at];
    marked.phase = Phase::kCover;
    marked.leg_index = lost[i];
    marked.dwell_s = 0.0;
    route.insert(route.begin() + static_cast<std::ptrdiff_t>(at), marked);
    if (at > first) --at;
  }
  return lost.size();
}

std::size_t last_index_by(const TimedPath& path, double time_s) {
  const auto later = std::upper_bound(path.begin(), path.end(), time_s + 1e-6,
                                      [](double t, const TimedWaypoint& w) { return t < w.time_s; });
  return later == path.begin() ? 0 : static_cast<std::size_t>(later - path.begin()) - 1;
}

}  // namespace

TimedRoute TimedRoute::make(const Vec3& start, double start_time_s, const std::vector<RoutePoint>& route,
                            const VehicleLimits& limits) {
  TimedRoute timed{start, start_time_s, {}, {}, {}};
  timed.route = spelled_out(time_route(start, start_time_s, route, limits));
  timed.path = time_route(start, start_time_s, timed.route, limits);
  timed.arrivals = arrivals_of(timed.path, timed.route);
  return timed;
}

std::size_t TimedRoute::segment_at(double time_s) const {
  const auto later = std::upper_bound(path.begin(), path.end(), time_s,
                                      [](double t, const TimedWaypoint& w) { return t < w.time_s; });
  const auto index = static_cast<std::size_t>(later - path.begin());
  return std::min(std::max<std::size_t>(index, 1), path.size() - 1);
}

Spliced splice(const TimedRoute& old, const Splice& change, const VehicleLimits& limits) {
  const Vec3 leave = position_at(old.path, change.leave_s);
  const Vec3 rejoin = position_at(old.path, change.rejoin_s);
  const TimedWaypoint& leaving = old.path[old.segment_at(change.leave_s)];
  const TimedWaypoint& joining = old.path[old.segment_at(change.rejoin_s)];

  std::vector<RoutePoint> route;
  std::vector<RoutePoint> removed;
  const auto arrival_s = [&](std::size_t r) { return old.path[old.arrivals[r]].time_s; };
  std::size_t r = 0;
  for (; r < old.route.size() && arrival_s(r) <= change.leave_s; ++r) route.push_back(old.route[r]);
  route.push_back({leave, leaving.phase, leaving.leg_index, change.wait_s});
  const std::size_t first_new = route.size();
  for (const Vec3& p : change.points) route.push_back({p, Phase::kTransfer, joining.leg_index, 0.0});
  for (; r < old.route.size() && arrival_s(r) <= change.rejoin_s; ++r) {
    (change.keeps_between ? route : removed).push_back(old.route[r]);
  }
  const Phase arriving = change.keeps_between ? joining.phase : Phase::kTransfer;
  route.push_back({rejoin, arriving, joining.leg_index, 0.0});
  const std::size_t last_new = route.size() - 1;
  for (; r < old.route.size(); ++r) route.push_back(old.route[r]);
  const std::size_t marked =
      change.keeps_between ? 0 : keep_legs_counted(removed, route, first_new, last_new);

  // Timed once to learn when it leaves and rejoins; the corners that this added are then spelled out.
  const TimedPath path = time_route(old.start_m, old.start_time_s, route, limits);
  const std::vector<std::size_t> arrivals = arrivals_of(path, route);
  Spliced result;
  result.timed = TimedRoute::make(old.start_m, old.start_time_s, route, limits);
  result.leave_index = last_index_by(result.timed.path, path[arrivals[first_new - 1]].time_s);
  result.rejoin_index = last_index_by(result.timed.path, path[arrivals[last_new + marked]].time_s);
  if (!change.keeps_between) {
    double before_s = change.leave_s;
    for (std::size_t i = old.segment_at(change.leave_s); i < old.path.size() && before_s < change.rejoin_s;
         ++i) {
      const double until_s = std::min(old.path[i].time_s, change.rejoin_s);
      if (old.path[i].phase == Phase::kCover) {
        result.skipped_cover_m += (position_at(old.path, until_s) - position_at(old.path, before_s)).norm();
      }
      before_s = until_s;
    }
  }
  return result;
}

}  // namespace swallowtail::planner
