#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "coverage/gtsp/instance.hpp"
#include "planner/base/result.hpp"

namespace swallowtail::gtsp {

/// What a tour has to keep besides visiting each cluster once.
struct TourRule {
  bool returns_to_start = true;
  std::vector<int> prefix = {};
  std::optional<int> start = std::nullopt;
  std::optional<int> end = std::nullopt;
  std::vector<std::pair<int, int>> precedence = {};  ///< clusters: the first before the second
};

/// Cost of the tour, summed over the instance's arcs. Shares no code with the solver, so that it can judge
/// it. Errors (kInfeasible): a vertex that is not there, a cluster visited twice or never, a missing arc, a
/// rule not kept. O(m·n).
Result<double> check_tour(const Instance& instance, std::span<const int> tour, const TourRule& rule);

}  // namespace swallowtail::gtsp
