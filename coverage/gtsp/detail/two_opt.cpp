#include "coverage/gtsp/detail/two_opt.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::gtsp::detail {
namespace {

constexpr int kMaxRounds = 1000;

/// Improvements below what rounding may feign do not count.
bool is_gain(const Score& change, const Score& total) {
  if (change.missing != 0) return change.missing < 0;
  return change.cost < -1e-9 * (1.0 + std::abs(total.cost));
}

}  // namespace

void TwoOpt::sum_up(const WorkTour& tour) {
  const auto n = tour.order.size();
  forward_.assign(n, {});
  backward_.assign(n, {});
  for (std::size_t p = 1; p < n; ++p) {
    forward_[p] = forward_[p - 1];
    forward_[p].add(tour.edge[p - 1]);
    backward_[p] = backward_[p - 1];
    backward_[p].add(reduced_.cost(tour.order[p], tour.order[p - 1]));
  }
}

Score TwoOpt::change(const WorkTour& tour, int first, int last) const {
  const auto f = static_cast<std::size_t>(first);
  const auto l = static_cast<std::size_t>(last);
  Score sum{backward_[l].missing - backward_[f].missing - forward_[l].missing + forward_[f].missing,
            backward_[l].cost - backward_[f].cost - forward_[l].cost + forward_[f].cost};
  const int before = tour.previous(first);
  sum.subtract(tour.edge_at(before));
  sum.subtract(tour.edge_at(last));
  sum.add(reduced_.cost(tour.at(before), tour.at(last)));
  sum.add(reduced_.cost(tour.at(first), tour.at(tour.next(last))));
  return sum;
}

bool TwoOpt::improve_once(WorkTour& tour) {
  const int n = tour.size();
  Score best;
  int best_first = -1;
  int best_last = -1;
  for (int first = 1; first < n; ++first) {
    for (int last = first + 1; last < n; ++last) {
      const Score sum = change(tour, first, last);
      if (sum < best && is_gain(sum, tour.score)) {
        best = sum;
        best_first = first;
        best_last = last;
      }
    }
  }
  if (best_first < 0) return false;
  std::reverse(tour.order.begin() + best_first, tour.order.begin() + best_last + 1);
  tour.measure(reduced_);
  return true;
}

bool TwoOpt::improve(WorkTour& tour) {
  if (tour.size() < 4) return false;
  bool improved = false;
  for (int round = 0; round < kMaxRounds; ++round) {
    sum_up(tour);
    if (!improve_once(tour)) break;
    improved = true;
  }
  return improved;
}

bool move_clusters(const Reduced& reduced, Inserter& inserter, WorkTour& tour) {
  if (tour.size() < 4) return false;
  bool improved = false;
  WorkTour trial;
  for (int misses = 0, p = 0; misses < tour.size(); p = (p + 1) % tour.size()) {
    trial = tour;
    const int cluster = reduced.cluster_of(trial.at(p));
    trial.order.erase(trial.order.begin() + p);
    trial.measure(reduced);
    const Place place = inserter.best_place(trial, cluster);
    trial.insert(reduced, place.position, place.vertex);
    const int inserted = place.position + 1;
    inserter.pick_vertex(trial, trial.previous(inserted));
    inserter.pick_vertex(trial, trial.next(inserted));
    const Score change{trial.score.missing - tour.score.missing, trial.score.cost - tour.score.cost};
    ++misses;
    if (!is_gain(change, tour.score)) continue;
    tour = trial;
    improved = true;
    misses = 0;
  }
  return improved;
}

}  // namespace swallowtail::gtsp::detail
