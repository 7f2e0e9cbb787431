#pragma once

#include <vector>

#include "coverage/gtsp/detail/work_tour.hpp"

namespace swallowtail::gtsp::detail {

/// For the order in which a tour visits the clusters, the best vertex of each: shortest paths through the
/// layers of vertices, one per start vertex. Source: [FISCHETTI-SALAZAR-TOTH]. Missing arcs are counted when
/// they cannot be avoided. Runs rotated to the smallest cluster. O(sum of products of consecutive cluster
/// sizes × start vertices).
class ClusterPath {
 public:
  explicit ClusterPath(const Reduced& reduced);

  enum class Start {
    kAsIs,  ///< the smallest cluster keeps its vertex: fast
    kAny,   ///< exact for the order
  };
  /// Never makes the tour worse; returns whether it became better.
  bool improve(WorkTour& tour, Start start);

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  template <class Weight>
  bool improve_with(WorkTour& tour, Start start);
  template <class Weight>
  Weight shortest_from(const WorkTour& tour, int root, int start_vertex);

  const Reduced& reduced_;
  std::vector<int> parent_;  ///< by vertex
  std::vector<int> best_order_;
  int end_ = -1;
};

}  // namespace swallowtail::gtsp::detail
