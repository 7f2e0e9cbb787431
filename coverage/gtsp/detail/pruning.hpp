#pragma once

#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"

namespace swallowtail::gtsp::detail {

/// Which vertices can be part of a tour at all, as far as degrees and reachability tell.
struct Pruning {
  std::vector<char> is_alive;   ///< n + 1; the last is the anchor
  int emptied_cluster = -1;     ///< of the instance; ≥ 0 proves that there is no tour
  bool is_anchor_dead = false;  ///< proves it as well
};

/// Drops vertices without an arc in from or out to a living vertex, and those that no vertex of one chosen
/// cluster reaches or that reach none of it, until nothing changes. At least two clusters (the anchor counts)
/// must be left to visit. O(arcs).
Pruning prune(const Instance& instance, const Anchor& anchor);

/// Nothing dropped but what is fixed.
Pruning all_alive(const Instance& instance, const Anchor& anchor);

}  // namespace swallowtail::gtsp::detail
