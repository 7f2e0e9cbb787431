#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/swarm/optimizer.hpp"
#include "planner/swarm/parameter.hpp"

namespace swallowtail::swarm {

struct IbabcParams {
  int population = 20;      ///< SN, food sources, 4 … 100000; ours
  int trial_limit = 60;     ///< rounds without improvement before a scout goes, 1 … 1000000; ours
  double guide = 1.5;       ///< how far towards a good source, 0 … 4; [ZHU-KWONG]
  double takes_part = 0.3;  ///< chance of an element to take part in a move, 0 … 1; ours
  double pressure = 2.0;    ///< onlookers choose rank SN·u^pressure, 1 … 10; ours
};
Parameters parameters(IbabcParams& params);
Status validate(const IbabcParams& params);

/// Improved balance artificial bee colony, the default form (`ibabc`). Employed bees, onlookers and scouts as
/// in [IBABC]; departs from it (see ibabc_seed.hpp) to search better for each evaluation:
/// - a bee moves v = x + φ (x_k − x_l) + ψ (g − x), φ in (−1, 1) and ψ in (0, guide) per variable, k and l
///   two other sources, g one of the best tenth [ZHU-KWONG], instead of [IBABC Eq. 7, 9]; one path point and
///   about a third of the others take part, so Eq. 7's 1/tr, which kept steps small, is not needed;
/// - onlookers choose by rank instead of 1/(1 + F) [Eq. 8], so that the unit of cost does not matter; good
///   sources get several, bad ones none;
/// - at most one scout an iteration, at the source that failed longest, never at the best; it comes back on
///   a bow [Eq. 10].
/// `step` takes no memory.
class Ibabc {
 public:
  using Params = IbabcParams;

  explicit Ibabc(const Params& params) : params_(params) {}

  void init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng);
  void step(Evaluator& evaluate, Rng& rng);
  void reassess(Evaluator& evaluate);

 private:
  void rank();
  void send(Eigen::Index bee, Eigen::Index source, Rng& rng);
  void evaluate_and_choose(Evaluator& evaluate);
  void send_scout(Evaluator& evaluate, Rng& rng);

  Params params_;
  Problem problem_;                ///< without its function
  Eigen::Index element_size_ = 1;  ///< variables of a path point
  Eigen::Index elements_ = 0;
  Eigen::MatrixXd sources_;  ///< (dimension × population)
  Eigen::VectorXd costs_;
  Eigen::VectorXd tries_;             ///< rounds without improvement
  std::vector<Eigen::Index> order_;   ///< sources from best to worst
  std::vector<Eigen::Index> source_;  ///< of each bee
  Eigen::MatrixXd trials_;
  Eigen::VectorXd trial_costs_;
};

}  // namespace swallowtail::swarm
