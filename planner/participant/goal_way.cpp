#include "planner/participant/goal_way.hpp"

#include "planner/participant/sortie.hpp"
#include "planner/replan/point_to_point.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kSame_m = 1e-6;

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
  return planner::corners_ahead(points_, position_m);
}

}  // namespace swallowtail::planner
