#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/swarm/optimizer.hpp"
#include "planner/swarm/parameter.hpp"
#include "planner/swarm/smart_launcher.hpp"

namespace swallowtail::swarm {

struct BoaParams {
  int population = 24;
  double switch_probability = 0.8;  ///< of a global move; Arora & Singh 2019
  double exponent = 0.1;            ///< a of [BOA Eq. 17] at the start; Arora & Singh 2019
  double exponent_end = 0.3;        ///< a after many iterations [BOA Alg. 1, line 19]
  LauncherParams launcher{};
};
Parameters parameters(BoaParams& params);
Status validate(const BoaParams& params);

/// Butterfly optimisation with the smart launcher [BOA Alg. 1], the default form (`boa`). Departs from the
/// document so that results do not change when the scene is shifted, rotated or scaled:
/// - fragrance [BOA Eq. 17] f = I^a with the stimulus I = (n − rank)/n instead of the cost, so that the good
///   butterflies, not the bad ones, take the long steps and the unit of the cost does not matter;
/// - global move [BOA Eq. 19] x += 2u(g − x)·f and local move [BOA Eq. 20] x += (2u − 1)(x_j − x_k)·f are
///   differences of like points (printed: r²·g − x, which pulls towards the origin), u drawn per variable;
/// - about half of the variables take part in a move, the others stay;
/// - greedy acceptance per butterfly.
/// On a problem of waypoints the first population bows around the straight line; elsewhere it is uniform.
/// `step` takes no memory.
class Boa {
 public:
  using Params = BoaParams;

  explicit Boa(const Params& params) : params_(params), launcher_(params.launcher) {}

  void init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng);
  void step(Evaluator& evaluate, Rng& rng);
  void reassess(Evaluator& evaluate);

 private:
  void rank();

  Params params_;
  SmartLauncher launcher_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::MatrixXd agents_;  ///< (dimension × population)
  Eigen::VectorXd costs_;
  Eigen::MatrixXd trials_;
  Eigen::VectorXd trial_costs_;
  std::vector<Eigen::Index> order_;  ///< agents from best to worst
  double exponent_ = 0.0;
  int stalled_ = 0;
};

}  // namespace swallowtail::swarm
