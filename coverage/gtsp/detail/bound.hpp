#pragma once

#include "coverage/gtsp/detail/anchor.hpp"
#include "coverage/gtsp/detail/pruning.hpp"

namespace swallowtail::gtsp::detail {

/// A bound from below on closed tours of the folded instance, and what proves that there are none.
struct Bound {
  double value = 0.0;     ///< kNoArc: there is no tour
  double rounding = 0.0;  ///< how far the exact bound may be above: a tour that costs no more than value +
                          ///< rounding is optimal
  /// Then, of the instance (its cluster count for the anchor): one of a set with too few clusters to go on
  /// to.
  int starved_cluster = -1;
};

/// Up to kMaxAssignedClusters clusters, the assignment of a successor to each cluster at least exact arc cost
/// (shortest augmenting paths with potentials, [KUHN] in the O(m³) form of [JONKER-VOLGENANT]); beyond, the
/// larger of the sums of each cluster's cheapest arc out and in. Lowered by the rounding that sums of doubles
/// may have, unless they are integers.
/// At least two clusters must be left to visit (the anchor counts) and none be emptied.
Bound lower_bound(const Instance& instance, const Anchor& anchor, const Pruning& pruning);
inline constexpr int kMaxAssignedClusters = 400;

}  // namespace swallowtail::gtsp::detail
