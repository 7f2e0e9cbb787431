#include <cstdio>
#include <vector>

#include "coverage/gtsp/check_tour.hpp"
#include "coverage/gtsp/solver.hpp"

/// Twelve pairs of depots on a ring; the inner ones are nearer.
int main() {
  using namespace swallowtail;
  constexpr int kPairs = 12;
  std::vector<gtsp::ArcInput> roads;
  gtsp::Instance::Clusters pairs;
  for (int i = 0; i < kPairs; ++i) {
    pairs.push_back({2 * i, 2 * i + 1});
    const int next = (i + 1) % kPairs;
    roads.push_back({2 * i, 2 * next, 1.0});
    roads.push_back({2 * i + 1, 2 * next + 1, 2.0});
    roads.push_back({2 * i, 2 * next + 1, 1.5});
  }
  const auto instance = gtsp::Instance::from_arcs(2 * kPairs, pairs, roads);
  if (!instance) return 1;
  gtsp::Options options;
  options.mode = gtsp::Mode::kFast;
  const gtsp::Solution solution = gtsp::solve(*instance, options);
  const auto cost = gtsp::check_tour(*instance, solution.tour, {});
  if (!cost || cost.value() != solution.cost) return 2;
  std::printf("tour of cost %.1f, %s\n", solution.cost, gtsp::name_of(solution.status));
  return solution.proved_optimal && solution.cost == 12.0 ? 0 : 3;
}
