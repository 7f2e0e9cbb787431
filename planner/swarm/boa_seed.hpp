#pragma once

#include <Eigen/Core>

#include "planner/base/result.hpp"
#include "planner/swarm/optimizer.hpp"
#include "planner/swarm/parameter.hpp"
#include "planner/swarm/smart_launcher.hpp"

namespace swallowtail::swarm {

struct BoaSeedParams {
  int population = 50;            ///< butterflies, 3 … 100000; [BOA Tab. 1]
  int generations = 100;          ///< N of the update of c and a, 1 … 1000000; [BOA Tab. 1]
  double switch_threshold = 0.2;  ///< p of [BOA Alg. 1, line 13], 0 … 1; [ARORA-SINGH] as 1 − 0.8
  double modality = 0.01;         ///< c of [BOA Eq. 17] at the start, 1e-6 … 1; [ARORA-SINGH]
  double exponent = 0.1;          ///< a of [BOA Eq. 17] at the start, 0 … 1; [ARORA-SINGH]
  double exponent_end = 0.3;      ///< a after N iterations, 0 … 1; [ARORA-SINGH]
  double operating_range = 3.5;   ///< OP of [BOA Eq. 11], unit of the variables, 1e-9 … 1e9; [BOA]
};
Parameters parameters(BoaSeedParams& params);
Status validate(const BoaSeedParams& params);

/// Butterfly optimisation with the smart launcher as published (`boa-seed`) [BOA Alg. 1]: fragrance
/// f_i = c F_i^a of the cost itself [Eq. 17]; x_i += (r² g − x_i) f_i where rand > p and Switch [Eq. 19],
/// else x_i += (r² x_j − x_k) f_i [Eq. 20]; the launcher throws the best butterfly while Switch is on. Both
/// known defects are kept: bad butterflies take the longer steps and the unit of cost sets their size; r² g −
/// x pulls towards the origin of the coordinates.
///
/// What the document leaves open is taken from [ARORA-SINGH]: values, c += 0.025/(c N), a rising to 0.3 over
/// N iterations (line 19), r² as the product of two draws, greedy acceptance. Ours: Switch is on for a
/// butterfly with a hop beyond OP, for all while the best has not improved, and always where there are no
/// waypoints; an infinite cost smells like the worst finite one.
class BoaSeed {
 public:
  using Params = BoaSeedParams;

  explicit BoaSeed(const Params& params) : params_(params), launcher_(LauncherParams{}) {}

  void init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng);
  void step(Evaluator& evaluate, Rng& rng);
  void reassess(Evaluator& evaluate);

 private:
  Params params_;
  SmartLauncher launcher_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::MatrixXd butterflies_;  ///< (dimension × population)
  Eigen::VectorXd costs_;
  Eigen::MatrixXd trials_;
  Eigen::VectorXd trial_costs_;
  double modality_ = 0.0;
  double exponent_ = 0.0;
  int stalled_ = 0;
};

}  // namespace swallowtail::swarm
