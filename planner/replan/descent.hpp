#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "planner/replan/detour_problem.hpp"

namespace swallowtail::planner {

struct DescentParams {
  int rounds = 6;            ///< of the multipliers
  int steps_per_round = 20;  ///< of the quasi-Newton descent
};

struct DescentResult {
  Eigen::VectorXd x;  ///< never worse than the start by DetourProblem::value
  double value = 0.0;
  std::uint64_t evaluations = 0;
};

/// Shortens a path within its corridor: augmented Lagrangian over the distances of hops to obstacles and
/// ground, each round minimised by L-BFGS with analytic gradients (the ground's by differences). The swarm
/// chooses the corridor, this finds its shortest path. Ends early when `max_evaluations` are spent. Moving
/// obstacles are taken where they are when the current path passes; their dependence on time is left out of
/// the gradient, not of the judgement.
DescentResult descend(const DetourProblem& problem, const Eigen::VectorXd& start,
                      std::uint64_t max_evaluations, const DescentParams& params = {});

}  // namespace swallowtail::planner
