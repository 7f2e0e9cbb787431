#include "planner/cost/repair.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/base/checks.hpp"

namespace swallowtail::planner {
namespace {

constexpr int kSweeps = 100;
constexpr double kTolerance = 1e-9;
/// Repaired to a little less than the limits, so that rounding does not break them.
constexpr double kWithin = 1.0 - 1e-10;

double turn_rad(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 before = b - a;
  const Vec3 after = c - b;
  return std::atan2(before.cross(after).norm(), before.dot(after));
}

double climb_rad(const Vec3& a, const Vec3& b) {
  return std::atan2(std::abs(b.z() - a.z()), (b - a).head<2>().norm());
}

Status check(std::span<const Vec3> polyline, const KinematicLimits& limits) {
  if (polyline.size() < 2) return bad_input("A path to repair needs at least its two ends.");
  if (!std::ranges::all_of(polyline, [](const Vec3& p) { return is_finite(p); })) {
    return bad_input("A point of the path to repair is not finite.");
  }
  if (!(is_positive(limits.turn_max_rad) && limits.turn_max_rad <= std::numbers::pi)) {
    return bad_input("The turn limit is " + std::to_string(limits.turn_max_rad) +
                     " rad; it must be above 0, at most π.");
  }
  if (!(is_positive(limits.climb_max_rad) && limits.climb_max_rad <= 0.5 * std::numbers::pi)) {
    return bad_input("The climb limit is " + std::to_string(limits.climb_max_rad) +
                     " rad; it must be above 0, at most π/2.");
  }
  if (!is_non_negative(limits.segment_min_m)) {
    return bad_input("The shortest segment is " + std::to_string(limits.segment_min_m) +
                     " m; it must be at least 0.");
  }
  return {};
}

class Repair {
 public:
  Repair(std::span<const Vec3> polyline, const KinematicLimits& limits)
      : limits_(limits), points_(polyline.begin(), polyline.end()) {}

  std::vector<Vec3> run() {
    for (int sweep = 0; sweep < kSweeps && !keeps(limits_, points_); ++sweep) {
      leave_out_the_near();
      level_out();
      straighten();
    }
    if (!keeps(limits_, points_)) points_ = {points_.front(), points_.back()};
    return std::move(points_);
  }

 private:
  void leave_out_the_near() {
    std::vector<Vec3> kept = {points_.front()};
    const auto near = [this](const Vec3& a, const Vec3& b) {
      const double distance = (b - a).norm();
      return distance < limits_.segment_min_m || distance == 0.0;
    };
    for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
      if (!near(kept.back(), points_[i])) kept.push_back(points_[i]);
    }
    while (kept.size() > 1 && near(kept.back(), points_.back())) kept.pop_back();
    kept.push_back(points_.back());
    points_ = std::move(kept);
  }

  /// Heights within what the slope allows from the goal backwards, then from the start on. Where the straight
  /// line keeps the climb limit a longer way does so the more, and the second pass leaves the goal in reach.
  void level_out() {
    if (limits_.climb_max_rad >= 0.5 * std::numbers::pi) return;
    const double slope = std::tan(limits_.climb_max_rad) * kWithin;
    const auto reach = [&](std::size_t i) { return slope * (points_[i + 1] - points_[i]).head<2>().norm(); };
    std::vector<double> lowest(points_.size());
    std::vector<double> highest(points_.size());
    lowest.back() = highest.back() = points_.back().z();
    for (std::size_t i = points_.size() - 1; i-- > 0;) {
      lowest[i] = lowest[i + 1] - reach(i);
      highest[i] = highest[i + 1] + reach(i);
    }
    for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
      const double before = points_[i - 1].z();
      const double low = std::max(lowest[i], before - reach(i - 1));
      const double high = std::min(highest[i], before + reach(i - 1));
      points_[i].z() = low <= high ? std::clamp(points_[i].z(), low, high) : 0.5 * (low + high);
    }
  }

  void straighten() {
    const double most = limits_.turn_max_rad * kWithin;
    for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
      if (turn_rad(points_[i - 1], points_[i], points_[i + 1]) <= limits_.turn_max_rad) continue;
      const Vec3 corner = points_[i];
      const Vec3 middle = 0.5 * (points_[i - 1] + points_[i + 1]);
      double sharp = 0.0;
      double blunt = 1.0;
      for (int k = 0; k < 50; ++k) {
        const double share = 0.5 * (sharp + blunt);
        const Vec3 moved = corner + share * (middle - corner);
        (turn_rad(points_[i - 1], moved, points_[i + 1]) > most ? sharp : blunt) = share;
      }
      points_[i] = corner + blunt * (middle - corner);
    }
  }

  const KinematicLimits& limits_;
  std::vector<Vec3> points_;
};

}  // namespace

bool keeps(const KinematicLimits& limits, std::span<const Vec3> polyline) {
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    const Vec3& a = polyline[i - 1];
    const Vec3& b = polyline[i];
    if ((b - a).norm() < limits.segment_min_m * (1.0 - kTolerance) || a == b) return false;
    if (climb_rad(a, b) > limits.climb_max_rad * (1.0 + kTolerance)) return false;
    if (i + 1 < polyline.size() &&
        turn_rad(a, b, polyline[i + 1]) > limits.turn_max_rad * (1.0 + kTolerance)) {
      return false;
    }
  }
  return true;
}

Result<std::vector<Vec3>> repair(std::span<const Vec3> polyline, const KinematicLimits& limits) {
  if (Status status = check(polyline, limits); !status) return status.error();
  const std::vector<Vec3> straight = {polyline.front(), polyline.back()};
  if (!keeps(limits, straight)) {
    return infeasible("The ends are " + std::to_string((straight[1] - straight[0]).norm()) +
                      " m apart at a climb of " + std::to_string(climb_rad(straight[0], straight[1])) +
                      " rad; no repair reaches the shortest segment and the climb limit.");
  }
  return Repair(polyline, limits).run();
}

}  // namespace swallowtail::planner
