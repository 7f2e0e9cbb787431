#pragma once

#include <Eigen/Core>

#include "planner/base/result.hpp"
#include "planner/swarm/optimizer.hpp"
#include "planner/swarm/parameter.hpp"

namespace swallowtail::swarm {

struct PsoSeedParams {
  int population = 200;         ///< M, 2 … 100000; [PSO, experiment]
  double inertia = 0.8;         ///< w(0), 0 … 1; [PSO, experiment]
  double inertia_decay = 0.98;  ///< α of [PSO Eq. 10], 0 … 1; [PSO, experiment]
  double cognitive = 0.5;       ///< c1, 0 … 4; [PSO, experiment]
  double social = 0.5;          ///< c2, 0 … 4; [PSO, experiment]
  double near_share = 0.5;      ///< K/M, share of particles that start near the line, 0 … 1; ours
  double near_radius = 0.1;     ///< how near, as a share of the box, 0 … 1; ours
};
Parameters parameters(PsoSeedParams& params);
Status validate(const PsoSeedParams& params);

/// Particle swarm as published (`pso-seed`): v = w v + r1 c1 (p − x) + r2 c2 (g − x) [PSO Eq. 9],
/// x = x + v [Eq. 8], w = α w [Eq. 10], personal best [Eq. 11] (printed with its two cases the wrong way
/// round), best of all [Eq. 12] (star topology). First population in three stages: one particle on the
/// straight line, K near it, the rest anywhere; velocities start at zero. The document does not give K nor
/// how near, nor says what happens at the box: positions are clamped.
class PsoSeed {
 public:
  using Params = PsoSeedParams;

  explicit PsoSeed(const Params& params) : params_(params) {}

  void init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng);
  void step(Evaluator& evaluate, Rng& rng);
  void reassess(Evaluator& evaluate);

 private:
  void remember();

  Params params_;
  double inertia_ = 0.0;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::MatrixXd particles_;  ///< (dimension × population)
  Eigen::MatrixXd velocities_;
  Eigen::VectorXd costs_;
  Eigen::MatrixXd bests_;  ///< of each particle
  Eigen::VectorXd best_costs_;
  Eigen::Index leader_ = 0;
};

}  // namespace swallowtail::swarm
