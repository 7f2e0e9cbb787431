#pragma once

#include <vector>

#include "coverage/gtsp/search/array_tour.hpp"
#include "coverage/gtsp/search/problem.hpp"

namespace swallowtail::gtsp::search {

/// For the order in which a tour visits the clusters of a stretch, the best vertex of each, what lies around
/// the stretch being kept: the cluster optimisation of [FISCHETTI-SALAZAR-TOTH] on a window. O(sum of
/// products of consecutive cluster sizes).
template <class Costs>
class VertexChoice {
 public:
  VertexChoice(const Problem& problem, Costs costs) : problem_(problem), costs_(costs) {}

  /// The stretch has `length` positions from `first` (cyclic), less than the whole tour. Calls set(position,
  /// vertex) for each vertex to be changed when that makes the tour cheaper; returns the change of its cost.
  template <class Set>
  Cost improve(const ArrayTour& tour, int first, int length, Set set) {
    lay_out(tour, first, length);
    const Cost change = reach_.back() - now_;
    if (change >= 0) return 0;
    int state = static_cast<int>(reach_.size()) - 1;
    int p = (first + length - 1) % tour.size();
    for (int layer = length - 1; layer >= 0; --layer, p = tour.previous(p)) {
      state = parent_[static_cast<std::size_t>(state)];
      const int v = vertex_[static_cast<std::size_t>(state)];
      if (v != tour.vertex(p)) set(p, v);
    }
    return change;
  }

 private:
  void lay_out(const ArrayTour& tour, int first, int length) {
    reach_.clear();
    parent_.clear();
    vertex_.clear();
    int p = tour.previous(first);
    add(tour.vertex(p), 0, -1);
    now_ = 0;
    int begin = 0;
    for (int layer = 0; layer <= length; ++layer) {
      const int from = tour.vertex(p);
      p = tour.next(p);
      const int to = tour.vertex(p);
      now_ += costs_(from, to);
      const int end = static_cast<int>(reach_.size());
      if (layer == length) {
        join(begin, end, to);
      } else {
        const int c = problem_.cluster_of(to);
        for (int v = problem_.first(c); v < problem_.last(c); ++v) join(begin, end, v);
      }
      begin = end;
    }
  }

  void add(int v, Cost reach, int parent) {
    vertex_.push_back(v);
    reach_.push_back(reach);
    parent_.push_back(parent);
  }

  void join(int begin, int end, int v) {
    Cost best = std::numeric_limits<Cost>::max();
    int parent = begin;
    for (int u = begin; u < end; ++u) {
      const Cost reach =
          reach_[static_cast<std::size_t>(u)] + costs_(vertex_[static_cast<std::size_t>(u)], v);
      if (reach < best) {
        best = reach;
        parent = u;
      }
    }
    add(v, best, parent);
  }

  const Problem& problem_;
  Costs costs_;
  Cost now_ = 0;
  std::vector<int> vertex_;
  std::vector<Cost> reach_;
  std::vector<int> parent_;
};

}  // namespace swallowtail::gtsp::search
