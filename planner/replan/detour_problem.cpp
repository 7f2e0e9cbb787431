#include "planner/replan/detour_problem.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace swallowtail::planner {
namespace {

/// e1 along the line; e2 level; any level e2 where the line is vertical.
Eigen::Matrix3d frame_along(const Vec3& line) {
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  const double length = line.norm();
  if (length == 0.0) return frame;
  const Vec3 e1 = line / length;
  const double level = std::hypot(e1.x(), e1.y());
  const Vec3 e2 = level > 1e-9 ? Vec3(-e1.y() / level, e1.x() / level, 0.0) : Vec3(Vec3::UnitY());
  frame.col(0) = e1;
  frame.col(1) = e2;
  frame.col(2) = e1.cross(e2);
  return frame;
}

bool is_vertical(const Vec3& direction) {
  return direction.head<2>().squaredNorm() <= kSamePlace_m * kSamePlace_m;
}

}  // namespace

double steepest_slope(const VehicleLimits& limits) { return std::tan(limits.climb_max_rad) * (1.0 - 1e-9); }

std::optional<Vec3> steep_corner(const Vec3& from, const Vec3& to, double steepest) {
  const Vec3 d = to - from;
  const double level = std::sqrt(d.x() * d.x() + d.y() * d.y());
  if (std::abs(d.z()) <= steepest * level || level <= kSamePlace_m) return std::nullopt;
  if (d.z() > 0.0) return Vec3(from.x(), from.y(), to.z() - steepest * level);
  return Vec3(to.x(), to.y(), from.z() - steepest * level);
}

std::vector<Vec3> as_flown(const std::vector<Vec3>& chain, double steepest) {
  std::vector<Vec3> flown;
  for (const Vec3& point : chain) {
    if (!flown.empty()) {
      if (const auto corner = steep_corner(flown.back(), point, steepest)) flown.push_back(*corner);
    }
    flown.push_back(point);
  }
  return flown;
}

DetourProblem::DetourProblem(const ObstacleField& field, const VehicleLimits& limits, const DetourEnds& ends,
                             int waypoints, DetourObjective objective)
    : field_(field),
      limits_(limits),
      ends_(ends),
      waypoints_(waypoints),
      objective_(objective),
      distance_m_(std::max((ends.to_m - ends.from_m).norm(), kSamePlace_m)),
      steepest_(steepest_slope(limits)),
      frame_(frame_along(ends.to_m - ends.from_m)) {
  size_box();
}

void DetourProblem::size_box() {
  constexpr double kLeast = 0.25;
  constexpr double kRoom = 1.6;
  constexpr double kHigherThanWide = 1.5;
  spread_ = kLeast;
  rise_ = kLeast;
  const double flight_s = distance_m_ / limits_.cruise_speed_mps;
  for (std::size_t i = 0; i < field_.size(); ++i) {
    if (!field_.near(i, ends_.from_m, ends_.from_time_s, ends_.to_m, ends_.from_time_s + flight_s, 0.0))
      continue;
    const auto reach = [&](Eigen::Index axis) {
      const Vec3 direction = frame_.col(axis);
      const double off = std::abs(direction.dot(field_.ball_center_m(i, ends_.from_time_s) - ends_.from_m));
      const double drift = field_.moves(i) ? field_.required_m(i) : 0.0;
      return kRoom * (off + drift + field_.half_width_m(i, direction) + field_.required_m(i)) / distance_m_;
    };
    spread_ = std::max(spread_, reach(1));
    rise_ = std::max(rise_, reach(2));
  }
  rise_ = std::min(rise_, kHigherThanWide * spread_);
}

swarm::Problem DetourProblem::in_box(double factor) const {
  swarm::Problem problem;
  const Vec3 half(0.5 * factor * std::min(spread_, rise_), factor * spread_, factor * rise_);
  problem.lower = Vec3(-half).replicate(waypoints_, 1);
  problem.upper = Vec3(half + Vec3::UnitX()).replicate(waypoints_, 1);
  problem.waypoints = swarm::WaypointLayout{Vec3::Zero(), Vec3::UnitX()};
  problem.evaluate = [this](swarm::Candidates x, swarm::Costs costs) {
    for (Eigen::Index i = 0; i < x.cols(); ++i) costs[i] = value(cost(x.col(i)));
  };
  return problem;
}

Vec3 DetourProblem::decode(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index waypoint) const {
  const Bounds& bounds = field_.world().bounds();
  const Vec3 p = ends_.from_m + frame_ * (distance_m_ * x.segment<3>(3 * waypoint));
  return p.cwiseMax(bounds.min_m).cwiseMin(bounds.max_m);
}

std::vector<Vec3> DetourProblem::decode(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  std::vector<Vec3> points;
  for (Eigen::Index i = 0; i < waypoints_; ++i) points.push_back(decode(x, i));
  return points;
}

