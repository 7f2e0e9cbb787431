#include "coverage/maintain/path_ahead.hpp"

#include <algorithm>
#include <limits>

namespace swallowtail::coverage {

void PathAhead::join(const PathView& path, double now_s) {
  coverage_revision_ = path.coverage_revision;
  lands_ = path.lands;
  const double begin_s = path.waypoints.front().time_s;
  std::erase_if(path_, [&](const planner::TimedWaypoint& w) { return w.time_s >= begin_s; });
  const auto ahead = std::ranges::upper_bound(path_, now_s, {}, &planner::TimedWaypoint::time_s);
  if (ahead - path_.begin() > 1) path_.erase(path_.begin(), ahead - 1);
  path_.insert(path_.end(), path.waypoints.begin(), path.waypoints.end());
}

FlightCost PathAhead::cost(const FlightModel& model, double from_s, double to_s) const {
  FlightCost out;
  const auto fly = [&](const Vec3& from_m, const Vec3& to_m, double duration_s) {
    if (!(duration_s > 0.0)) return;
    const Vec3 way = to_m - from_m;
    const double energy = duration_s * model.power(way / duration_s, 0.5 * (from_m.z() + to_m.z()));
    out += {duration_s, energy, way.norm()};
  };
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const double begin_s = std::max(from_s, path_[i - 1].time_s);
    const double until_s = std::min(to_s, path_[i].time_s);
    if (until_s > begin_s) fly(position_m(begin_s), position_m(until_s), until_s - begin_s);
  }
  if (!lands_) fly(path_.back().position_m, path_.back().position_m, to_s - std::max(from_s, end_s()));
  return out;
}

std::size_t PathAhead::legs_begun(std::size_t first, double time_s) const {
  std::size_t out = 0;
  for (std::size_t i = 1; i < path_.size() && path_[i - 1].time_s < time_s; ++i) {
    const planner::TimedWaypoint& to = path_[i];
    if (to.leg_index < first) continue;
    // On its way to a leg it has flown those before.
    const std::size_t before = to.leg_index - first;
    out = std::max(out, to.phase == planner::Phase::kCover ? before + 1 : before);
  }
  return out;
}

double PathAhead::leg_end_s(std::size_t leg) const {
  double out = -std::numeric_limits<double>::infinity();
  for (const planner::TimedWaypoint& w : path_) {
    if (w.phase == planner::Phase::kCover && w.leg_index == leg) out = w.time_s;
  }
  return out;
}

}  // namespace swallowtail::coverage
