#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstdint>
#include <limits>

#include "planner/base/result.hpp"
#include "planner/base/rng.hpp"
#include "planner/swarm/problem.hpp"

namespace swallowtail::swarm {

/// The only way an algorithm sees the problem's costs: it counts, keeps the best and holds the budget.
class Evaluator {
 public:
  Evaluator(const Problem& problem, std::uint64_t max_evaluations);

  /// Costs of the candidates. Those beyond the budget are not evaluated and cost +infinity.
  void operator()(Candidates candidates, Costs costs);
  /// The costs have changed: evaluates the best anew. If the budget is used up, it keeps its cost.
  void reassess();

  std::uint64_t evaluations() const { return evaluations_; }
  double best_cost() const { return best_cost_; }
  const Eigen::VectorXd& best() const { return best_; }

 private:
  const Problem& problem_;
  std::uint64_t max_evaluations_;
  std::uint64_t evaluations_ = 0;
  double best_cost_ = std::numeric_limits<double>::infinity();
  Eigen::VectorXd best_;
  Eigen::VectorXd best_cost_now_ = Eigen::VectorXd::Zero(1);
};

/// An algorithm is a plain type with `Params` (and a free `validate` for them), `init` and `step`. `init`
/// takes all memory it will need and evaluates the first population, the guesses (dimension × n) among it;
/// `step` is one iteration. `reassess` evaluates anew what the algorithm remembers, after the problem's costs
/// have changed (Problem::begin_iteration). None of them reads a clock, logs or stops: the driver does
/// (driver.hpp). Every candidate lies within the problem's bounds.
template <class A>
concept Algorithm = requires(A algorithm, const typename A::Params& params, const Problem& problem,
                             const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng) {
  {A(params)};
  { validate(params) } -> std::same_as<Status>;
  { algorithm.init(problem, guesses, evaluate, rng) } -> std::same_as<void>;
  { algorithm.step(evaluate, rng) } -> std::same_as<void>;
  { algorithm.reassess(evaluate) } -> std::same_as<void>;
};

}  // namespace swallowtail::swarm
