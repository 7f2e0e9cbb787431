#include "planner/replan/front_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "planner/base/checks.hpp"
#include "planner/cost/navigation.hpp"
#include "planner/cost/scene.hpp"
#include "planner/swarm/registry.hpp"

namespace swallowtail::planner {
namespace {

constexpr int kGuesses = 20;  ///< bowed paths that a default form begins with
constexpr double kSteepest_rad = 80.0 * std::numbers::pi / 180.0;

bool is_published(const PlanRequest& request) { return request.params.algorithm.ends_with("-seed"); }

/// Anything that does not validate is plan_with_cost's to refuse.
bool wants_front(const std::shared_ptr<const World>& world, const PricedRequest& request) {
  const PlanRequest& plan = request.plan;
  const Result<std::string> preset = preset_by_name(request.cost.preset);
  return world != nullptr && preset && *preset == "NMOPSO" && request.cost.weights.empty() &&
         returns_front(plan.params.algorithm) && validate(plan.params).ok() && validate(plan.limits).ok() &&
         is_finite(plan.start_m) && is_finite(plan.goal_m) &&
         (plan.goal_m - plan.start_m).norm() > kSamePlace_m;
}

Result<NavigationProblem> navigation_problem(const std::shared_ptr<const World>& world,
                                             const PricedRequest& request) {
  const PlanRequest& plan = request.plan;
  const auto scene = std::make_shared<const CostScene>(world, plan.limits, plan.start_m, plan.goal_m);
  const Result<Preset> preset = make_preset(request.cost, scene, plan.params.waypoints);
  if (!preset) return preset.error();
  NavigationSpec spec;
  spec.start_m = plan.start_m;
  spec.goal_m = plan.goal_m;
  spec.box_min_m = world->bounds().min_m.head<2>();
  spec.box_max_m = world->bounds().max_m.head<2>();
  spec.nodes = plan.params.waypoints;
  spec.turn_max_rad = std::min(plan.limits.turn_max_rad, kSteepest_rad);
  spec.climb_max_rad = std::min(plan.limits.climb_max_rad, kSteepest_rad);
  spec.height_min_m = preset->altitude.min_m;
  spec.height_max_m = preset->altitude.max_m;
  spec.vehicle_size_m = plan.limits.clearance_m();
  spec.danger_distance_m = request.cost.danger_distance_m;
  if (spec.danger_distance_m == 0.0)
    spec.danger_distance_m = std::max(10.0 * spec.vehicle_size_m, scene->distance_m / 200.0);
  auto disc = scene->discs.begin();
  for (const Obstacle& obstacle : world->obstacles()) {
    if (obstacle.valid_until_s < 0.0) continue;
    spec.threats.push_back({disc->center_m, disc->radius_m + obstacle.margin_m});
    ++disc;
  }
  spec.form = is_published(plan) ? NavigationForm::kPublished : NavigationForm::kRepaired;
  return NavigationProblem::make(world->terrain(), spec);
}

StopCondition limited(StopCondition stop, const PlanRequest& request) {
  constexpr auto kUnlimited = std::numeric_limits<std::uint64_t>::max();
  const bool timed = stop.clock != nullptr && std::isfinite(stop.deadline_s);
  if (stop.max_evaluations == kUnlimited && stop.max_iterations == kUnlimited && !timed)
    stop.max_evaluations = is_published(request) ? kDefaultEvaluations : kFrontEvaluations;
  return stop;
}

Result<swarm::MultiReport> search(const NavigationProblem& problem, const PlanRequest& request,
                                  const StopCondition& stop) {
  Result<swarm::AnyParams> params = swarm::params_by_name(request.params.algorithm);
  if (!params) return params.error();
  params = swarm::with_settings(std::move(*params), request.params.settings);
  if (!params) return params.error();
  swarm::MultiRunOptions options;
  options.stop = limited(stop, request);
  options.seed = request.seed;
  options.history_every = 0;
  if (!is_published(request)) {
    Rng rng(request.seed);
    options.guesses = problem.guesses(kGuesses, rng);
  }
  return swarm::optimize_multi(*params, problem.problem(), options);
}

/// A path of the front as it would be flown.
struct Flight {
  TimedPath path;
  Certificate certificate;
};

class FrontPlan {
 public:
  FrontPlan(const std::shared_ptr<const World>& world, const PlanRequest& request, const StopCondition& stop,
            const Clock* clock)
      : query_(world),
        request_(request),
        stop_(stop),
        clock_(clock),
        started_s_(clock != nullptr ? clock->now_s() : 0.0) {}

  bool ends_are_free() const {
    return std::ranges::all_of(std::array{request_.start_m, request_.goal_m}, [this](const Vec3& end) {
      return certify({{request_.start_time_s, end, Phase::kTransfer, 0}}, query_, request_.limits).certified;
    });
  }