Eigen::VectorXd DetourProblem::encode(const std::vector<Vec3>& waypoints) const {
  Eigen::VectorXd x(3 * waypoints_);
  for (Eigen::Index i = 0; i < waypoints_; ++i) {
    x.segment<3>(3 * i) =
        frame_.transpose() * (waypoints[static_cast<std::size_t>(i)] - ends_.from_m) / distance_m_;
  }
  return x;
}

/// A flight on its way along the hops.
struct DetourProblem::Progress {
  Vec3 at = Vec3::Zero();
  double time_s = 0.0;
  Vec3 direction = Vec3::Zero();
  bool was_vertical = false;
  Cost cost;
};

void DetourProblem::fly(Progress& progress, const Vec3& to) const {
  const Vec3 d = to - progress.at;
  const double length = d.norm();
  if (length <= kSamePlace_m) return;
  const bool vertical = is_vertical(d);
  const bool timed = objective_ == DetourObjective::kTime || field_.anything_moves();
  if (timed && progress.direction != Vec3::Zero()) {
    const double turn = std::atan2(progress.direction.cross(d).norm(), progress.direction.dot(d));
    if (turn > limits_.turn_max_rad || vertical != progress.was_vertical) {
      if (field_.anything_moves()) {
        progress.cost.violation_m +=
            field_.violation_m(progress.at, progress.time_s, progress.at, progress.time_s + kStopToTurn_s);
      }
      progress.time_s += kStopToTurn_s;
    }
  }
  const double climb = d.z() > 0.0 ? d.z() / limits_.climb_speed_mps : -d.z() / limits_.descent_speed_mps;
  const double duration = vertical ? climb : std::max(climb, length / limits_.cruise_speed_mps);
  progress.cost.violation_m +=
      field_.violation_m(progress.at, progress.time_s, to, progress.time_s + duration) +
      field_.terrain_violation_m(progress.at, to);
  progress.cost.length_m += length;
  progress.time_s += duration;
  progress.direction = d;
  progress.was_vertical = vertical;
  progress.at = to;
}

void DetourProblem::hop(Progress& progress, const Vec3& to) const {
  if (const auto corner = steep_corner(progress.at, to, steepest_)) fly(progress, *corner);
  fly(progress, to);
}

DetourProblem::Cost DetourProblem::finish(Progress& progress) const {
  hop(progress, ends_.to_m);
  if (ends_.after != Vec3::Zero() && progress.direction != Vec3::Zero()) {
    const double turn =
        std::atan2(progress.direction.cross(ends_.after).norm(), progress.direction.dot(ends_.after));
    if (turn > limits_.turn_max_rad) progress.time_s += kStopToTurn_s;
  }
  progress.cost.duration_s = progress.time_s - ends_.from_time_s;
  return progress.cost;
}

DetourProblem::Cost DetourProblem::cost(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  Progress progress{ends_.from_m, ends_.from_time_s, ends_.before, is_vertical(ends_.before), {}};
  for (Eigen::Index i = 0; i < waypoints_; ++i) hop(progress, decode(x, i));
  return finish(progress);
}

DetourProblem::Cost DetourProblem::cost(std::span<const Vec3> waypoints) const {
  Progress progress{ends_.from_m, ends_.from_time_s, ends_.before, is_vertical(ends_.before), {}};
  for (const Vec3& to : waypoints) hop(progress, to);
  return finish(progress);
}

double DetourProblem::value(const Cost& cost) const {
  const double way =
      objective_ == DetourObjective::kLength ? cost.length_m : cost.duration_s * limits_.cruise_speed_mps;
  return (way + kPenalty * cost.violation_m) / distance_m_;
}

std::vector<Vec3> resample(const Vec3& from, std::vector<Vec3> corners, const Vec3& to, int count) {
  const auto wanted = static_cast<std::size_t>(count);
  const auto point = [&](std::size_t i) { return i == 0 ? from : i > corners.size() ? to : corners[i - 1]; };
  while (corners.size() > wanted) {
    std::size_t least = 1;
    double least_use = 0.0;
    for (std::size_t i = 1; i <= corners.size(); ++i) {
      const double use = (point(i) - point(i - 1)).norm() + (point(i + 1) - point(i)).norm() -
                         (point(i + 1) - point(i - 1)).norm();
      if (i == 1 || use < least_use) {
        least = i;
        least_use = use;
      }
    }
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(least) - 1);
  }
  while (corners.size() < wanted) {
    std::size_t longest = 1;
    for (std::size_t i = 2; i <= corners.size() + 1; ++i) {
      if ((point(i) - point(i - 1)).norm() > (point(longest) - point(longest - 1)).norm()) longest = i;
    }
    corners.insert(corners.begin() + static_cast<std::ptrdiff_t>(longest) - 1,
                   0.5 * (point(longest - 1) + point(longest)));
  }
  return corners;
}

}  // namespace swallowtail::planner
