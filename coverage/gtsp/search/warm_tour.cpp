#include "coverage/gtsp/search/warm_tour.hpp"

#include <limits>

namespace swallowtail::gtsp::search {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Place {
  std::size_t before = 0;  ///< index of the vertex it follows
  int vertex = 0;
  Cost added = std::numeric_limits<Cost>::max();
};

template <class Costs>
Place best_place(const Problem& problem, const Costs& costs, const std::vector<int>& tour, int cluster) {
  Place best;
  for (std::size_t i = 0; i < tour.size(); ++i) {
    const int a = tour[i];
    const int b = tour[i + 1 < tour.size() ? i + 1 : 0];
    const Cost broken = a == b ? 0 : costs(a, b);
    for (int v = problem.first(cluster); v < problem.last(cluster); ++v) {
      const Cost added = costs(a, v) + costs(v, b) - broken;
      if (added < best.added) best = {i, v, added};
    }
  }
  return best;
}

}  // namespace

WarmTour usable_part(const Problem& problem, const std::vector<int>& original_tour) {
  WarmTour warm;
  std::vector<char> is_in(at(problem.cluster_count()), 0);
  const auto append = [&](int v) {
    char& visited = is_in[at(problem.cluster_of(v))];
    if (visited == 0) warm.tour.push_back(v);
    visited = 1;
  };
  if (problem.anchor() >= 0) append(problem.anchor());
  for (const int original : original_tour) {
    if (original < 0 || original >= problem.original_count()) continue;
    const int v = problem.numbered(original);
    if (v >= 0) append(v);
  }
  warm.is_whole = static_cast<int>(warm.tour.size()) == problem.cluster_count();
  return warm;
}

std::vector<int> completed(const Problem& problem, std::vector<int> tour) {
  std::vector<char> is_in(at(problem.cluster_count()), 0);
  for (const int v : tour) is_in[at(problem.cluster_of(v))] = 1;
  std::vector<int> missed;
  for (int c = 0; c < problem.cluster_count(); ++c) {
    if (is_in[at(c)] == 0) missed.push_back(c);
  }
  insert_all(problem, missed, tour);
  return tour;
}

void insert_all(const Problem& problem, const std::vector<int>& clusters, std::vector<int>& tour) {
  problem.with_costs([&](const auto& costs) {
    for (const int c : clusters) {
      const Place place = best_place(problem, costs, tour, c);
      tour.insert(tour.begin() + static_cast<std::ptrdiff_t>(place.before) + 1, place.vertex);
    }
  });
}

}  // namespace swallowtail::gtsp::search
