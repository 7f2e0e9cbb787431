#include "planner/replan/replanner.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planner/base/checks.hpp"
#include "planner/replan/contingency.hpp"
#include "planner/replan/route_repair.hpp"

namespace swallowtail::planner {
namespace {

std::string by_what(const Violation& violation) {
  if (violation.kind == ViolationKind::kObstacle) return "obstacle " + std::to_string(violation.obstacle_id);
  if (violation.kind == ViolationKind::kTerrain) return "the ground";
  return name(violation.kind);
}

/// The direction flown first; zero if nothing is.
Vec3 first_direction(const Vec3& start, const std::vector<RoutePoint>& route) {
  for (const RoutePoint& point : route) {
    if (point.dwell_s >= kStopToTurn_s && (point.position_m - start).norm() <= kSamePlace_m)
      return Vec3::Zero();
    if ((point.position_m - start).norm() > kSamePlace_m) return point.position_m - start;
  }
  return Vec3::Zero();
}

/// A stop first if the route begins with a turn that cannot be flown from the velocity at the start.
std::vector<RoutePoint> with_first_stop(const ReplanRequest& request, std::vector<RoutePoint> route,
                                        const VehicleLimits& limits) {
  const Vec3 direction = first_direction(request.start_m, route);
  const Vec3& velocity = request.start_velocity_mps;
  if (velocity.norm() < 1e-3 || direction == Vec3::Zero()) return route;
  const bool vertical = velocity.head<2>().norm() <= 1e-6 || direction.head<2>().norm() <= kSamePlace_m;
  const double turn = std::atan2(velocity.cross(direction).norm(), velocity.dot(direction));
  if (turn <= limits.turn_max_rad && !(vertical && turn > 1e-6)) return route;
  // A little longer than a turn needs: a stop that the timing would not add by itself.
  route.insert(route.begin(),
               {request.start_m, route.front().phase, route.front().leg_index, 1.01 * kStopToTurn_s});
  return route;
}

Status validate(const ReplanRequest& request) {
  if (request.route.empty()) return bad_input("The route is empty.");
  bool finite =
      is_finite(request.start_m) && is_finite(request.start_time_s) && is_finite(request.start_velocity_mps);
  for (const RoutePoint& point : request.route) {
    finite = finite && is_finite(point.position_m) && is_within(point.dwell_s, 0.0, 1e6);
  }
  if (!finite) return bad_input("The start or a route point is not finite, or a dwell is out of range.");
  return {};
}

}  // namespace

struct Replanner::Impl {
  VehicleLimits limits;
  Params params;
  const Clock* clock = nullptr;
  TimedPath previous;

  ReplanReport plan(std::shared_ptr<const World> world, const ReplanRequest& request,
                    const StopCondition& stop) {
    ReplanReport report;
    for (const Status& status :
         {validate(limits), swallowtail::planner::validate(params), validate(request)}) {
      if (!status) {
        report.reason = status.error().message;
        return report;
      }
    }
    if (world == nullptr) {
      report.reason = "There is no world yet.";
      return report;
    }
    const ClearanceQuery query(world);
    TimedRoute timed = TimedRoute::make(request.start_m, request.start_time_s,
                                        with_first_stop(request, request.route, limits), limits);
    RouteRepair repair(world, query, limits, params, stop, previous);
    const bool repaired = repair.repair(timed);
    report.evaluations = repair.evaluations();
    report.detours = repair.detours();
    report.waits = repair.waits();
    report.skipped_cover_m = repair.skipped_cover_m();
    report.goal_is_blocked = repair.goal_is_blocked();
    if (repaired) {
      // A way round that begins at the start may have taken the first stop's place, or need one.
      std::vector<RoutePoint> stopped = with_first_stop(request, timed.route, limits);
      if (stopped.size() > timed.route.size())
        timed = TimedRoute::make(request.start_m, request.start_time_s, stopped, limits);
      report.certificate = certify(timed.path, query, limits);
      if (report.certificate.certified) {
        report.verdict = Verdict::kCertified;
        report.path = std::move(timed.path);
        report.reason = repair.summary().empty() ? "route is clear" : repair.summary();
      }
    }
    if (report.verdict != Verdict::kCertified) fall_back(query, timed, repair, report);
    if (!report.path.empty()) {
      report.lands = report.path.back().phase == Phase::kLanding;
      previous = report.path;
    }
    return report;
  }

  void fall_back(const ClearanceQuery& query, const TimedRoute& timed, const RouteRepair& repair,
                 ReplanReport& report) const {
    const std::string why = repair.goal_is_blocked() ? "goal blocked by " + by_what(repair.blocked())
                            : repair.out_of_time()   ? "out of time at " + by_what(repair.blocked())
                                                     : "blocked by " + by_what(repair.blocked());
    const TimedPath& path = timed.path;
    const std::size_t segment = std::min(repair.blocked().segment, path.size() - 1);
    const double begins_s = segment > 0 ? path[segment - 1].time_s : path.front().time_s;
    const double blocked_s = std::clamp(repair.blocked().time_s, begins_s, path[segment].time_s);
    Contingency contingency = find_contingency({query, limits, path, blocked_s, params.hold_s});
    if (!contingency.found) {
      report.verdict = Verdict::kNoSafePath;
      report.reason = why + ", no safe hold";
      report.certificate = certify(path, query, limits);
      return;
    }
    report.verdict = Verdict::kContingency;
    report.reason = why + ", " + contingency.what;
    report.path = std::move(contingency.path);
    report.certificate = std::move(contingency.certificate);
  }
};

Status validate(const Replanner::Params& params) {
  if (params.detour_waypoints < 1 || params.detour_waypoints > 32) {
    return bad_input("The replanner's detour_waypoints must be 1 to 32.");
  }
  if (params.population < 3 || params.population > 10000) {
    return bad_input("The replanner's population must be 3 to 10000.");
  }
  if (!is_within(params.max_wait_s, 0.0, 3600.0))
    return bad_input("The replanner's max_wait_s must be 0 to 3600.");
  if (!is_within(params.hold_s, 0.0, 3600.0)) return bad_input("The replanner's hold_s must be 0 to 3600.");
  return {};
}

Replanner::Replanner(const VehicleLimits& limits, const Params& params, const Clock* clock)
    : impl_(std::make_unique<Impl>(Impl{limits, params, clock, {}})) {}
Replanner::~Replanner() = default;
Replanner::Replanner(Replanner&&) noexcept = default;
Replanner& Replanner::operator=(Replanner&&) noexcept = default;

ReplanReport Replanner::plan(std::shared_ptr<const World> world, const ReplanRequest& request,
                             const StopCondition& stop) {
  const double started_s = impl_->clock != nullptr ? impl_->clock->now_s() : 0.0;
  ReplanReport report = impl_->plan(std::move(world), request, stop);
  if (impl_->clock != nullptr) report.wall_ms = 1e3 * (impl_->clock->now_s() - started_s);
  return report;
}

}  // namespace swallowtail::planner
