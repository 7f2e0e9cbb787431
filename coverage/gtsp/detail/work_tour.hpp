#pragma once

#include <cstddef>
#include <vector>

#include "coverage/gtsp/detail/reduced.hpp"

namespace swallowtail::gtsp::detail {

/// A closed tour of a reduced instance under work: maybe not all clusters yet, maybe over missing arcs. At
/// least one vertex.
struct WorkTour {
  std::vector<int> order;
  std::vector<float> edge;  ///< edge[p] = cost from order[p] to the next
  Score score;

  int size() const { return static_cast<int>(order.size()); }
  int at(int p) const { return order[static_cast<std::size_t>(p)]; }
  int next(int p) const { return p + 1 < size() ? p + 1 : 0; }
  int previous(int p) const { return p > 0 ? p - 1 : size() - 1; }
  float edge_at(int p) const { return edge[static_cast<std::size_t>(p)]; }

  void measure(const Reduced& reduced) {
    edge.resize(order.size());
    score = {};
    for (int p = 0; p < size(); ++p) {
      edge[static_cast<std::size_t>(p)] = size() > 1 ? reduced.cost(at(p), at(next(p))) : 0.0F;
      score.add(edge_at(p));
    }
  }

  /// Puts v between position p and the next.
  void insert(const Reduced& reduced, int p, int v) {
    const float in = reduced.cost(at(p), v);
    const float out = reduced.cost(v, at(next(p)));
    score.subtract(edge_at(p));
    score.add(in);
    score.add(out);
    edge[static_cast<std::size_t>(p)] = in;
    order.insert(order.begin() + p + 1, v);
    edge.insert(edge.begin() + p + 1, out);
  }

  /// Puts v in the place of the vertex at p.
  void replace(const Reduced& reduced, int p, int v) {
    float& in = edge[static_cast<std::size_t>(previous(p))];
    float& out = edge[static_cast<std::size_t>(p)];
    score.subtract(in);
    score.subtract(out);
    in = reduced.cost(at(previous(p)), v);
    out = reduced.cost(v, at(next(p)));
    score.add(in);
    score.add(out);
    order[static_cast<std::size_t>(p)] = v;
  }
};

}  // namespace swallowtail::gtsp::detail
