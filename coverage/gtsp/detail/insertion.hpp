#pragma once

#include <vector>

#include "coverage/gtsp/detail/work_tour.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp::detail {

/// In which order removed clusters come back: each goes to its best place.
enum class InsertionRule { kRandom, kCheapest, kFarthest };
inline constexpr int kInsertionRules = 3;

struct Place {
  int position = -1;  ///< between it and the next
  int vertex = -1;
  Score added{1 << 20, 0.0};
};

/// Where a cluster's insertion adds least. Positions are skipped at random with probability `blink`
/// [CHRISTIAENS-VANDEN-BERGHE]. A place that adds no missing arc is preferred to any other; only without one
/// are the ways to add some compared. The tour has two vertices or more. O(tour + places that look promising
/// × cluster).
class Inserter {
 public:
  Inserter(const Reduced& reduced, Rng& rng) : reduced_(reduced), rng_(rng) {}

  double blink = 0.01;

  Place best_place(const WorkTour& tour, int cluster);
  /// Inserts all of `clusters`, which is used up.
  void insert_all(WorkTour& tour, std::vector<int>& clusters, InsertionRule rule);
  /// For the vertex at p and its neighbours in the tour: the best vertex of the cluster in that place.
  void pick_vertex(WorkTour& tour, int p) const;

 private:
  struct Pending {
    int cluster = 0;
    Place place;
  };

  void try_place(const WorkTour& tour, int cluster, int p, Place& best) const;
  void try_missing(const WorkTour& tour, int cluster, int p, Place& best) const;
  int skip();
  void update(const WorkTour& tour, int inserted_at, Pending& pending);
  std::size_t choose(InsertionRule rule);

  const Reduced& reduced_;
  Rng& rng_;
  std::vector<Pending> pending_;
};

}  // namespace swallowtail::gtsp::detail
