#include "coverage/gtsp/detail/cluster_path.hpp"

#include <limits>

namespace swallowtail::gtsp::detail {
namespace {

/// For tours without missing arcs.
struct Plain {
  double cost = std::numeric_limits<double>::infinity();
  static Plain zero() { return {0.0}; }
  Plain plus(float arc) const { return {cost + static_cast<double>(arc)}; }
  friend bool operator<(const Plain& a, const Plain& b) { return a.cost < b.cost; }
  static Plain of(const Score& s) { return s.missing > 0 ? Plain{} : Plain{s.cost}; }
};

struct Counted {
  Score score{1 << 20, 0.0};
  static Counted zero() { return {Score{}}; }
  Counted plus(float arc) const {
    Counted sum = *this;
    sum.score.add(arc);
    return sum;
  }
  friend bool operator<(const Counted& a, const Counted& b) { return a.score < b.score; }
  static Counted of(const Score& s) { return {s}; }
};

template <class Weight>
struct Layers {
  std::vector<Weight> here;
  std::vector<Weight> next;
};

}  // namespace

ClusterPath::ClusterPath(const Reduced& reduced) : reduced_(reduced), parent_(at(reduced.size()), -1) {}

template <class Weight>
Weight ClusterPath::shortest_from(const WorkTour& tour, int root, int start_vertex) {
  thread_local Layers<Weight> layers;
  auto& here = layers.here;
  auto& next = layers.next;
  int cluster = reduced_.cluster_of(start_vertex);
  int first = start_vertex;
  here.assign(1, Weight::zero());
  for (int step = 1, p = tour.next(root); step < tour.size(); ++step, p = tour.next(p)) {
    cluster = reduced_.cluster_of(tour.at(p));
    next.assign(at(reduced_.cluster_size(cluster)), Weight{});
    for (int v = reduced_.first(cluster); v < reduced_.last(cluster); ++v) {
      const float* const in = reduced_.in_row(v) + first;
      Weight best;
      int parent = -1;
      for (std::size_t i = 0; i < here.size(); ++i) {
        const Weight weight = here[i].plus(in[i]);
        if (weight < best) {
          best = weight;
          parent = first + static_cast<int>(i);
        }
      }
      next[at(v - reduced_.first(cluster))] = best;
      parent_[at(v)] = parent;
    }
    here.swap(next);
    first = reduced_.first(cluster);
  }
  Weight best;
  end_ = -1;
  for (std::size_t i = 0; i < here.size(); ++i) {
    const int v = first + static_cast<int>(i);
    const Weight weight = here[i].plus(reduced_.cost(v, start_vertex));
    if (weight < best) {
      best = weight;
      end_ = v;
    }
  }
  return best;
}

template <class Weight>
bool ClusterPath::improve_with(WorkTour& tour, Start start) {
  int root = 0;
  for (int p = 1; p < tour.size(); ++p) {
    if (reduced_.cluster_size(reduced_.cluster_of(tour.at(p))) <
        reduced_.cluster_size(reduced_.cluster_of(tour.at(root))))
      root = p;
  }
  const int cluster = reduced_.cluster_of(tour.at(root));
  const int begin = start == Start::kAsIs ? tour.at(root) : reduced_.first(cluster);
  const int end = start == Start::kAsIs ? begin + 1 : reduced_.last(cluster);
  Weight best = Weight::of(tour.score);
  best_order_.clear();
  for (int start_vertex = begin; start_vertex < end; ++start_vertex) {
    const Weight weight = shortest_from<Weight>(tour, root, start_vertex);
    if (!(weight < best)) continue;
    best = weight;
    best_order_.assign(tour.order.size(), start_vertex);
    for (int v = end_, p = tour.previous(root); p != root; v = parent_[at(v)], p = tour.previous(p))
      best_order_[at(p)] = v;
  }
  if (best_order_.empty()) return false;
  const WorkTour before = tour;
  tour.order = best_order_;
  tour.measure(reduced_);
  if (tour.score < before.score) return true;
  tour = before;
  return false;
}

bool ClusterPath::improve(WorkTour& tour, Start start) {
  if (tour.size() < 2) return false;
  if (improve_with<Plain>(tour, start)) return true;
  return tour.score.missing > 0 && improve_with<Counted>(tour, start);
}

}  // namespace swallowtail::gtsp::detail
