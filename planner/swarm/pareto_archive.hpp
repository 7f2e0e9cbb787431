#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/rng.hpp"
#include "planner/swarm/multi_problem.hpp"

namespace swallowtail::swarm {

/// a is nowhere worse than b and somewhere better. Sizes equal, no NaN.
bool dominates(const Eigen::Ref<const Eigen::VectorXd>& a, const Eigen::Ref<const Eigen::VectorXd>& b);

struct ArchiveParams {
  int capacity = 50;      ///< 1 … 10000; public reference code of [NMOPSO]
  int divisions = 5;      ///< M, cells of the hypergrid along each objective, 2 … 64; the same source
  double crowding = 2.0;  ///< κ ≥ 0; the same source
};
Status validate(const ArchiveParams& params);

/// The candidates that no other one seen dominates, bounded, on the hypergrid of [NMOPSO, section 3]: cell
/// c_i = ⌊M (F_i − G^L_i)/(G^U_i − G^L_i)⌋ with G^L, G^U = min − ε, max + ε, ε = (max − min)/(2(M − 1)). (The
/// source prints a bracket that is half floor, half rounding; floor is what gives M cells.) With N_m members
/// in cell m its crowding is e^{−κ N_m}: a leader's cell is drawn with that weight, the cell that loses a
/// member when there are too many with its inverse, the member in the cell evenly. Takes memory at
/// construction only.
class ParetoArchive {
 public:
  ParetoArchive(const ArchiveParams& params, Eigen::Index dimension, Eigen::Index objectives);

  /// True if the candidate is now a member: every objective is finite, and no member dominates or equals it.
  /// Members that it dominates go.
  bool offer(const Eigen::Ref<const Eigen::VectorXd>& decision,
             const Eigen::Ref<const Eigen::VectorXd>& objectives, Rng& rng);
  void clear() { size_ = 0; }

  Eigen::Index size() const { return size_; }
  auto decision(Eigen::Index i) const { return decisions_.col(i); }
  auto objectives(Eigen::Index i) const { return objectives_.col(i); }
  auto decisions() const { return decisions_.leftCols(size_); }    ///< (dimension × size)
  auto objectives() const { return objectives_.leftCols(size_); }  ///< (objectives × size)

  /// A member by crowding; there must be one.
  Eigen::Index draw_leader(Rng& rng) const;

 private:
  void remove(Eigen::Index i);
  void update_cells() const;
  Eigen::Index draw(double exponent, Rng& rng) const;

  ArchiveParams params_;
  Eigen::MatrixXd decisions_;
  Eigen::MatrixXd objectives_;
  Eigen::Index size_ = 0;
  // The hypergrid is brought up to date when somebody draws from it.
  mutable bool cells_valid_ = false;
  mutable std::vector<std::uint64_t> cell_;   // of each member
  mutable std::vector<int> members_in_cell_;  // of each member: how many share its cell
};

}  // namespace swallowtail::swarm
