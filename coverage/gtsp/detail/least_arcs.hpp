#pragma once

#include <cstddef>
#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"
#include "coverage/gtsp/detail/pruning.hpp"

namespace swallowtail::gtsp::detail {

/// The cheapest arc from each cluster to each other one, over the vertices that can be part of a tour.
/// Clusters are numbered anew: those of the instance with such vertices, in their order, then the anchor.
class LeastArcs {
 public:
  /// Needs at least two clusters left to visit (the anchor counts) and no emptied one.
  LeastArcs(const Instance& instance, const Anchor& anchor, const Pruning& pruning);

  int cluster_count() const { return static_cast<int>(cluster_.size()); }
  /// The instance's number of a cluster; its cluster count for the anchor.
  int cluster(int c) const { return cluster_[static_cast<std::size_t>(c)]; }
  double operator()(int from_cluster, int to_cluster) const {
    return least_[static_cast<std::size_t>(from_cluster) * cluster_.size() +
                  static_cast<std::size_t>(to_cluster)];
  }

 private:
  std::vector<int> cluster_;
  std::vector<double> least_;
};

}  // namespace swallowtail::gtsp::detail
