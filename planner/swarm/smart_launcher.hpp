#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/swarm/optimizer.hpp"

namespace swallowtail::swarm {

struct LauncherParams {
  /// Operating range [BOA Eq. 11] as a share of start–goal, so that it has no unit: a longer hop gets a
  /// midpoint.
  double hop_share = 0.5;
  /// Iterations without improvement after which the search counts as stuck [BOA Alg. 1, Switch].
  int stall_iterations = 1;
  /// Throws in a row when it fires. Ours.
  int throws = 2;
};
Status validate(const LauncherParams& params);

/// The smart launcher [BOA Fig. 2, IAP and Throw point]: picks a midpoint, a length and tries eight
/// directions, and moves the midpoint to the best of them if that is better.
///
/// Directions: the octants of the tangent frame at the midpoint, (±t ± n1 ± n2)/√3, with t from the waypoint
/// before to the one after and n1, n2 perpendicular to it, rolled about t by a random angle, so that no axis
/// of the coordinate system is preferred. (The document shows eight directions in the plane only.) Length:
/// the mean of the two hops at the midpoint times a share that grows after a hit and halves after a miss.
/// Number of midpoints: candidates always have room for k; a midpoint on the straight line between its
/// neighbours is no midpoint. A ninth candidate drops the midpoint in this sense (Best_Position), and a hop
/// beyond the range takes the least useful midpoint into its middle. So the number varies and no memory is
/// taken.
class SmartLauncher {
 public:
  explicit SmartLauncher(const LauncherParams& params) : params_(params) {}

  void init(const Problem& problem);
  bool usable() const { return usable_; }
  bool wants_to_fire(const Eigen::Ref<const Eigen::VectorXd>& agent, int stalled_iterations) const;
  /// One firing at `agent`; its cost is kept up to date.
  void fire(Eigen::Ref<Eigen::VectorXd> agent, double& cost, Evaluator& evaluate, Rng& rng);

 private:
  static constexpr Eigen::Index kTrials = 9;

  Vec3 waypoint(const Eigen::Ref<const Eigen::VectorXd>& agent, Eigen::Index i) const;  // -1: start; k: goal
  Eigen::Index longest_hop(const Eigen::Ref<const Eigen::VectorXd>& agent) const;  // ends at this waypoint
  double hop(const Eigen::Ref<const Eigen::VectorXd>& agent, Eigen::Index i) const;
  Eigen::Index split_longest_hop(Eigen::Ref<Eigen::VectorXd> agent) const;
  void throw_point(Eigen::Ref<Eigen::VectorXd> agent, double& cost, Eigen::Index midpoint,
                   Evaluator& evaluate, Rng& rng);

  LauncherParams params_;
  bool usable_ = false;
  Eigen::Index count_ = 0;
  WaypointLayout ends_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  Eigen::MatrixXd trials_;
  Eigen::VectorXd trial_costs_;
  Eigen::VectorXd kept_;
  double share_ = 0.5;
};

}  // namespace swallowtail::swarm
