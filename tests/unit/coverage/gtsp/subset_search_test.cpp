#include "coverage/gtsp/proof/subset_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/base/rng.hpp"

namespace swallowtail::gtsp::proof {
namespace {

struct Family {
  int clusters = 5;
  int most_vertices = 4;   ///< of a cluster
  double density = 1.0;    ///< share of the arcs
  double unit = 1.0;       ///< costs are multiples of it
  double largest = 100.0;  ///< cost, in units
  int rules = 0;           ///< pairs of clusters in order
};

SubsetProblem random_problem(const Family& family, Rng& rng) {
  SubsetProblem problem;
  int n = 0;
  for (int c = 0; c < family.clusters; ++c) {
    const int size = 1 + static_cast<int>(rng.below(static_cast<std::uint64_t>(family.most_vertices)));
    problem.clusters.emplace_back(static_cast<std::size_t>(size));
    std::iota(problem.clusters.back().begin(), problem.clusters.back().end(), n);
    n += size;
  }
  for (int arc = 0; arc < n * n; ++arc) {
    const double cost = family.unit * std::floor(rng.uniform(0.0, family.largest + 1.0));
    problem.cost.push_back(rng.uniform() < family.density ? cost : kNoArc);
  }
  if (family.rules == 0) return problem;
  problem.root = 0;
  problem.before.resize(static_cast<std::size_t>(family.clusters));
  for (int i = 0; i < family.rules; ++i) {
    const auto second = 2 + rng.below(static_cast<std::uint64_t>(family.clusters) - 2);
    problem.before[second].push_back(static_cast<int>(1 + rng.below(second - 1)));
  }
  return problem;
}

/// By trying all orders of the clusters, each with the best vertices for it.
double least_over_orders(const SubsetProblem& problem) {
  const std::size_t n = problem.vertex_count();
  std::vector<int> order(problem.clusters.size());
  std::iota(order.begin(), order.end(), 0);
  double best = kNoArc;
  do {
    const auto place = [&](int c) { return std::find(order.begin(), order.end(), c); };
    bool is_allowed = true;
    for (std::size_t c = 0; c < problem.before.size(); ++c) {
      for (const int earlier : problem.before[c])
        is_allowed = is_allowed && place(earlier) < place(static_cast<int>(c));
    }
    for (const int root : problem.clusters.front()) {
      if (!is_allowed) break;
      std::vector<double> reach(n, kNoArc);
      reach[static_cast<std::size_t>(root)] = 0.0;
      std::vector<int> last{root};
      for (std::size_t i = 1; i <= order.size(); ++i) {
        const std::vector<int> next =
            i < order.size() ? problem.clusters[static_cast<std::size_t>(order[i])] : std::vector<int>{root};
        std::vector<double> sums;
        for (const int v : next) {
          sums.push_back(kNoArc);
          for (const int u : last) {
            const double arc = problem.cost[static_cast<std::size_t>(u) * n + static_cast<std::size_t>(v)];
            sums.back() = std::min(sums.back(), reach[static_cast<std::size_t>(u)] + arc);
          }
        }
        for (std::size_t j = 0; j < next.size(); ++j) reach[static_cast<std::size_t>(next[j])] = sums[j];
        last = next;
      }
      best = std::min(best, reach[static_cast<std::size_t>(root)]);
    }
  } while (std::next_permutation(order.begin() + 1, order.end()));
  return best;
}

double cost_of(const SubsetProblem& problem, const std::vector<int>& tour) {
  double sum = 0.0;
  const std::size_t n = problem.vertex_count();
  for (std::size_t i = 0; i < tour.size(); ++i)
    sum += problem.cost[static_cast<std::size_t>(tour[i]) * n +
                        static_cast<std::size_t>(tour[(i + 1) % tour.size()])];
  return sum;
}

bool visits_each_once(const SubsetProblem& problem, const std::vector<int>& tour) {
  if (tour.size() != problem.clusters.size()) return false;
  return std::all_of(problem.clusters.begin(), problem.clusters.end(), [&](const auto& cluster) {
    return std::count_if(cluster.begin(), cluster.end(),
                         [&](int v) { return std::find(tour.begin(), tour.end(), v) != tour.end(); }) == 1;
  });
}

bool keeps_rules(const SubsetProblem& problem, const std::vector<int>& tour) {
  const auto place = [&](int c) {
    const auto& cluster = problem.clusters[static_cast<std::size_t>(c)];
    return std::find_if(tour.begin(), tour.end(),
                        [&](int v) { return std::find(cluster.begin(), cluster.end(), v) != cluster.end(); });
  };
  for (std::size_t c = 0; c < problem.before.size(); ++c) {
    for (const int earlier : problem.before[c]) {
      if (place(earlier) > place(static_cast<int>(c))) return false;
    }
  }
  return true;
}

class SubsetSearch : public testing::TestWithParam<Family> {};

TEST_P(SubsetSearch, FindsTheBestTourAndProvesThereIsNoBetter) {
  Rng rng(17);
  const double tolerance = GetParam().unit == std::floor(GetParam().unit) ? 0.0 : 1e-9;
  for (int i = 0; i < 60; ++i) {
    const SubsetProblem problem = random_problem(GetParam(), rng);
    const double best = least_over_orders(problem);
    const SubsetAnswer answer = search_subsets(problem, {}, {});
    if (best == kNoArc) {
      EXPECT_EQ(answer.kind, SubsetAnswer::Kind::kNone) << "case " << i;
      EXPECT_TRUE(answer.tour.empty());
      continue;
    }
    ASSERT_EQ(answer.kind, SubsetAnswer::Kind::kTour) << "case " << i;
    EXPECT_NEAR(answer.cost, best, tolerance * best) << "case " << i;
    EXPECT_NEAR(cost_of(problem, answer.tour), best, tolerance * best) << "case " << i;
    EXPECT_EQ(answer.lower_bound, answer.cost);
    EXPECT_TRUE(visits_each_once(problem, answer.tour)) << "case " << i;
    EXPECT_TRUE(keeps_rules(problem, answer.tour)) << "case " << i;
    const SubsetAnswer none = search_subsets(problem, {.upper_bound = best * (1.0 - tolerance)}, {});
    EXPECT_EQ(none.kind, SubsetAnswer::Kind::kNone) << "case " << i;
    const SubsetAnswer again = search_subsets(problem, {.upper_bound = best + GetParam().unit}, {});
    ASSERT_EQ(again.kind, SubsetAnswer::Kind::kTour) << "case " << i;
    EXPECT_NEAR(again.cost, best, tolerance * best) << "case " << i;
  }
}

TEST_P(SubsetSearch, GivesAValidBoundWhereWorkEnds) {
  Rng rng(18);
  for (int i = 0; i < 40; ++i) {
    const SubsetProblem problem = random_problem(GetParam(), rng);
    const double best = least_over_orders(problem);
    for (const double work : {0.0, 1e3, 1e4, 1e5}) {
      const SubsetAnswer answer = search_subsets(problem, {.work = work}, {});
      EXPECT_LE(answer.lower_bound, best == kNoArc ? kNoArc : best * (1.0 + 1e-9)) << "case " << i;
      EXPECT_GE(answer.cost, best * (1.0 - 1e-9)) << "case " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Families, SubsetSearch,
    testing::Values(Family{}, Family{.clusters = 2, .most_vertices = 40},
                    Family{.clusters = 6, .most_vertices = 12}, Family{.clusters = 5, .density = 0.35},
                    Family{.clusters = 6, .most_vertices = 3, .density = 0.2},
                    Family{.clusters = 5, .most_vertices = 12, .unit = 1.0 / 7.0},
                    Family{.clusters = 5, .density = 0.4, .unit = 1.0 / 7.0},
                    Family{.clusters = 5, .largest = 1e12}, Family{.clusters = 5, .largest = 5e7},
                    Family{.clusters = 6, .most_vertices = 6, .density = 0.8, .rules = 4},
                    Family{.clusters = 5, .most_vertices = 6, .unit = 1.0 / 7.0, .rules = 2}));

template <class Cost>
void expect_least_ways_on(Cost none) {
  Rng rng(3);
  for (int width = kSubsetLanes; width <= 9 * kSubsetLanes; width += kSubsetLanes) {
    std::vector<Cost> cost;
    for (int i = 0; i < 20 * width; ++i)
      cost.push_back(rng.uniform() < 0.3 ? none : static_cast<Cost>(rng.uniform(0.0, 1e4)));
    std::vector<Cost> value;
    std::vector<int> from;
    for (int i = 0; i < 12; ++i) {
      value.push_back(static_cast<Cost>(rng.uniform(0.0, 1e4)));
      from.push_back(static_cast<int>(rng.below(20)));
    }
    for (const int count : {0, 1, 12}) {
      std::vector<Cost> least(static_cast<std::size_t>(width));
      least_ways_on(value.data(), from.data(), count, cost.data(), width, least.data());
      for (int lane = 0; lane < width; ++lane) {
        Cost expected = none;
        for (int i = 0; i < count; ++i) {
          const auto at = static_cast<std::size_t>(from[static_cast<std::size_t>(i)] * width + lane);
          if (cost[at] != none)
            expected = std::min<Cost>(expected, value[static_cast<std::size_t>(i)] + cost[at]);
        }
        EXPECT_EQ(least[static_cast<std::size_t>(lane)], expected);
      }
    }
  }
}

TEST(SubsetKernel, AddsAndTakesTheLeastInEveryWidth) {
  expect_least_ways_on<std::int32_t>(kNoWay32);
  expect_least_ways_on<double>(kNoArc);
}

}  // namespace
}  // namespace swallowtail::gtsp::proof
