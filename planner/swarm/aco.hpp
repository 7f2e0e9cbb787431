#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/swarm/optimizer.hpp"
#include "planner/swarm/parameter.hpp"

namespace swallowtail::swarm {

struct AcoParams {
  int population = 50;      ///< k, solutions that are remembered, 4 … 100000; [SOCHA-DORIGO]
  int ants = 4;             ///< m, new solutions of each iteration, 1 … 100000; [SOCHA-DORIGO] has 2
  double locality = 0.1;    ///< q, 1e-4 … 10; [SOCHA-DORIGO]
  double speed = 1.0;       ///< ξ, 0.01 … 4; ours, [SOCHA-DORIGO] has 0.85
  double takes_part = 0.8;  ///< chance of a variable to be sampled, 0 … 1; ours, 1 in the source
};
Parameters parameters(AcoParams& params);
Status validate(const AcoParams& params);

/// Ant colony optimisation for continuous variables, the default form (`aco`): ACO_R [SOCHA-DORIGO]. Each ant
/// draws a remembered solution l of rank r with weight ω ∝ exp(−(r − 1)²/(2 q² k²)) and samples each variable
/// from N(s_l, σ), σ = ξ Σ_e |s_e − s_l|/(k − 1); the best k of all stay. Departs: a variable that takes no
/// part is left as in s_l, which keeps the good part of a path; a new solution replaces the worst if it is
/// better, which is the same as sorting and cutting. Nothing depends on place or unit of the variables, nor
/// on the unit of the cost. `step` takes no memory.
class Aco {
 public:
  using Params = AcoParams;

  explicit Aco(const Params& params) : params_(params) {}

  void init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng);
  void step(Evaluator& evaluate, Rng& rng);
  void reassess(Evaluator& evaluate);

 private:
  void rank();
  Eigen::Index draw(Rng& rng) const;
  void send(Eigen::Index ant, Rng& rng);

  Params params_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::MatrixXd solutions_;  ///< (dimension × population)
  Eigen::VectorXd costs_;
  Eigen::MatrixXd ants_;  ///< (dimension × ants)
  Eigen::VectorXd ant_costs_;
  std::vector<Eigen::Index> order_;  ///< solutions from best to worst
  Eigen::VectorXd weight_sums_;      ///< of ω by rank
};

}  // namespace swallowtail::swarm
