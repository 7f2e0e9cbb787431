#include <algorithm>
#include <bit>
#include <cmath>

#include "coverage/gtsp/detail/precedence_search.hpp"

namespace swallowtail::gtsp::detail {
namespace {

constexpr double kMostWork = 5e7;
constexpr int kMostClusters = 16;

}  // namespace

bool PrecedenceSearch::is_tiny() const {
  const double n = instance_.vertex_count();
  const double starts = lead_.empty() ? n : 1.0;
  return static_cast<int>(free_.size()) <= kMostClusters &&
         std::ldexp(n * n / 4.0 * starts, static_cast<int>(free_.size())) <= kMostWork;
}

void PrecedenceSearch::solve_subsets() {
  if (!lead_.empty()) {
    extend_subsets({});
    return;
  }
  if (free_.empty()) {
    tour_ = {*end_};
    best_ = {tour_, 0.0};
    incumbents_.offer(best_, 0);
    return;
  }
  for (const int c : free_) {
    for (const int v : instance_.cluster(c)) extend_subsets(v);
  }
}

/// The cheapest way through the free clusters after the lead, or after `first` if there is none: by set of
/// clusters visited and last vertex. A cluster may come when all its predecessors have.
void PrecedenceSearch::extend_subsets(std::optional<int> first) {
  tour_ = lead_;
  if (first) tour_.push_back(*first);
  std::vector<int> bit_of(at(cluster_count()), -1);
  std::vector<int> order;
  for (const int c : free_) {
    if (first && instance_.cluster_of(*first) == c) continue;
    if (first && precedes(c, instance_.cluster_of(*first))) return;
    bit_of[at(c)] = static_cast<int>(order.size());
    order.push_back(c);
  }
  double begin = 0.0;
  for (std::size_t i = 1; i < tour_.size(); ++i) begin += instance_.cost(tour_[i - 1], tour_[i]);
  const std::size_t n = at(instance_.vertex_count());
  const std::size_t sets = std::size_t{1} << order.size();
  std::vector<double> reach(sets * n, kNoArc);
  std::vector<int> from(sets * n, -1);
  reach[at(tour_.back())] = begin;
  for (std::size_t set = 0; set < sets; ++set) {
    for (std::size_t bit = 0; bit < order.size(); ++bit) {
      const bool waits = std::any_of(order.begin(), order.end(), [&](int other) {
        return (set >> bit_of[at(other)] & 1) == 0 && precedes(other, order[bit]);
      });
      if ((set >> bit & 1) != 0 || waits) continue;
      const std::size_t next = set | std::size_t{1} << bit;
      for (std::size_t u = 0; u < n; ++u) {
        if (reach[set * n + u] == kNoArc) continue;
        for (const int v : instance_.cluster(order[bit])) {
          const double sum = reach[set * n + u] + instance_.cost(static_cast<int>(u), v);
          if (!(sum < reach[next * n + at(v)])) continue;
          reach[next * n + at(v)] = sum;
          from[next * n + at(v)] = static_cast<int>(u);
        }
      }
    }
  }
  const int head = tour_.front();
  for (std::size_t u = 0; u < n; ++u) {
    double sum = reach[(sets - 1) * n + u];
    int last = static_cast<int>(u);
    if (end_) {
      sum += instance_.cost(last, *end_);
      last = *end_;
    }
    if (is_closed_ && last != head) sum += instance_.cost(last, head);
    if (!(sum < best_.cost)) continue;
    std::vector<int> tail;
    std::size_t set = sets - 1;
    for (int v = static_cast<int>(u); set != 0;) {
      tail.push_back(v);
      const int before = from[set * n + at(v)];
      set &= ~(std::size_t{1} << bit_of[at(instance_.cluster_of(v))]);
      v = before;
    }
    best_.tour = tour_;
    best_.tour.insert(best_.tour.end(), tail.rbegin(), tail.rend());
    if (end_) best_.tour.push_back(*end_);
    best_.cost = sum;
    incumbents_.offer(best_, 0);
  }
}

}  // namespace swallowtail::gtsp::detail
