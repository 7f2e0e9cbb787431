#pragma once

#include <Eigen/Core>

#include "planner/base/result.hpp"
#include "planner/swarm/optimizer.hpp"
#include "planner/swarm/parameter.hpp"

namespace swallowtail::swarm {

struct PsoParams {
  int population = 24;         ///< 4 … 100000; ours
  double inertia = 0.7298;     ///< χ, 0 … 1; [CLERC-KENNEDY]
  double cognitive = 1.49618;  ///< χ φ1, 0 … 4; [CLERC-KENNEDY]
  double social = 1.49618;     ///< χ φ2, 0 … 4; [CLERC-KENNEDY]
  int informants = 20;         ///< particles asked for the better best, 1 … 1000; ours
  double takes_part = 0.5;     ///< chance of a variable to take part in a move, 0 … 1; ours
  double jump = 0.7;           ///< chance of a jump instead of a flight, 0 … 1; ours
};
Parameters parameters(PsoParams& params);
Status validate(const PsoParams& params);

/// Particle swarm, the default form (`pso`). Flight as [PSO Eq. 8, 9] with the constriction of
/// [CLERC-KENNEDY]; departs from the document to search better for each evaluation:
/// - the social term goes to the best of a few informants drawn anew each time, not to the best of all, so
///   that several corridors stay alive;
/// - instead of a flight a particle may jump to p + u (l − p) + w (p_a − p_b), p its best, l its informant's,
///   p_a and p_b of two others, u in [0, 1), w in (−1, 1) per variable: differences of like points, which
///   shrink with the swarm;
/// - variables that take no part in a move stand at the particle's best.
/// Nothing depends on place, turn or unit of the variables, nor on the unit of the cost. `step` takes no
/// memory.
class Pso {
 public:
  using Params = PsoParams;

  explicit Pso(const Params& params) : params_(params) {}

  void init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng);
  void step(Evaluator& evaluate, Rng& rng);
  void reassess(Evaluator& evaluate);

 private:
  Eigen::Index best_informant(Eigen::Index particle, Rng& rng) const;
  void fly(Eigen::Index particle, Eigen::Index informant, Rng& rng);
  void jump(Eigen::Index particle, Eigen::Index informant, Rng& rng);

  Params params_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::MatrixXd particles_;  ///< (dimension × population)
  Eigen::MatrixXd velocities_;
  Eigen::VectorXd costs_;
  Eigen::MatrixXd bests_;  ///< of each particle
  Eigen::VectorXd best_costs_;
};

}  // namespace swallowtail::swarm
