#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "planner/cost/path_problem.hpp"
#include "planner/replan/point_to_point.hpp"

namespace swallowtail::planner {

struct PricedRequest {
  PlanRequest plan;
  CostSpec cost;
};

/// A plan and what it costs under the request's preset, term by term. Without a certified path the terms are
/// those of `attempt`, the best polyline (ends included) that the optimiser found and the certifier refused;
/// empty when there was no search.
struct PricedReport {
  PlanReport plan;
  CostTerms terms;
  std::vector<Vec3> attempt;
};

/// Plans under a named cost (cost/preset.hpp). With preset "default" without weights, and an algorithm in its
/// default form, this is plan_path and the terms. Else:
/// - a form as published (`…-seed`) runs once, with its own population and without any polish or guess, until
///   `stop`; BOA's Step grows with its iterations [BOA Eq. 16];
/// - a default form runs in short rounds of different seeds, each polished (cost/polish.hpp), more and more
///   thoroughly the better it looks, until `stop`; without a limit that is kDefaultEvaluations.
/// What is cheapest among the certified paths is the plan: cost 0 of PlanReport is `terms.total`. Whether a
/// path may be flown is for the certifier alone: a cost says nothing about it. Obstacles that move are priced
/// where they stand at the start. Errors: as plan_path and PathProblem::make.
Result<PricedReport> plan_with_cost(std::shared_ptr<const World> world, const PricedRequest& request,
                                    const StopCondition& stop, const Clock* clock = nullptr,
                                    const std::function<void(const PlanProgress&)>& observer = {});

}  // namespace swallowtail::planner
