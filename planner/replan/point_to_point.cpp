#include "planner/replan/point_to_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "planner/base/checks.hpp"

namespace swallowtail::planner {
namespace {

/// How steep the ground is taken to be, tried in this order while the certifier refuses what the search
/// finds.
constexpr std::array kSlopeShares{0.0, 0.4, 1.0};

std::vector<RoutePoint> route_of(const std::vector<Vec3>& waypoints, const Vec3& goal) {
  std::vector<RoutePoint> route;
  for (const Vec3& p : waypoints) route.push_back({p, Phase::kTransfer, 0, 0.0});
  route.push_back({goal, Phase::kTransfer, 0, 0.0});
  return route;
}

std::string by_what(const Violation& violation) {
  if (violation.kind == ViolationKind::kObstacle) return "obstacle " + std::to_string(violation.obstacle_id);
  if (violation.kind == ViolationKind::kTerrain) return "the ground";
  return name(violation.kind);
}

class PointToPoint {
 public:
  PointToPoint(std::shared_ptr<const World> world, const PlanRequest& request, const StopCondition& stop,
               const Clock* clock, const std::function<void(const PlanProgress&)>& observer)
      : world_(std::move(world)),
        query_(world_),
        request_(request),
        stop_(stop),
        clock_(clock),
        observer_(observer),
        started_s_(clock != nullptr ? clock->now_s() : 0.0) {
    constexpr auto kUnlimited = std::numeric_limits<std::uint64_t>::max();
    const bool timed = stop.clock != nullptr && std::isfinite(stop.deadline_s);
    if (stop.max_evaluations == kUnlimited && !timed) stop_.max_evaluations = kDefaultEvaluations;
    if (stop.max_iterations != kUnlimited) {
      const auto population = static_cast<std::uint64_t>(request.params.population);
      const std::uint64_t per_iterations =
          stop.max_iterations > kUnlimited / population ? kUnlimited : stop.max_iterations * population;
      stop_.max_evaluations = std::min(stop_.max_evaluations, per_iterations);
      stop_.max_iterations = kUnlimited;
    }
  }

  Result<PlanReport> run() {
    if (!ends_are_free()) return finish();
    if (offer({}, 1.0, 1)) {
      report_.evaluations = 1;
      report_.reason = "The straight line is clear.";
      return finish();
    }
    report_.evaluations = 1;
    for (const double share : kSlopeShares) {
      Result<bool> searched = search(share);
      if (!searched) return searched.error();
      if (report_.status == PlanStatus::kCertified || world_->terrain().is_flat()) break;
    }
    if (report_.status == PlanStatus::kCertified) return finish();
    if (stop_.interrupted()) {
      report_.status = PlanStatus::kInterrupted;
      report_.reason = "Interrupted before anything certified was found.";
    } else {
      report_.reason = "None found in budget: no path was certified within " +
                       std::to_string(report_.evaluations) +
                       " evaluations; the straight line is blocked by " + blocked_by_ + ".";
    }
    return finish();
  }

 private:
  double wall_ms() const { return clock_ != nullptr ? 1e3 * (clock_->now_s() - started_s_) : 0.0; }

  bool point_is_free(const Vec3& p, double time_s, PlanStatus status, const char* what) {
    if (!world_->bounds().contains(p)) {
      report_.status = PlanStatus::kOutOfBounds;
      report_.reason = std::string("The ") + what + " lies outside the bounds.";
      return false;
    }
    const Certificate certificate = certify({{time_s, p, Phase::kTransfer, 0}}, query_, request_.limits);
    if (certificate.certified || certificate.violations.empty()) return true;
    report_.status = status;
    report_.certificate = certificate;
    report_.reason =
        std::string("The ") + what + " is blocked by " + by_what(certificate.violations.front()) + ".";
    return false;
  }

  bool ends_are_free() {
    if (!point_is_free(request_.start_m, request_.start_time_s, PlanStatus::kStartBlocked, "start"))
      return false;
    // A goal that something moving covers now may be free on arrival; only what stands decides beforehand.
    std::vector<Obstacle> standing;
    for (const Obstacle& obstacle : world_->obstacles()) {
      if (!obstacle.moves() && std::isinf(obstacle.valid_until_s)) standing.push_back(obstacle);
    }
    if (standing.size() == world_->obstacles().size()) {
      return point_is_free(request_.goal_m, request_.start_time_s, PlanStatus::kGoalBlocked, "goal");
    }
    Result<std::shared_ptr<const World>> still = World::make(world_->terrain(), standing, world_->bounds());
    if (!still) return true;
    query_ = ClearanceQuery(*still);
    const bool free = point_is_free(request_.goal_m, request_.start_time_s, PlanStatus::kGoalBlocked, "goal");
    query_ = ClearanceQuery(world_);
    return free;
  }

