#pragma once

#include <optional>
#include <vector>

#include "coverage/gtsp/instance.hpp"
#include "coverage/gtsp/solver.hpp"

namespace swallowtail::gtsp::detail {

/// All that is fixed about a tour (prefix, start, end, openness), folded into one vertex, so that what is
/// left to search is always a closed tour through it. An open tour without fixed ends has an anchor that
/// costs nothing to enter and to leave.
struct Anchor {
  static constexpr int kFree = -1;  ///< in place of a vertex: an arc from or to anywhere at cost 0

  bool is_used = false;
  int in_vertex = kFree;            ///< arcs into the anchor are those into this vertex
  int out_vertex = kFree;           ///< arcs out of the anchor are those out of this one
  std::vector<int> lead;            ///< opens the tour
  std::optional<int> end;           ///< closes it, unless the lead's last vertex already is it
  double inner_cost = 0.0;          ///< of the arcs between the fixed vertices; kNoArc if one is missing
  double self_cost = 0.0;           ///< from out to in: what is left to pay if nothing else is to be visited
  std::vector<char> fixed_cluster;  ///< by cluster of the instance: visited by the anchor
};

/// Options must be valid for the instance.
Anchor make_anchor(const Instance& instance, const Options& options);

/// The tour that a closed tour through the anchor stands for; `rest` are the vertices after the anchor, in
/// order.
std::vector<int> expanded(const Anchor& anchor, const std::vector<int>& rest);

/// Calls visit(to, cost) for each arc of the folded instance that leaves `from`: arcs between free vertices
/// of different clusters, and from or to the anchor, whose number is instance.vertex_count().
template <class Visit>
void for_each_arc(const Instance& instance, const Anchor& anchor, int from, Visit visit) {
  const int n = instance.vertex_count();
  const auto is_free = [&](int v) {
    return anchor.fixed_cluster[static_cast<std::size_t>(instance.cluster_of(v))] == 0;
  };
  if (from == n && anchor.out_vertex == Anchor::kFree) {
    for (int v = 0; v < n; ++v) {
      if (is_free(v)) visit(v, 0.0);
    }
    return;
  }
  const int source = from == n ? anchor.out_vertex : from;
  for (const Arc arc : instance.arcs_from(source)) {
    if (is_free(arc.to)) {
      if (instance.cluster_of(arc.to) != instance.cluster_of(source)) visit(arc.to, arc.cost);
    } else if (arc.to == anchor.in_vertex && from != n) {
      visit(n, arc.cost);
    }
  }
  if (anchor.is_used && anchor.in_vertex == Anchor::kFree && from != n) visit(n, 0.0);
}

/// Cost of one such arc, kNoArc when there is none.
double arc_cost(const Instance& instance, const Anchor& anchor, int from, int to);

}  // namespace swallowtail::gtsp::detail
