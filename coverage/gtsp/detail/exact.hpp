#pragma once

#include <cstdint>
#include <vector>

#include "coverage/gtsp/detail/reduced.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::gtsp::detail {

struct ExactAnswer {
  enum class Kind { kSolved, kNoTour, kTooLarge, kStopped };
  Kind kind = Kind::kTooLarge;
  std::vector<int> order;  ///< of the reduced instance's vertices
};

/// Cheapest closed tour by dynamic programming over subsets of clusters with the instance's own costs.
/// Source: [HELD-KARP], with (subset, last vertex) as state. Refuses when the elementary steps (about
/// 2^(m−1)·n²/4 per vertex of the cluster it starts from) are more than `work_limit`, or its table would take
/// more than 256 MB.
ExactAnswer solve_exactly(const Instance& instance, const Anchor& anchor, const Reduced& reduced,
                          double work_limit, const StopCondition& stop);

}  // namespace swallowtail::gtsp::detail
