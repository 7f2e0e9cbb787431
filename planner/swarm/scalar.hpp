#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "planner/swarm/multi_driver.hpp"
#include "planner/swarm/optimizer.hpp"

namespace swallowtail::swarm {

/// A multi-objective algorithm on a problem with one objective (a weighted sum, say): its archive is the best
/// so far. Satisfies `Algorithm`.
template <MultiAlgorithm A>
class Scalar {
 public:
  using Params = typename A::Params;

  explicit Scalar(const Params& params) : params_(params), algorithm_(params) {}

  void init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng) {
    state_ = std::make_unique<State>();
    MultiProblem& multi = state_->problem;
    multi.lower = problem.lower;
    multi.upper = problem.upper;
    multi.objectives = 1;
    state_->costs.resize(params_.population);
    multi.evaluate = [state = state_.get(), &evaluate](Candidates candidates, Objectives objectives) {
      auto costs = state->costs.head(candidates.cols());
      evaluate(candidates, costs);
      objectives.row(0) = costs.transpose();
    };
    const auto unlimited = std::numeric_limits<std::uint64_t>::max();
    state_->evaluate.emplace(multi, ArchiveParams{.capacity = 1}, unlimited, rng.split(0)());
    algorithm_.init(multi, guesses, *state_->evaluate, rng);
  }
  /// `evaluate` must be the one given to `init`.
  void step(Evaluator&, Rng& rng) { algorithm_.step(*state_->evaluate, rng); }
  void reassess(Evaluator&) { algorithm_.reassess(*state_->evaluate); }

 private:
  struct State {  // stays where it is: the evaluators refer to it
    MultiProblem problem;
    Eigen::VectorXd costs;
    std::optional<MultiEvaluator> evaluate;
  };

  Params params_;
  A algorithm_;
  std::unique_ptr<State> state_;
};

}  // namespace swallowtail::swarm
