#pragma once

#include <Eigen/Core>
#include <functional>

#include "planner/base/result.hpp"
#include "planner/base/rng.hpp"
#include "planner/swarm/problem.hpp"

namespace swallowtail::swarm {

/// (objectives × n), one candidate a column.
using Objectives = Eigen::Ref<Eigen::MatrixXd>;

/// A box and several functions to minimise at once. Nothing here knows what the variables mean.
struct MultiProblem {
  static constexpr Eigen::Index kMaxObjectives = 8;

  Eigen::VectorXd lower;        ///< (dimension)
  Eigen::VectorXd upper;        ///< (dimension)
  Eigen::Index objectives = 0;  ///< 1 … kMaxObjectives
  /// Writes the objectives of each column. A candidate with +infinity in any of them is infeasible and never
  /// enters a front; NaN counts as +infinity.
  std::function<void(Candidates, Objectives)> evaluate;
  /// Writes a neighbour of a candidate within the bounds: a small change that means something to the problem
  /// (one node of a path, say). May be empty; then algorithms mutate variables.
  std::function<void(const Eigen::Ref<const Eigen::VectorXd>& candidate, Rng& rng,
                     Eigen::Ref<Eigen::VectorXd> neighbour)>
      vary;
  /// (objectives) point that the hypervolume is measured from; empty: none is measured. At most 4 objectives
  /// then.
  Eigen::VectorXd reference;

  Eigen::Index dimension() const { return lower.size(); }
};

/// Refuses what validate(Problem) refuses, a number of objectives out of range, a reference that does not
/// fit.
Status validate(const MultiProblem& problem);

}  // namespace swallowtail::swarm
