#pragma once

#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"

namespace swallowtail::gtsp::detail {

/// Which vertices can be part of a tour at all, as far as degrees and reachability tell.
struct Pruning {
  std::vector<char> is_alive;   ///< n + 1; the last is the anchor
  int emptied_cluster = -1;     ///< of the instance; ≥ 0 proves that there is no tour
  int cutting_cluster = -1;     ///< without it the others do not hang together: proves it as well
  bool is_anchor_dead = false;  ///< and so does this

  bool has_no_tour() const { return emptied_cluster >= 0 || cutting_cluster >= 0 || is_anchor_dead; }
};

/// Drops vertices without an arc in from a living vertex and one out to another cluster's, and those that no
/// vertex of one chosen cluster reaches or that reach none of it, until nothing changes; then looks for a
/// cluster that all ways between others lead through. At least two clusters (the anchor counts)
/// must be left to visit. O(arcs).
Pruning prune(const Instance& instance, const Anchor& anchor);

/// Nothing dropped but what is fixed.
Pruning all_alive(const Instance& instance, const Anchor& anchor);

}  // namespace swallowtail::gtsp::detail