  /// Certifies a path; keeps it if it is shorter than the best.
  bool offer(const std::vector<Vec3>& waypoints, double cost, std::uint64_t evaluations) {
    TimedPath path = time_route(request_.start_m, request_.start_time_s, route_of(waypoints, request_.goal_m),
                                request_.limits);
    Certificate certificate = certify(path, query_, request_.limits);
    if (!certificate.certified) {
      if (waypoints.empty()) {
        report_.certificate = certificate;
        if (!certificate.violations.empty()) blocked_by_ = by_what(certificate.violations.front());
      }
      return false;
    }
    const double length = length_m(path);
    const bool first = report_.status != PlanStatus::kCertified;
    if (!first && length >= report_.length_m) return true;
    report_.status = PlanStatus::kCertified;
    report_.length_m = length;
    report_.duration_s = path.back().time_s - path.front().time_s;
    report_.path = std::move(path);
    report_.certificate = std::move(certificate);
    report_.cost = cost;
    if (first) report_.first_certified_ms = wall_ms();
    report_.history.push_back({evaluations, wall_ms(), length});
    if (observer_) observer_(report_.history.back());
    return true;
  }

  Result<bool> search(double slope_share) {
    if (report_.evaluations >= stop_.max_evaluations) return true;
    ObstacleField field(world_, request_.limits);
    field.set_slope_share(slope_share);
    const DetourEnds ends{request_.start_m, request_.goal_m, request_.start_time_s, Vec3::Zero(),
                          Vec3::Zero()};
    const DetourProblem problem(field, request_.limits, ends, request_.params.waypoints,
                                DetourObjective::kLength);
    CorridorParams params;
    params.algorithm = request_.params.algorithm;
    params.population = request_.params.population;
    params.settings = request_.params.settings;
    params.parts = request_.params.parts;
    StopCondition stop = stop_;
    stop.max_evaluations -= report_.evaluations;
    // With steeper answers still to try, this one may not use up everything.
    const bool last = slope_share >= 1.0 || world_->terrain().is_flat();
    if (!last) stop.max_evaluations = std::max<std::uint64_t>(1, stop.max_evaluations / 3);
    if (!last) params.max_rounds = 12;
    const std::uint64_t before = report_.evaluations;
    Result<CorridorReport> found = search_corridor(problem, params, stop, request_.seed, {},
                                                   [&](const Corridor& c, std::uint64_t evaluations) {
                                                     return offer(c.waypoints, c.value, before + evaluations);
                                                   });
    if (!found) return found.error();
    report_.evaluations += found->evaluations;
    if (report_.status == PlanStatus::kCertified) report_.reason = "A path round the obstacles is certified.";
    return true;
  }

  PlanReport finish() {
    report_.wall_ms = wall_ms();
    return std::move(report_);
  }

  std::shared_ptr<const World> world_;
  ClearanceQuery query_;
  const PlanRequest& request_;
  StopCondition stop_;
  const Clock* clock_;
  const std::function<void(const PlanProgress&)>& observer_;
  double started_s_;
  PlanReport report_;
  std::string blocked_by_ = "something";
};

}  // namespace

const char* name(PlanStatus status) {
  switch (status) {
    case PlanStatus::kCertified:
      return "certified";
    case PlanStatus::kNoneFound:
      return "none_found";
    case PlanStatus::kStartBlocked:
      return "start_blocked";
    case PlanStatus::kGoalBlocked:
      return "goal_blocked";
    case PlanStatus::kOutOfBounds:
      return "out_of_bounds";
    case PlanStatus::kInterrupted:
      return "interrupted";
  }
  return "unknown";
}

Status validate(const PlanParams& params) {
  if (params.waypoints < 1 || params.waypoints > 64) {
    return bad_input("The number of waypoints is " + std::to_string(params.waypoints) +
                     "; it must be 1 to 64.");
  }
  if (Status status = validate(params.parts); !status) return status;
  Result<swarm::AnyParams> known = swarm::params_by_name(params.algorithm);
  if (!known) return known.error();
  known = swarm::with_settings(swarm::with_population(*known, params.population), params.settings);
  if (!known) return known.error();
  return std::visit([](const auto& p) { return swarm::validate(p); }, *known);
}

Result<PlanReport> plan_path(std::shared_ptr<const World> world, const PlanRequest& request,
                             const StopCondition& stop, const Clock* clock,
                             const std::function<void(const PlanProgress&)>& observer) {
  if (world == nullptr) return bad_input("There is no world to plan in.");
  if (Status status = validate(request.limits); !status) return status.error();
  if (Status status = validate(request.params); !status) return status.error();
  if (!is_finite(request.start_m) || !is_finite(request.goal_m) || !is_finite(request.start_time_s)) {
    return bad_input("The start, the goal or the start time is not finite.");
  }
  return PointToPoint(std::move(world), request, stop, clock, observer).run();
}

}  // namespace swallowtail::planner
