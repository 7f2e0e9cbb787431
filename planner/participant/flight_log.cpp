#include "planner/participant/flight_log.hpp"

#include <algorithm>

namespace swallowtail::planner {
namespace {

constexpr double kAtEntry_m = 0.5;

}  // namespace

void FlightLog::clear() {
  path_.clear();
  begun_leg_.reset();
}

void FlightLog::join(const TimedPath& plan, double now_s) {
  TimedPath merged;
  begin_s_ = plan.front().time_s;
  for (std::size_t i = 0; i < path_.size() && path_[i].time_s < begin_s_; ++i) {
    const bool is_past = i + 1 < path_.size() && path_[i + 1].time_s < now_s;
    if (!is_past) merged.push_back(path_[i]);
  }
  merged.insert(merged.end(), plan.begin(), plan.end());
  // Up to where the plan begins the vehicle flies what it flew before.
  if (!path_.empty() && merged.size() > plan.size()) {
    const TimedWaypoint before = target(begin_s_);
    TimedWaypoint& seam = merged[merged.size() - plan.size()];
    seam.phase = before.phase;
    seam.leg_index = before.leg_index;
  }
  path_ = std::move(merged);
}

Vec3 FlightLog::velocity(double time_s) const {
  for (std::size_t i = 1; i < path_.size(); ++i) {
    if (path_[i].time_s <= time_s || path_[i - 1].time_s > time_s) continue;
    const double duration_s = path_[i].time_s - path_[i - 1].time_s;
    return (path_[i].position_m - path_[i - 1].position_m) / duration_s;
  }
  return Vec3::Zero();
}

double FlightLog::join_time_s(double time_s) const {
  if (path_.empty()) return time_s;
  std::optional<double> stopped_s;
  for (std::size_t i = 1; i < path_.size() && path_[i - 1].time_s <= time_s; ++i) {
    const bool stands = path_[i].position_m == path_[i - 1].position_m;
    if (!stands) stopped_s.reset();
    if (stands && !stopped_s) stopped_s = path_[i - 1].time_s;
    if (path_[i].time_s <= time_s) continue;
    return stands ? std::max(time_s, std::min(path_[i].time_s, *stopped_s + kStopToTurn_s)) : time_s;
  }
  return std::max(time_s, stopped_s.value_or(path_.back().time_s) + kStopToTurn_s);
}

const TimedWaypoint& FlightLog::target(double time_s) const {
  for (const TimedWaypoint& w : path_) {
    if (w.time_s > time_s) return w;
  }
  return path_.back();
}

TimedPath FlightLog::rest(double time_s) const {
  const TimedWaypoint& next = target(time_s);
  TimedPath rest{{std::max(time_s, path_.front().time_s), position(time_s), next.phase, next.leg_index}};
  for (const TimedWaypoint& w : path_) {
    if (w.time_s > rest.front().time_s) rest.push_back(w);
  }
  return rest;
}

bool FlightLog::covers_later(std::uint32_t leg, double time_s) const {
  return std::any_of(path_.begin(), path_.end(), [&](const TimedWaypoint& w) {
    return w.time_s > time_s && w.phase == Phase::kCover && w.leg_index == leg;
  });
}

void FlightLog::note(double time_s) {
  if (path_.empty()) return;
  const TimedWaypoint& flown = target(time_s);
  if (flown.phase == Phase::kCover && flown.time_s > time_s) begun_leg_ = flown.leg_index;
}

bool FlightLog::has_begun(std::uint32_t leg, const Vec3& entry, double time_s) const {
  if (begun_leg_ == leg) return true;
  if (path_.empty()) return false;
  const TimedWaypoint& flown = target(time_s);
  if (flown.phase == Phase::kCover && flown.leg_index == leg) return true;
  return std::any_of(path_.begin(), path_.end(), [&](const TimedWaypoint& w) {
    const bool at_entry = (w.position_m - entry).norm() <= kAtEntry_m;
    return w.time_s <= time_s && w.leg_index == leg && (w.phase == Phase::kCover || at_entry);
  });
}

}  // namespace swallowtail::planner
