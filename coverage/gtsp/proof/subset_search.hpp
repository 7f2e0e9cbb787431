#pragma once

#include <vector>

#include "coverage/gtsp/instance.hpp"
#include "coverage/gtsp/proof/subset_table.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::gtsp::proof {

/// Closed tours through one vertex of each cluster.
struct SubsetProblem {
  std::vector<std::vector<int>> clusters;  ///< of vertices 0 … n−1; two at least
  std::vector<double> cost;                ///< n×n, row = from; kNoArc = no arc
  /// Where tours begin; −1: nothing depends on it.
  int root = -1;
  /// By cluster, those that come between the root and it; empty: no rule. Needs a root.
  std::vector<std::vector<int>> before = {};

  std::size_t vertex_count() const;
};

inline constexpr int kMostSubsetVertices = 2'000;
inline constexpr int kMostSubsetClusters = 25;

struct SubsetLimits {
  double upper_bound = kNoArc;  ///< only tours that cost less are looked for
  double work = 1e9;            ///< additions, up to a dozen a nanosecond
  double max_bytes = 256e6;
};

struct SubsetAnswer {
  enum class Kind {
    kTour,     ///< the cheapest tour
    kNone,     ///< no tour costs less than the upper bound
    kTooMuch,  ///< of work or memory
    kStopped
  };
  Kind kind = Kind::kTooMuch;
  std::vector<int> tour;  ///< root first; the best found, if any, whatever the kind
  double cost = kNoArc;
  double lower_bound = 0.0;  ///< no tour costs less, nor than the upper bound
};

/// Cheapest tour by dynamic programming over (set of clusters, last vertex) [HELD-KARP], in integers where
/// the costs are such and small enough, else in doubles. Ways back that may end at any vertex of the root
/// cluster are found for all sets first; with the upper bound they leave few vertices and few sets to each of
/// the ways out of one root vertex. Up to kMostSubsetClusters and kMostSubsetVertices.
SubsetAnswer search_subsets(const SubsetProblem& problem, const SubsetLimits& limits,
                            const StopCondition& stop);

}  // namespace swallowtail::gtsp::proof
