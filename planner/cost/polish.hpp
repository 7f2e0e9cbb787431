#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "planner/base/stop.hpp"
#include "planner/swarm/problem.hpp"

namespace swallowtail::planner {

struct PolishOptions {
  double step = 0.01;        ///< first standard deviation of a variable, as a share of its box
  double least_step = 1e-8;  ///< the search ends below it
  StopCondition stop;
  std::uint64_t seed = 1;
};

struct Polished {
  Eigen::VectorXd best;
  double cost = 0.0;
  std::uint64_t evaluations = 0;
};

/// Improves a candidate locally with an evolution strategy that adapts its covariance [CMA-ES, Hansen 2016].
/// It needs no gradient, and compares costs only, so that steps and kinks (the first touch of a ball, the
/// nearest sample of a raster) do no harm: the documents' costs are full of them. Samples are drawn in lots
/// of whole evaluation batches; what leaves the box is moved to its edge. The result is never worse than
/// `from`. Stops when the steps are small, when nothing was gained for long, or with `stop` (its evaluations
/// and iterations count from 0).
Polished polish(const swarm::Problem& problem, const Eigen::VectorXd& from, const PolishOptions& options);

}  // namespace swallowtail::planner
