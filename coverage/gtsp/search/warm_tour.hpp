#pragma once

#include <vector>

#include "coverage/gtsp/search/problem.hpp"

namespace swallowtail::gtsp::search {

struct WarmTour {
  std::vector<int> tour;  ///< of the problem's vertices, each cluster at most once
  bool is_whole = false;  ///< it visits all clusters, with the vertices given
};

/// What of an earlier tour, given by the instance's vertices, is still of use, in order; the anchor first.
WarmTour usable_part(const Problem& problem, const std::vector<int>& original_tour);

/// The tour with each cluster that it misses put where that adds least. The tour is not empty. O(missing ×
/// tour).
std::vector<int> completed(const Problem& problem, std::vector<int> tour);

/// The tour with the clusters put in one after the other, likewise.
void insert_all(const Problem& problem, const std::vector<int>& clusters, std::vector<int>& tour);

}  // namespace swallowtail::gtsp::search
