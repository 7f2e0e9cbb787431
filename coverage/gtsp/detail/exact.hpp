#pragma once

#include <span>
#include <utility>
#include <vector>

#include "coverage/gtsp/detail/anchor.hpp"
#include "coverage/gtsp/detail/pruning.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::gtsp::detail {

struct ExactParams {
  double work = 1e9;  ///< additions, up to a dozen a nanosecond
  /// Of clusters of the instance, as Options::precedence.
  std::span<const std::pair<int, int>> precedence = {};
};

struct ExactAnswer {
  enum class Kind { kSolved, kNoTour, kTooLarge, kStopped };
  Kind kind = Kind::kTooLarge;
  std::vector<int> order;    ///< closed; vertices of the instance, its vertex count for the anchor
  double lower_bound = 0.0;  ///< of closed tours of the folded instance
};

/// Cheapest closed tour by dynamic programming over subsets of clusters with the instance's own costs
/// (proof::search_subsets). At least two clusters (the anchor counts) must be left to visit, none emptied.
ExactAnswer solve_exactly(const Instance& instance, const Anchor& anchor, const Pruning& pruning,
                          const ExactParams& params, const StopCondition& stop);

}  // namespace swallowtail::gtsp::detail