  Result<FrontReport> run(const NavigationProblem& problem,
                          const std::function<void(const PlanProgress&)>& observer) {
    const Result<swarm::MultiReport> found = search(problem, request_, stop_);
    if (!found) return found.error();
    plan().evaluations = found->evaluations;
    report_.front.emplace();
    report_.front->hypervolume = found->hypervolume;
    std::vector<Flight> flights;
    for (Eigen::Index i = 0; i < found->front.size(); ++i) {
      std::vector<Vec3> polyline = problem.polyline(found->front.decisions.col(i));
      flights.push_back(flight_of(polyline));
      const bool certified = flights.back().certificate.certified;
      report_.front->members.push_back({found->front.objectives.col(i), std::move(polyline), certified});
    }
    if (found->compromise >= 0) choose(found->front, static_cast<std::size_t>(found->compromise), flights);
    conclude();
    plan().wall_ms = wall_ms();
    if (report_.front->flown) {
      plan().first_certified_ms = plan().wall_ms;
      plan().history.push_back({plan().evaluations, plan().wall_ms, plan().length_m});
      if (observer) observer(plan().history.back());
    }
    return std::move(report_);
  }

 private:
  PlanReport& plan() { return report_.priced.plan; }
  double wall_ms() const { return clock_ != nullptr ? 1e3 * (clock_->now_s() - started_s_) : 0.0; }

  Flight flight_of(const std::vector<Vec3>& polyline) const {
    std::vector<RoutePoint> route;
    for (std::size_t i = 1; i < polyline.size(); ++i)
      route.push_back({polyline[i], Phase::kTransfer, 0, 0.0});
    Flight flight;
    flight.path = time_route(request_.start_m, request_.start_time_s, route, request_.limits);
    flight.certificate = certify(flight.path, query_, request_.limits);
    return flight;
  }

  void choose(const swarm::Front& front, std::size_t picked, std::vector<Flight>& flights) {
    PlannedFront& planned = *report_.front;
    planned.picked = picked;
    const Eigen::VectorXd distance = swarm::distances_to_ideal(front);
    for (std::size_t i = 0; i < flights.size(); ++i) {
      if (!flights[i].certificate.certified) continue;
      const auto at = [&](std::size_t k) { return distance[static_cast<Eigen::Index>(k)]; };
      if (!planned.flown || at(i) < at(*planned.flown)) planned.flown = i;
    }
    if (flights[picked].certificate.certified) planned.flown = picked;
    const std::size_t shown = planned.flown.value_or(picked);
    const FrontMember& member = planned.members[shown];
    for (int k = 0; k < 4; ++k)
      report_.priced.terms.terms.push_back({"F" + std::to_string(k + 1), 1.0, member.objectives[k]});
    plan().cost = report_.priced.terms.total = member.objectives.sum();
    plan().certificate = std::move(flights[shown].certificate);
    if (!planned.flown) {
      report_.priced.attempt = member.polyline;
      return;
    }
    plan().path = std::move(flights[shown].path);
    plan().length_m = length_m(plan().path);
    plan().duration_s = plan().path.back().time_s - plan().path.front().time_s;
  }

  void conclude() {
    const PlannedFront& front = *report_.front;
    const std::string size = std::to_string(front.members.size());
    if (front.flown) {
      plan().status = PlanStatus::kCertified;
      plan().reason = front.flown == front.picked
                          ? "The compromise of a front of " + size + " paths is certified."
                          : "The compromise of a front of " + size +
                                " paths is not certified; the certified path nearest to the ideal is taken.";
    } else if (stop_.interrupted()) {
      plan().status = PlanStatus::kInterrupted;
      plan().reason = "Interrupted before anything certified was found.";
    } else {
      plan().status = PlanStatus::kNoneFound;
      plan().reason = "No certified path was found in " + std::to_string(plan().evaluations) +
                      " evaluations; the front has " + size + " paths.";
    }
  }

  ClearanceQuery query_;
  const PlanRequest& request_;
  StopCondition stop_;
  const Clock* clock_;
  double started_s_;
  FrontReport report_;
};

}  // namespace

bool returns_front(const std::string& algorithm) {
  const Result<swarm::AnyParams> params = swarm::params_by_name(algorithm);
  return params && swarm::takes_several_objectives(*params);
}

Result<FrontReport> plan_with_front(const std::shared_ptr<const World>& world, const PricedRequest& request,
                                    const StopCondition& stop, const Clock* clock,
                                    const std::function<void(const PlanProgress&)>& observer) {
  std::string why_not;
  if (wants_front(world, request)) {
    FrontPlan plan(world, request.plan, stop, clock);
    if (plan.ends_are_free()) {
      const Result<NavigationProblem> problem = navigation_problem(world, request);
      if (problem) return plan.run(*problem, observer);
      why_not = " There is no front: " + problem.error().message;
    }
  }
  Result<PricedReport> priced = plan_with_cost(world, request, stop, clock, observer);
  if (!priced) return priced.error();
  priced->plan.reason += why_not;
  return FrontReport{std::move(*priced), std::nullopt};
}

}  // namespace swallowtail::planner
