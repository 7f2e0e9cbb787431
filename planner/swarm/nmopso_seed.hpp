#pragma once

#include <Eigen/Core>

#include "planner/base/result.hpp"
#include "planner/swarm/multi_driver.hpp"
#include "planner/swarm/parameter.hpp"

namespace swallowtail::swarm {

/// Values of the public reference code of [NMOPSO].
struct NmopsoSeedParams {
  int population = 100;         ///< 4 … 100000
  int generations = 500;        ///< T, 2 … 1000000
  double inertia = 1.0;         ///< w, 0 … 1
  double inertia_decay = 0.98;  ///< 0 … 1
  double cognitive = 1.5;       ///< c1, 0 … 4
  double social = 1.5;          ///< c2, 0 … 4
  double velocity_share = 0.5;  ///< most of the box a particle flies in one iteration, 0.001 … 1; ours
  ArchiveParams archive{};
};
Parameters parameters(NmopsoSeedParams& params);
Status validate(const NmopsoSeedParams& params);

/// Multi-objective particle swarm as published (`nmopso-seed`) [NMOPSO, section 3] with the public reference
/// code's parameters: leaders from the hypergrid, personal best replaced by what dominates it (by chance
/// where neither does), and a mutation with probability p = (1 − (it − 1)/(T − 1))² of one variable, drawn
/// evenly within p of the box about it. The code's clamping of mutants to the lower corner is not copied; a
/// particle that meets the box turns round.
class NmopsoSeed {
 public:
  using Params = NmopsoSeedParams;

  explicit NmopsoSeed(const Params& params) : params_(params) {}

  void init(const MultiProblem& problem, const Eigen::MatrixXd& guesses, MultiEvaluator& evaluate, Rng& rng);
  void step(MultiEvaluator& evaluate, Rng& rng);
  void reassess(MultiEvaluator& evaluate);

 private:
  void fly(MultiEvaluator& evaluate, Rng& rng);
  void mutate(double probability, MultiEvaluator& evaluate, Rng& rng);

  Params params_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::MatrixXd particles_;  ///< (dimension × population)
  Eigen::MatrixXd velocities_;
  Eigen::MatrixXd objectives_;  ///< (objectives × population)
  Eigen::MatrixXd bests_;
  Eigen::MatrixXd best_objectives_;
  Eigen::MatrixXd mutants_;
  Eigen::MatrixXd mutant_objectives_;
  std::vector<Eigen::Index> mutated_;
  double inertia_ = 0.0;
  int iteration_ = 0;
};

}  // namespace swallowtail::swarm
