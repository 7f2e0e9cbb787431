#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/swarm/optimizer.hpp"
#include "planner/swarm/parameter.hpp"

namespace swallowtail::swarm {

struct IbabcSeedParams {
  int population = 50;    ///< SN, food sources, 3 … 100000; none printed, ours
  int trial_limit = 20;   ///< th of [IBABC Eq. 10], 1 … 1000000; none printed, ours
  double scouting = 0.5;  ///< γ of [IBABC Eq. 10], 0.001 … 1 (printed: in (0, 1)); the value is ours
};
Parameters parameters(IbabcSeedParams& params);
Status validate(const IbabcSeedParams& params);

/// Improved balance artificial bee colony as published (`ibabc-seed`). The source's formulas were images and
/// are lost; R marks what is reconstructed from its text and from the artificial bee colony it builds on.
/// - (1) x_i^j = lo + φ (hi − lo): one path point on each of D planes across start–goal; an element j is a
///   path point, or a variable where the problem is not one of waypoints.
/// - (7) R: employed bee v_i^j = x_i^j + φ (x_i^j − x_k^j)/tr(i), φ in (−1, 1), one random element; greedy.
/// - (8) share p(i) = fit(i)/Σ fit with fit = 1/(1 + F); sources sorted by it get one onlooker each. Each
/// gets
///   one whatever its share, so the order alone could matter, and it does not within one batch.
/// - (9) R: onlooker as (7) without 1/tr, on two random elements; greedy.
/// - (10) R: tr counts rounds without improvement; tr > th becomes 1; if mean(tr) > γ D, γ SN random sources
///   are replaced and their tr is 1. (The text resets tr to 0 in one place and to 1 in another: 1 here.)
/// The scouts may delete the best source: the driver keeps the best path aside.
class IbabcSeed {
 public:
  using Params = IbabcSeedParams;

  explicit IbabcSeed(const Params& params) : params_(params) {}

  void init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng);
  void step(Evaluator& evaluate, Rng& rng);
  void reassess(Evaluator& evaluate);

 private:
  void place(Eigen::Ref<Eigen::VectorXd> source, Rng& rng) const;
  void move_element(Eigen::Index source, Eigen::Index element, double scale, Rng& rng);
  void evaluate_and_choose(Evaluator& evaluate);
  void send_scouts(Evaluator& evaluate, Rng& rng);

  Params params_;
  Problem problem_;
  Eigen::Index element_size_ = 1;
  Eigen::Index elements_ = 0;
  Eigen::MatrixXd sources_;  ///< (dimension × population)
  Eigen::VectorXd costs_;
  Eigen::MatrixXd trials_;
  Eigen::VectorXd trial_costs_;
  Eigen::VectorXd tries_;  ///< tr
  std::vector<Eigen::Index> drawn_;
};

}  // namespace swallowtail::swarm
