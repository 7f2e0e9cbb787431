#include "planner/replan/preset_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/base/checks.hpp"
#include "planner/cost/polish.hpp"
#include "planner/swarm/registry.hpp"

namespace swallowtail::planner {
namespace {

constexpr auto kUnlimited = std::numeric_limits<std::uint64_t>::max();

/// Swarm of a round, its quick polish, and the thorough one of a round that comes near the best.
constexpr std::uint64_t kRoundEvaluations = 2'000;
constexpr std::uint64_t kQuickEvaluations = 1'500;
constexpr std::uint64_t kThoroughEvaluations = 8'000;
/// Waypoints of the swarms, by turns, besides the plan's own: few variables, so that a corridor is soon
/// chosen.
constexpr std::array kCoarse{3, 2, 4};
constexpr double kNear = 1.02;
constexpr double kThoroughStep = 0.003;

bool ends_with_seed(const std::string& algorithm) { return algorithm.ends_with("-seed"); }

std::string by_what(const Violation& violation) {
  if (violation.kind == ViolationKind::kObstacle) return "obstacle " + std::to_string(violation.obstacle_id);
  if (violation.kind == ViolationKind::kTerrain) return "the ground";
  return name(violation.kind);
}

class PresetPlan {
 public:
  PresetPlan(const std::shared_ptr<const World>& world, const PricedRequest& request,
             const PathProblem& problem, std::vector<PathProblem> coarse, swarm::AnyParams params,
             const StopCondition& stop, const Clock* clock,
             const std::function<void(const PlanProgress&)>& observer)
      : query_(world),
        request_(request.plan),
        problem_(problem),
        coarse_(std::move(coarse)),
        params_(std::move(params)),
        stop_(stop),
        clock_(clock),
        observer_(observer),
        started_s_(clock != nullptr ? clock->now_s() : 0.0) {}

  Result<PricedReport> run() {
    if (is_free(request_.start_m, PlanStatus::kStartBlocked, "start") &&
        is_free(request_.goal_m, PlanStatus::kGoalBlocked, "goal")) {
      const Status status = ends_with_seed(request_.params.algorithm) ? as_published() : in_rounds();
      if (!status) return status.error();
      conclude();
    }
    plan().wall_ms = wall_ms();
    return std::move(report_);
  }

 private:
  PlanReport& plan() { return report_.plan; }
  double wall_ms() const { return clock_ != nullptr ? 1e3 * (clock_->now_s() - started_s_) : 0.0; }

  bool is_free(const Vec3& p, PlanStatus status, const char* what) {
    const Bounds& bounds = query_.world().bounds();
    if (!bounds.contains(p)) {
      plan().status = PlanStatus::kOutOfBounds;
      plan().reason = std::string("The ") + what + " lies outside the bounds.";
      return false;
    }
    const Certificate certificate =
        certify({{request_.start_time_s, p, Phase::kTransfer, 0}}, query_, request_.limits);
    if (certificate.certified || certificate.violations.empty()) return true;
    plan().status = status;
    plan().certificate = certificate;
    plan().reason =
        std::string("The ") + what + " is blocked by " + by_what(certificate.violations.front()) + ".";
    return false;
  }

  /// `stop` for a part of the work that may take so many evaluations.
  StopCondition part(std::uint64_t evaluations) const {
    StopCondition part = stop_;
    part.max_evaluations = std::min(evaluations, stop_.max_evaluations - plan_evaluations());
    part.max_iterations = kUnlimited;
    return part;
  }
  std::uint64_t plan_evaluations() const { return report_.plan.evaluations; }

  Status as_published() {
    swarm::RunOptions options;
    options.stop = stop_;
    options.seed = request_.seed;
    options.keep_history = false;
    const Result<swarm::Report> run = swarm::optimize(params_, problem_.problem(), options);
    if (!run) return run.error();
    plan().evaluations = run->evaluations;
    offer(run->best);
    return {};
  }

