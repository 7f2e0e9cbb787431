#include "coverage/gtsp/detail/insertion.hpp"

#include <algorithm>
#include <limits>

namespace swallowtail::gtsp::detail {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

}  // namespace

int Inserter::skip() {
  if (blink <= 0.0) return std::numeric_limits<int>::max();
  return static_cast<int>(rng_.below(static_cast<std::uint64_t>(2.0 / blink)));
}

/// Only places whose two new arcs exist.
void Inserter::try_place(const WorkTour& tour, int cluster, int p, Place& best) const {
  const float* const out = reduced_.out_row(tour.at(p));
  const float* const in = reduced_.in_row(tour.at(tour.next(p)));
  float least = kNone;
  int vertex = -1;
  for (int v = reduced_.first(cluster); v < reduced_.last(cluster); ++v) {
    const float cost = out[v] + in[v];
    if (cost < least) {
      least = cost;
      vertex = v;
    }
  }
  if (vertex < 0) return;
  Score added{0, static_cast<double>(out[vertex]) + static_cast<double>(in[vertex])};
  added.subtract(tour.edge_at(p));
  if (added < best.added) best = {p, vertex, added};
}

void Inserter::try_missing(const WorkTour& tour, int cluster, int p, Place& best) const {
  const float* const out = reduced_.out_row(tour.at(p));
  const float* const in = reduced_.in_row(tour.at(tour.next(p)));
  for (int v = reduced_.first(cluster); v < reduced_.last(cluster); ++v) {
    Score added;
    added.add(out[v]);
    added.add(in[v]);
    added.subtract(tour.edge_at(p));
    if (added < best.added) best = {p, v, added};
  }
}

Place Inserter::best_place(const WorkTour& tour, int cluster) {
  const float* const least_out = reduced_.least_out(cluster);
  const float* const least_in = reduced_.least_in(cluster);
  const int size = tour.size();
  Place best;
  int left = skip();
  float limit = kNone;
  for (int p = 0; p < size; ++p) {
    if (left-- == 0) {
      left = skip();
      continue;
    }
    const float arcs = least_out[tour.at(p)] + least_in[tour.at(tour.next(p))];
    const float edge = tour.edge_at(p);
    const bool fills_gap = edge == kNone;
    if (arcs == kNone || (!fills_gap && arcs - edge >= limit)) continue;
    try_place(tour, cluster, p, best);
    if (best.vertex >= 0) limit = best.added.missing < 0 ? -kNone : static_cast<float>(best.added.cost);
  }
  if (best.vertex >= 0) return best;
  for (int p = 0; p < size; ++p) try_missing(tour, cluster, p, best);
  return best;
}

/// After an insertion behind `at`, the two new edges stand in place of one; others moved up.
void Inserter::update(const WorkTour& tour, int at, Pending& pending) {
  Place& place = pending.place;
  if (place.position == at || place.added.missing > 0) {
    place = best_place(tour, pending.cluster);
    return;
  }
  if (place.position > at) ++place.position;
  try_place(tour, pending.cluster, at, place);
  try_place(tour, pending.cluster, at + 1, place);
}

/// Index into pending_: usually the first by the rule, with falling probability a later one.
std::size_t Inserter::choose(InsertionRule rule) {
  const auto comes_first = [rule](const Pending& a, const Pending& b) {
    return rule == InsertionRule::kCheapest ? a.place.added < b.place.added : b.place.added < a.place.added;
  };
  std::size_t rank = 0;
  while (rank + 1 < pending_.size() && rng_.below(8) == 0) ++rank;
  for (std::size_t i = 0; i <= rank; ++i) {
    const auto start = pending_.begin() + static_cast<std::ptrdiff_t>(i);
    std::iter_swap(start, std::min_element(start, pending_.end(), comes_first));
  }
  return rank;
}

void Inserter::insert_all(WorkTour& tour, std::vector<int>& clusters, InsertionRule rule) {
  if (rule == InsertionRule::kRandom) {
    while (!clusters.empty()) {
      std::swap(clusters[rng_.below(clusters.size())], clusters.back());
      const Place place = best_place(tour, clusters.back());
      tour.insert(reduced_, place.position, place.vertex);
      clusters.pop_back();
    }
    return;
  }
  pending_.clear();
  for (const int c : clusters) pending_.push_back({c, best_place(tour, c)});
  clusters.clear();
  while (!pending_.empty()) {
    std::swap(pending_[choose(rule)], pending_.back());
    const Place place = pending_.back().place;
    pending_.pop_back();
    tour.insert(reduced_, place.position, place.vertex);
    for (Pending& p : pending_) update(tour, place.position, p);
  }
}

void Inserter::pick_vertex(WorkTour& tour, int p) const {
  const int cluster = reduced_.cluster_of(tour.at(p));
  const float* const out = reduced_.out_row(tour.at(tour.previous(p)));
  const float* const in = reduced_.in_row(tour.at(tour.next(p)));
  float least = out[tour.at(p)] + in[tour.at(p)];
  int vertex = tour.at(p);
  for (int v = reduced_.first(cluster); v < reduced_.last(cluster); ++v) {
    const float cost = out[v] + in[v];
    if (cost < least) {
      least = cost;
      vertex = v;
    }
  }
  if (vertex != tour.at(p)) tour.replace(reduced_, p, vertex);
}

}  // namespace swallowtail::gtsp::detail
