#pragma once

#include <Eigen/Core>
#include <array>

#include "planner/base/result.hpp"
#include "planner/swarm/multi_driver.hpp"
#include "planner/swarm/parameter.hpp"

namespace swallowtail::swarm {

struct NmopsoParams {
  int population = 40;         ///< 4 … 100000; ours, [NMOPSO] code 100
  double inertia = 0.7298;     ///< χ, 0 … 1; [CLERC-KENNEDY]
  double cognitive = 1.49618;  ///< χ φ1, 0 … 4; [CLERC-KENNEDY]
  double social = 1.49618;     ///< χ φ2, 0 … 4; [CLERC-KENNEDY]
  double takes_part = 0.5;     ///< chance of a variable to take part in a jump, 0 … 1; ours
  double least_share = 0.05;   ///< of the moves that each kind always gets, 0 … 0.3; ours
  ArchiveParams archive{.capacity = 100};
};
Parameters parameters(NmopsoParams& params);
Status validate(const NmopsoParams& params);

/// Multi-objective particle swarm, the default form (`nmopso`): particles fly to their own best and to a
/// leader from the archive [NMOPSO, section 3], which is drawn by crowding. Departs from the source:
/// - besides flying, a particle may jump by differences of archive members, or be a leader's neighbour: the
///   problem's own `vary`, else some variables mutated over eight octaves of the box, clamped to the nearest
///   bound (the source's code puts mutants into the lower corner);
/// - the three kinds share the moves by how often each has lately put a candidate into the archive: that is
///   the adaptive mutation here;
/// - constriction instead of an inertia that decays with a planned number of iterations, so that a run may
///   stop at any time.
/// With one objective the archive is the best so far. Nothing depends on the unit of an objective. `step`
/// takes no memory.
class Nmopso {
 public:
  using Params = NmopsoParams;

  explicit Nmopso(const Params& params) : params_(params) {}

  void init(const MultiProblem& problem, const Eigen::MatrixXd& guesses, MultiEvaluator& evaluate, Rng& rng);
  void step(MultiEvaluator& evaluate, Rng& rng);
  void reassess(MultiEvaluator& evaluate);

 private:
  enum Move : std::uint8_t { kFly, kJump, kVary };
  static constexpr std::size_t kMoves = 3;

  Move draw_move(Rng& rng) const;
  Eigen::Ref<const Eigen::VectorXd> leader(const ParetoArchive& archive, Rng& rng) const;
  Eigen::Ref<const Eigen::VectorXd> member(const ParetoArchive& archive, Rng& rng) const;
  void fly(Eigen::Index particle, const ParetoArchive& archive, Rng& rng);
  void jump(Eigen::Index particle, const ParetoArchive& archive, Rng& rng);
  void vary(Eigen::Index particle, const ParetoArchive& archive, Rng& rng);
  void remember(Rng& rng);
  void share_out(const MultiEvaluator& evaluate);

  Params params_;
  MultiProblem problem_;       ///< without its objectives
  Eigen::MatrixXd particles_;  ///< (dimension × population)
  Eigen::MatrixXd velocities_;
  Eigen::MatrixXd objectives_;  ///< (objectives × population)
  Eigen::MatrixXd bests_;       ///< of each particle
  Eigen::MatrixXd best_objectives_;
  std::vector<Move> moves_;             ///< of each particle in this iteration
  std::array<double, kMoves> tried_{};  ///< with a fading memory
  std::array<double, kMoves> taken_{};
  std::array<double, kMoves> share_{};
};

}  // namespace swallowtail::swarm
