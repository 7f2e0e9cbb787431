#pragma once

#include <vector>

#include "coverage/gtsp/detail/work_tour.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp::detail {

/// Which clusters are taken out: strings of the tour around one cluster, one stretch of the tour, a cluster
/// and its nearest, those that cost most where they are, or any.
enum class RemovalRule { kStrings, kSegment, kNear, kWorst, kRandom };
inline constexpr int kRemovalRules = 5;

/// Takes clusters out of tours. O(tour).
class Remover {
 public:
  Remover(const Reduced& reduced, Rng& rng)
      : reduced_(reduced), rng_(rng), position_(static_cast<std::size_t>(reduced.cluster_count())) {}

  /// `from` without the `count` clusters named in removed(); at least two vertices stay. `from` visits all
  /// clusters.
  void remove(const WorkTour& from, int count, RemovalRule rule, WorkTour& to);
  std::vector<int>& removed() { return removed_; }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  /// Any position; while arcs are missing, often one of theirs.
  int seed(const WorkTour& tour);
  void mark(const WorkTour& tour, int p);
  int cluster_at(const WorkTour& tour, int p) const { return reduced_.cluster_of(tour.at(p)); }
  void mark_strings(const WorkTour& tour, int count);
  void mark_string(const WorkTour& tour, int p, int length, int count);
  void mark_segment(const WorkTour& tour, int count);
  void mark_near(const WorkTour& tour, int count);
  void mark_worst(const WorkTour& tour, int count);
  void mark_random(const WorkTour& tour, int count);
  void copy_rest(const WorkTour& from, WorkTour& to);

  const Reduced& reduced_;
  Rng& rng_;
  std::vector<int> position_;  ///< by cluster
  std::vector<char> is_marked_;
  std::vector<int> removed_;
  std::vector<std::pair<float, int>> by_gain_;
};

}  // namespace swallowtail::gtsp::detail
