#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/swarm/optimizer.hpp"
#include "planner/swarm/parameter.hpp"

namespace swallowtail::swarm {

struct AcoSeedParams {
  int population = 50;              ///< ants, 2 … 100000; [BOA Tab. 1]
  int side = 11;                    ///< nodes along each side of a layer, 2 … 40; ours
  double pheromone_exponent = 1.0;  ///< α, 0 … 10; [DORIGO-MANIEZZO-COLORNI]
  double sight_exponent = 5.0;      ///< β, 0 … 10; [DORIGO-MANIEZZO-COLORNI]
  double evaporation = 0.5;         ///< 1 − ρ, 0 … 1; [DORIGO-MANIEZZO-COLORNI]
};
Parameters parameters(AcoSeedParams& params);
Status validate(const AcoSeedParams& params);

/// Ant system [DORIGO-MANIEZZO-COLORNI] on a layered waypoint grid (`aco-seed`), the comparator of [BOA],
/// which gives no details. One layer for each waypoint: a square grid of nodes across start–goal at equal
/// distances, as wide as the box there; where the problem is not one of waypoints, one layer for each
/// variable. From node to node of the next layer with probability ∝ τ^α η^β, η = 1/(distance of the nodes
/// plus the rest of the way) so that the last hop counts as well, 1 between variables. Each ant lays Q/F on
/// its way, Q the best cost so far, so that the unit of cost does not matter. The answer is never better than
/// the grid. Takes (layers · side⁴) numbers.
class AcoSeed {
 public:
  using Params = AcoSeedParams;

  explicit AcoSeed(const Params& params) : params_(params) {}

  void init(const Problem& problem, const Eigen::MatrixXd& guesses, Evaluator& evaluate, Rng& rng);
  void step(Evaluator& evaluate, Rng& rng);
  void reassess(Evaluator& evaluate);

 private:
  void lay_out(const Problem& problem);
  void weigh();
  void walk(Eigen::Index ant, Rng& rng);
  void deposit(double best_cost);

  Params params_;
  Eigen::Index layers_ = 0;
  Eigen::Index node_size_ = 1;
  Eigen::Index nodes_ = 0;                  ///< of each layer
  std::vector<Eigen::MatrixXd> places_;     ///< of each layer (node_size × nodes)
  std::vector<Eigen::MatrixXd> pheromone_;  ///< into each layer (nodes × nodes before; one column at first)
  std::vector<Eigen::MatrixXd> sight_;      ///< η^β, the same shape
  std::vector<Eigen::MatrixXd> weight_;     ///< sums of τ^α η^β down each column
  Eigen::MatrixXi ways_;                    ///< (layers × population)
  Eigen::MatrixXd ants_;                    ///< (dimension × population)
  Eigen::VectorXd costs_;
};

}  // namespace swallowtail::swarm