  Status in_rounds() {
    const Rng seeds(request_.seed);
    double best = std::numeric_limits<double>::infinity();
    for (std::uint64_t round = 0; !stop_.reached(plan_evaluations(), round); ++round) {
      const std::uint64_t before = plan_evaluations();
      Rng rng = seeds.split(round);
      swarm::RunOptions options;
      options.stop = part(kRoundEvaluations);
      options.seed = rng();
      options.keep_history = false;
      const std::size_t turn = round % (coarse_.size() + 1);
      const PathProblem& problem = turn < coarse_.size() ? coarse_[turn] : problem_;
      const Result<swarm::Report> run = swarm::optimize(params_, problem.problem(), options);
      if (!run) return run.error();
      plan().evaluations += run->evaluations;
      Polished found = in_full(problem, *run);
      refine(found, kQuickEvaluations, PolishOptions{}.step, rng);
      if (found.cost < kNear * best) {
        offer(found.best);
        refine(found, kThoroughEvaluations, kThoroughStep, rng);
        if (found.cost < best) offer(found.best);
      }
      best = std::min(best, found.cost);
      if (plan_evaluations() == before) break;
    }
    return {};
  }

  void refine(Polished& found, std::uint64_t evaluations, double step, Rng& rng) {
    PolishOptions options;
    options.step = step;
    options.stop = part(evaluations);
    options.seed = rng();
    if (options.stop.reached(1, 0)) return;
    found = polish(problem_.problem(), found.best, options);
    plan().evaluations += found.evaluations;
  }

  /// The best of a run with as many waypoints as the plan has.
  Polished in_full(const PathProblem& problem, const swarm::Report& run) const {
    if (&problem == &problem_) return {run.best, run.best_cost, 0};
    const std::vector<Vec3> points =
        resample(request_.start_m, problem.decode(run.best), request_.goal_m, problem_.waypoints());
    Polished full{problem_.encode(points), 0.0, 0};
    full.cost = problem_.terms(problem_.polyline(full.best)).total;
    return full;
  }

  /// Keeps the path if it is certified and cheaper than what is kept; a refused one is kept as the attempt
  /// while nothing is certified.
  void offer(const Eigen::VectorXd& candidate) {
    std::vector<Vec3> polyline = problem_.polyline(candidate);
    CostTerms terms = problem_.terms(polyline);
    const bool have = plan().status == PlanStatus::kCertified;
    if (have && terms.total >= plan().cost) return;
    std::vector<RoutePoint> route;
    for (std::size_t i = 1; i < polyline.size(); ++i)
      route.push_back({polyline[i], Phase::kTransfer, 0, 0.0});
    TimedPath path = time_route(request_.start_m, request_.start_time_s, route, request_.limits);
    Certificate certificate = certify(path, query_, request_.limits);
    if (!certificate.certified) {
      if (have || (!report_.attempt.empty() && terms.total >= report_.terms.total)) return;
      report_.attempt = std::move(polyline);
      report_.terms = std::move(terms);
      plan().certificate = std::move(certificate);
      return;
    }
    plan().status = PlanStatus::kCertified;
    plan().length_m = length_m(path);
    plan().duration_s = path.back().time_s - path.front().time_s;
    plan().path = std::move(path);
    plan().certificate = std::move(certificate);
    plan().cost = terms.total;
    report_.terms = std::move(terms);
    report_.attempt.clear();
    if (!have) plan().first_certified_ms = wall_ms();
    plan().history.push_back({plan().evaluations, wall_ms(), plan().length_m});
    if (observer_) observer_(plan().history.back());
  }

  void conclude() {
    if (plan().status == PlanStatus::kCertified) {
      plan().reason = "The cheapest path found under cost " + problem_.preset() + " is certified.";
      return;
    }
    plan().cost = report_.terms.total;
    if (stop_.interrupted()) {
      plan().status = PlanStatus::kInterrupted;
      plan().reason = "Interrupted before anything certified was found.";
      return;
    }
    const std::vector<Violation>& violations = plan().certificate.violations;
    plan().reason = "No certified path was found in " + std::to_string(plan().evaluations) +
                    " evaluations; the best under cost " + problem_.preset() + " is blocked by " +
                    (violations.empty() ? "something" : by_what(violations.front())) + ".";
  }

