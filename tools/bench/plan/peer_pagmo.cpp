#include "tools/bench/plan/peer_pagmo.hpp"

#include <memory>
#include <utility>

#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/bee_colony.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/gaco.hpp>
#include <pagmo/algorithms/nspso.hpp>
#include <pagmo/algorithms/pso.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "planner/cost/path_problem.hpp"
#include "tools/bench/plan/judge.hpp"

namespace swallowtail::bench {
namespace {

using pagmo::vector_double;

constexpr unsigned kIndividuals = 200;
constexpr unsigned kManyGenerations = 1'000'000;
/// Weight of the preset "default".
constexpr double kPenalty = 10.0;

struct TimeIsOver {};

/// What all copies of the problem share.
struct Shared {
  Shared(const PlanCase& plan_case, planner::PathProblem problem_in, const RunLimit& limit_in)
      : judge(plan_case), problem(std::move(problem_in)), limit(limit_in) {}
  bool is_over() {
    constexpr std::uint64_t kClockEvery = 16;
    if (evaluations >= limit.evaluations) return true;
    return ++evaluations % kClockEvery == 0 && recorder.cpu_ms() >= 1e3 * limit.cpu_s;
  }

  Recorder recorder;
  Judge judge;
  planner::PathProblem problem;
  RunLimit limit;
  std::uint64_t evaluations = 0;
};

enum class Objectives { kSum, kTwo };

/// A path problem as pagmo wants it.
struct PathUdp {
  std::shared_ptr<Shared> shared;
  Objectives objectives = Objectives::kSum;

  vector_double fitness(const vector_double& x) const {
    if (shared->is_over()) throw TimeIsOver{};
    const Eigen::Map<const Eigen::VectorXd> candidate(x.data(), static_cast<Eigen::Index>(x.size()));
    const std::vector<Vec3> path = shared->problem.polyline(candidate);
    const Judge::Penalised cost = shared->judge.penalised(path);
    if (cost.violation_m <= 0.0 && cost.length_m < shared->recorder.best_length_m() &&
        shared->judge.free(path))
      shared->recorder.offer(path, cost.length_m, shared->evaluations, 0);
    const double d = shared->judge.plan_case().distance_m();
    if (objectives == Objectives::kTwo) return {cost.length_m / d, cost.violation_m / d};
    return {(cost.length_m + kPenalty * cost.violation_m) / d};
  }
  std::pair<vector_double, vector_double> get_bounds() const {
    const auto list = [](const Eigen::VectorXd& v) { return vector_double(v.data(), v.data() + v.size()); };
    return {list(shared->problem.problem().lower), list(shared->problem.problem().upper)};
  }
  vector_double::size_type get_nobj() const { return objectives == Objectives::kTwo ? 2 : 1; }
};

template <class MakeAlgorithm>
PlanRun run_pagmo(const MakeAlgorithm& make, Objectives objectives, const PlanCase& plan_case,
                  std::uint64_t seed, const RunLimit& limit) {
  planner::PathProblemSpec spec;
  spec.start_m = plan_case.start_m;
  spec.goal_m = plan_case.goal_m;
  spec.waypoints = plan_case.waypoints;
  spec.limits = plan_case.limits;
  auto problem = planner::PathProblem::make(plan_case.world, spec);
  if (!problem) {
    PlanRun failed;
    failed.failure = problem.error().message;
    return failed;
  }
  const auto shared = std::make_shared<Shared>(plan_case, std::move(*problem), limit);
  try {
    for (auto restart = static_cast<unsigned>(seed);; restart += 1'000'003U) {
      const pagmo::algorithm algorithm = make(restart);
      pagmo::population population{pagmo::problem{PathUdp{shared, objectives}}, kIndividuals, restart};
      algorithm.evolve(std::move(population));
    }
  } catch (const TimeIsOver&) {
    return shared->recorder.finish(shared->evaluations);
  }
}

template <class MakeAlgorithm>
Subject subject(const std::string& name, MakeAlgorithm make, Objectives objectives = Objectives::kSum) {
  return {"pagmo " + name, "pagmo",
          [make, objectives](const PlanCase& plan_case, std::uint64_t seed, const RunLimit& limit) {
            return run_pagmo(make, objectives, plan_case, seed, limit);
          }};
}

}  // namespace

std::vector<Subject> pagmo_subjects() {
  constexpr unsigned n = kManyGenerations;
  return {
      subject("pso",
              [](unsigned seed) {
                return pagmo::algorithm{pagmo::pso(n, 0.7298, 2.05, 2.05, 0.5, 5U, 2U, 4U, false, seed)};
              }),
      subject("bee_colony", [](unsigned seed) { return pagmo::algorithm{pagmo::bee_colony(n, 20U, seed)}; }),
      subject("gaco",
              [](unsigned seed) {
                return pagmo::algorithm{pagmo::gaco(n, 63U, 1.0, 0.0, 0.01, 1U, 7U, n, n, 0.0, false, seed)};
              }),
      subject("cmaes",
              [](unsigned seed) {
                return pagmo::algorithm{pagmo::cmaes(n, -1, -1, -1, -1, 0.5, 1e-6, 1e-6, false, true, seed)};
              }),
      subject(
          "nspso",
          [](unsigned seed) {
            return pagmo::algorithm{
                pagmo::nspso(n, 0.6, 2.0, 2.0, 1.0, 0.5, 60U, "crowding distance", false, seed)};
          },
          Objectives::kTwo)};
}

}  // namespace swallowtail::bench
