#include "tools/bench/plan/judge.hpp"

#include <algorithm>

#include "planner/path/certifier.hpp"

namespace swallowtail::bench {
namespace {

/// Up to so many obstacles one after the other with an early end is faster than eight lanes of one segment.
constexpr std::size_t kFewObstacles = 64;

void put(planner::LanePoint& lanes, Eigen::Index lane, const Vec3& p) {
  lanes.x[lane] = p.x();
  lanes.y[lane] = p.y();
  lanes.z[lane] = p.z();
}

planner::ObstacleField field_of(const PlanCase& plan_case) {
  planner::ObstacleField field(plan_case.world, plan_case.limits);
  field.set_slope_share(1.0);
  return field;
}

}  // namespace

Judge::Judge(const PlanCase& plan_case) : case_(plan_case), field_(field_of(plan_case)), batch_(field_) {}

bool Judge::free(const Vec3& a, const Vec3& b) const {
  const planner::Bounds& bounds = case_.world->bounds();
  if (!bounds.contains(a) || !bounds.contains(b)) return false;
  if (field_.size() <= kFewObstacles) {
    for (std::size_t i = 0; i < field_.size(); ++i) {
      if (field_.near(i, a, 0.0, b, 0.0, 0.0) && field_.violation_m(i, a, 0.0, b, 0.0) > 0.0) return false;
    }
  } else {
    planner::LanePoint from;
    planner::LanePoint to;
    for (Eigen::Index lane = 0; lane < planner::kLanes; ++lane) {
      put(from, lane, a);
      put(to, lane, b);
    }
    planner::Lanes violation = planner::Lanes::Zero();
    batch_.add_violation(from, to, violation);
    if (violation[0] > 0.0) return false;
  }
  return field_.terrain_violation_m(a, b) <= 0.0;
}

bool Judge::free(std::span<const Vec3> polyline) const {
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    if (!free(polyline[i - 1], polyline[i])) return false;
  }
  return true;
}

Judge::Penalised Judge::penalised(std::span<const Vec3> polyline) const {
  Penalised out;
  planner::LanePoint a;
  planner::LanePoint b;
  const auto hops = static_cast<Eigen::Index>(polyline.size()) - 1;
  for (Eigen::Index first = 0; first < hops; first += planner::kLanes) {
    const Eigen::Index count = std::min<Eigen::Index>(planner::kLanes, hops - first);
    for (Eigen::Index lane = 0; lane < planner::kLanes; ++lane) {
      const auto hop = static_cast<std::size_t>(first + std::min(lane, count - 1));
      put(a, lane, polyline[hop]);
      put(b, lane, polyline[hop + 1]);
    }
    planner::Lanes length = planner::Lanes::Zero();
    planner::Lanes violation = planner::Lanes::Zero();
    planner::BatchField::add_length(a, b, length);
    batch_.add_violation(a, b, violation);
    batch_.add_terrain_violation(a, b, violation);
    out.length_m += length.head(count).sum();
    out.violation_m += violation.head(count).sum();
  }
  return out;
}

double length_of(std::span<const Vec3> polyline) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < polyline.size(); ++i) length_m += (polyline[i] - polyline[i - 1]).norm();
  return length_m;
}

std::string refusal_of(const PlanCase& plan_case, std::span<const Vec3> polyline) {
  constexpr double kEndTolerance_m = 1e-9;
  if (polyline.size() < 2) return "it has no path";
  if ((polyline.front() - plan_case.start_m).norm() > kEndTolerance_m ||
      (polyline.back() - plan_case.goal_m).norm() > kEndTolerance_m)
    return "it does not lead from start to goal";
  std::vector<planner::RoutePoint> route;
  for (const Vec3& p : polyline.subspan(1)) route.push_back({p, planner::Phase::kTransfer, 0, 0.0});
  const planner::TimedPath path = planner::time_route(polyline.front(), 0.0, route, plan_case.limits);
  const planner::Certificate certificate =
      planner::certify(path, planner::ClearanceQuery(plan_case.world), plan_case.limits);
  if (certificate.certified) return {};
  return certificate.violations.empty() ? "the certifier refuses it" : certificate.violations.front().detail;
}

}  // namespace swallowtail::bench
