#include "planner/path/path.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/checks.hpp"

namespace swallowtail::planner {
namespace {

/// Limits are kept with this much to spare, so that rounding of times does not break them.
constexpr double kSpare = 1e-9;
/// Shorter moves take this long: differences of times lose digits.
constexpr double kShortestMove_s = 1e-3;
constexpr double kTimeDigits = 1e7 * std::numeric_limits<double>::epsilon();

bool is_vertical(const Vec3& move) { return move.head<2>().norm() <= kSamePlace_m; }
bool is_stop(const Vec3& move) { return move.norm() <= kSamePlace_m; }

double climb_angle(const Vec3& move) { return std::atan2(std::abs(move.z()), move.head<2>().norm()); }

double move_duration_s(const Vec3& move, double now_s, const VehicleLimits& limits) {
  const double vertical =
      std::abs(move.z()) / (move.z() > 0.0 ? limits.climb_speed_mps : limits.descent_speed_mps);
  const double level = is_vertical(move) ? 0.0 : move.norm() / limits.cruise_speed_mps;
  return std::max(
      {std::max(vertical, level) * (1.0 + kSpare), kShortestMove_s, kTimeDigits * std::abs(now_s)});
}

bool needs_stop(const Vec3& before, const Vec3& after, const VehicleLimits& limits) {
  if (is_vertical(before) != is_vertical(after)) return true;
  return std::atan2(before.cross(after).norm(), before.dot(after)) > limits.turn_max_rad;
}

/// Lays waypoints one after the other and keeps what the next one needs to know.
class Timeline {
 public:
  Timeline(const TimedWaypoint& start, const VehicleLimits& limits) : path_{start}, limits_(limits) {}

  void fly_to(const Vec3& to_m, const RoutePoint& via) {
    const Vec3 move = to_m - path_.back().position_m;
    if (!is_stop(move)) {
      if (has_flown_ && stopped_s_ < kStopToTurn_s && needs_stop(last_move_, move, limits_)) {
        const TimedWaypoint& here = path_.back();
        stop(kStopToTurn_s - stopped_s_, here.phase, here.leg_index);
      }
      const double now_s = path_.back().time_s;
      append(now_s + move_duration_s(move, now_s, limits_), to_m, via);
      last_move_ = move;
      has_flown_ = true;
      stopped_s_ = 0.0;
    } else {
      append(path_.back().time_s, to_m, via);
    }
  }

  void stop(double duration_s, Phase phase, std::uint32_t leg_index) {
    TimedWaypoint here = path_.back();
    here.time_s += duration_s;
    here.phase = phase;
    here.leg_index = leg_index;
    path_.push_back(here);
    stopped_s_ += duration_s;
  }

  const Vec3& position_m() const { return path_.back().position_m; }
  TimedPath take() && { return std::move(path_); }

 private:
  void append(double time_s, const Vec3& to_m, const RoutePoint& via) {
    path_.push_back({time_s, to_m, via.phase, via.leg_index});
  }

  TimedPath path_;
  const VehicleLimits& limits_;
  Vec3 last_move_ = Vec3::Zero();
  bool has_flown_ = false;
  double stopped_s_ = 0.0;
};

}  // namespace

Status validate(const VehicleLimits& limits) {
  const auto fault = [](const char* what, double value, const char* rule) {
    return bad_input(fmt::format("The vehicle's {} is {}; it must be {}.", what, value, rule));
  };
  if (!is_non_negative(limits.radius_m)) return fault("radius_m", limits.radius_m, "finite and not negative");
  if (!is_non_negative(limits.margin_m)) return fault("margin_m", limits.margin_m, "finite and not negative");
  if (!is_positive(limits.clearance_m()))
    return fault("radius_m + margin_m", limits.clearance_m(), "positive");
  if (!is_positive(limits.cruise_speed_mps))
    return fault("cruise_speed_mps", limits.cruise_speed_mps, "positive and finite");
  if (!is_positive(limits.climb_speed_mps))
    return fault("climb_speed_mps", limits.climb_speed_mps, "positive and finite");
  if (!is_positive(limits.descent_speed_mps))
    return fault("descent_speed_mps", limits.descent_speed_mps, "positive and finite");
  if (!is_within(limits.turn_max_rad, 0.0, std::numbers::pi))
    return fault("turn_max_rad", limits.turn_max_rad, "within 0 … π");
  if (!is_within(limits.climb_max_rad, 0.0, std::numbers::pi / 2.0)) {
    return fault("climb_max_rad", limits.climb_max_rad, "within 0 … π/2");
  }
  return {};
}

Vec3 position_at(const TimedPath& path, double time_s) {
  if (path.empty()) return Vec3::Zero();
  const auto later =
      std::upper_bound(path.begin(), path.end(), time_s,
                       [](double t, const TimedWaypoint& waypoint) { return t < waypoint.time_s; });
  if (later == path.begin()) return path.front().position_m;
  if (later == path.end()) return path.back().position_m;
  const TimedWaypoint& from = *(later - 1);
  const double share = (time_s - from.time_s) / (later->time_s - from.time_s);
  return from.position_m + (later->position_m - from.position_m) * share;
}

double length_m(const TimedPath& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
    length += (path[i].position_m - path[i - 1].position_m).norm();
  return length;
}

TimedPath time_route(const Vec3& start, double start_time_s, const std::vector<RoutePoint>& route,
                     const VehicleLimits& limits) {
  TimedWaypoint first{start_time_s, start, Phase::kTransfer, 0};
  if (!route.empty()) {
    first.phase = route.front().phase;
    first.leg_index = route.front().leg_index;
  }
  Timeline timeline(first, limits);
  for (const RoutePoint& point : route) {
    const Vec3 from = timeline.position_m();
    const Vec3 move = point.position_m - from;
    if (!is_vertical(move) && climb_angle(move) > limits.climb_max_rad) {
      const bool climbs = move.z() > 0.0;
      timeline.fly_to(climbs ? Vec3(from.x(), from.y(), point.position_m.z())
                             : Vec3(point.position_m.x(), point.position_m.y(), from.z()),
                      point);
    }
    timeline.fly_to(point.position_m, point);
    if (point.dwell_s > 0.0) timeline.stop(point.dwell_s, point.phase, point.leg_index);
  }
  return std::move(timeline).take();
}

}  // namespace swallowtail::planner