  ClearanceQuery query_;
  const PlanRequest& request_;
  const PathProblem& problem_;
  std::vector<PathProblem> coarse_;  ///< the same with fewer waypoints
  swarm::AnyParams params_;
  StopCondition stop_;
  const Clock* clock_;
  const std::function<void(const PlanProgress&)>& observer_;
  double started_s_;
  PricedReport report_;
};

/// Without any limit: kDefaultEvaluations. `population`: what an iteration of a default form counts for.
StopCondition limited(StopCondition stop, std::uint64_t population) {
  if (population > 0 && stop.max_iterations != kUnlimited) {
    const bool many = stop.max_iterations > kUnlimited / population;
    stop.max_evaluations =
        std::min(stop.max_evaluations, many ? kUnlimited : stop.max_iterations * population);
    stop.max_iterations = kUnlimited;
  }
  const bool timed = stop.clock != nullptr && std::isfinite(stop.deadline_s);
  if (stop.max_evaluations == kUnlimited && stop.max_iterations == kUnlimited && !timed) {
    stop.max_evaluations = kDefaultEvaluations;
  }
  return stop;
}

/// What a certified path costs; a path that stays where it is costs nothing.
PricedReport priced(PlanReport plan, const std::shared_ptr<const World>& world, const PathProblemSpec& spec) {
  PricedReport report{std::move(plan), {}, {}};
  std::vector<Vec3> polyline;
  for (const TimedWaypoint& waypoint : report.plan.path) {
    if (polyline.empty() || polyline.back() != waypoint.position_m) polyline.push_back(waypoint.position_m);
  }
  if (polyline.size() < 2) return report;
  if (const Result<PathProblem> problem = PathProblem::make(world, spec))
    report.terms = problem->terms(polyline);
  return report;
}

}  // namespace

Result<PricedReport> plan_with_cost(std::shared_ptr<const World> world, const PricedRequest& request,
                                    const StopCondition& stop, const Clock* clock,
                                    const std::function<void(const PlanProgress&)>& observer) {
  const Result<std::string> preset = preset_by_name(request.cost.preset);
  if (!preset) return preset.error();
  const bool published = ends_with_seed(request.plan.params.algorithm);
  PathProblemSpec spec;
  spec.start_m = request.plan.start_m;
  spec.goal_m = request.plan.goal_m;
  spec.waypoints = request.plan.params.waypoints;
  spec.limits = request.plan.limits;
  spec.cost = request.cost;
  spec.cost.step_grows = published;
  if (*preset == "default" && request.cost.weights.empty() && !published) {
    Result<PlanReport> plan = plan_path(world, request.plan, stop, clock, observer);
    if (!plan) return plan.error();
    return priced(std::move(*plan), world, spec);
  }
  if (Status status = validate(request.plan.params); !status) return status.error();
  const Result<PathProblem> problem = PathProblem::make(world, spec);
  if (!problem) return problem.error();
  Result<swarm::AnyParams> params = swarm::params_by_name(request.plan.params.algorithm);
  if (!params) return params.error();
  std::vector<PathProblem> coarse;
  for (const int waypoints : kCoarse) {
    if (published || waypoints >= problem->waypoints()) continue;
    Result<PathProblem> with_fewer = problem->with_waypoints(waypoints);
    if (!with_fewer) return with_fewer.error();
    coarse.push_back(std::move(*with_fewer));
  }
  const int population = request.plan.params.population;
  if (!published) params = swarm::with_population(*params, population);
  params = swarm::with_settings(std::move(*params), request.plan.params.settings);
  if (!params) return params.error();
  const StopCondition limits = limited(stop, published ? 0 : static_cast<std::uint64_t>(population));
  return PresetPlan(world, request, *problem, std::move(coarse), std::move(*params), limits, clock, observer)
      .run();
}

}  // namespace swallowtail::planner
