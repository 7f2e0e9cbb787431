#pragma once

#include <vector>

#include "coverage/gtsp/detail/insertion.hpp"
#include "coverage/gtsp/detail/work_tour.hpp"

namespace swallowtail::gtsp::detail {

/// Reverses stretches of a tour while that makes it better. Sums of the tour's costs in both directions make
/// each of the O(m²) moves O(1) to judge on asymmetric instances, too.
class TwoOpt {
 public:
  explicit TwoOpt(const Reduced& reduced) : reduced_(reduced) {}
  bool improve(WorkTour& tour);

 private:
  void sum_up(const WorkTour& tour);
  /// Change from reversing positions first … last.
  Score change(const WorkTour& tour, int first, int last) const;
  bool improve_once(WorkTour& tour);

  const Reduced& reduced_;
  std::vector<Score> forward_;   ///< from position 0 to p along the tour
  std::vector<Score> backward_;  ///< from p to position 0 against it
};

/// Moves single clusters to better places, with the best vertex there, while that makes the tour better
/// (or-opt of one, after which both neighbours choose their vertices anew).
bool move_clusters(const Reduced& reduced, Inserter& inserter, WorkTour& tour);

}  // namespace swallowtail::gtsp::detail
