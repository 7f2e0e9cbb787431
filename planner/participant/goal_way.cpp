#include "planner/participant/goal_way.hpp"

#include <algorithm>
#include <limits>

#include "planner/replan/point_to_point.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kSame_m = 1e-6;

double distance_to_hop_m(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 hop = b - a;
  const double share =
      hop.squaredNorm() > 0.0 ? std::clamp((p - a).dot(hop) / hop.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + share * hop - p).norm();
}

}  // namespace

void GoalWay::search(const std::shared_ptr<const World>& world, const VehicleLimits& limits,
                     const Vec3& from_m, double time_s, const Vec3& goal_m, std::uint64_t seed,
                     const StopCondition& stop) {
  if (!leads_to(goal_m)) points_.clear();
  PlanRequest request;
  request.start_m = from_m;
  request.goal_m = goal_m;
  request.start_time_s = time_s;
  request.limits = limits;
  request.seed = seed;
  const auto report = plan_path(world, request, stop);
  if (!report || report->status != PlanStatus::kCertified) return;
  points_.clear();
  for (const TimedWaypoint& waypoint : report->path) {
    if (points_.empty() || (waypoint.position_m - points_.back()).norm() > kSame_m)
      points_.push_back(waypoint.position_m);
  }
  points_.back() = goal_m;
}

std::vector<Vec3> GoalWay::corners_ahead(const Vec3& position_m) const {
  std::size_t next = points_.size();
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double away_m = distance_to_hop_m(position_m, points_[i - 1], points_[i]);
    if (away_m > nearest_m) continue;
    nearest_m = away_m;
    next = i;
  }
  std::vector<Vec3> corners;
  for (std::size_t i = next; i + 1 < points_.size(); ++i) corners.push_back(points_[i]);
  return corners;
}

}  // namespace swallowtail::planner
