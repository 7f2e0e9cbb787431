#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coverage/gtsp/check_tour.hpp"
#include "coverage/gtsp/search/chains.hpp"
#include "coverage/gtsp/search/climber.hpp"
#include "coverage/gtsp/search/recombine.hpp"
#include "coverage/gtsp/search/warm_tour.hpp"
#include "coverage/gtsp/solver.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp::search {
namespace {

enum class Symmetry { kBothWaysAlike, kNone };

/// `clusters` × `size` vertices with random whole costs.
Instance random_instance(int clusters, int size, Symmetry symmetry, std::uint64_t seed) {
  Rng rng(seed);
  const int n = clusters * size;
  Instance::Clusters members(static_cast<std::size_t>(clusters));
  for (int v = 0; v < n; ++v) members[static_cast<std::size_t>(v % clusters)].push_back(v);
  std::vector<double> costs(static_cast<std::size_t>(n * n));
  for (int u = 0; u < n; ++u) {
    for (int v = 0; v < n; ++v) {
      const bool is_mirrored = symmetry == Symmetry::kBothWaysAlike && v < u;
      costs[static_cast<std::size_t>(u * n + v)] =
          is_mirrored ? costs[static_cast<std::size_t>(v * n + u)] : static_cast<double>(rng.below(1000));
    }
  }
  return Instance::from_matrix(n, std::move(members), std::move(costs)).value();
}

Problem problem_of(const Instance& instance) {
  const detail::Anchor anchor = detail::make_anchor(instance, {});
  return Problem(instance, anchor, detail::all_alive(instance, anchor));
}

std::vector<int> random_tour(const Problem& problem, Rng& rng) {
  std::vector<int> tour;
  for (int c = 0; c < problem.cluster_count(); ++c)
    tour.push_back(problem.first(c) +
                   static_cast<int>(rng.below(static_cast<std::uint64_t>(problem.cluster_size(c)))));
  for (std::size_t i = tour.size(); i > 1; --i)
    std::swap(tour[i - 1], tour[static_cast<std::size_t>(rng.below(i))]);
  return tour;
}

/// Summed over the instance, by code that the search does not use.
double cost_of(const Instance& instance, const Problem& problem, std::vector<int> tour) {
  for (int& v : tour) v = problem.original(v);
  const auto checked = check_tour(instance, tour, {});
  EXPECT_TRUE(checked.ok()) << checked.error().message;
  return checked.ok() ? checked.value() : -1.0;
}

class Search : public testing::TestWithParam<Symmetry> {};

TEST_P(Search, ClimbsToWhatItSaysAndBackAgain) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const Instance instance = random_instance(8 + static_cast<int>(rng.below(20)),
                                              1 + static_cast<int>(rng.below(4)), GetParam(), seed);
    const Problem problem = problem_of(instance);
    Candidates candidates(problem, nullptr, 6);
    const MatrixCosts costs(problem.weights().data(), problem.size());
    Climber climber(problem, candidates, costs, random_tour(problem, rng));
    const double start = static_cast<double>(climber.cost());
    climber.wake_all();
    climber.climb();
    climber.tour().forget_changes();
    EXPECT_LE(climber.cost(), start);
    for (int kick = 0; kick < 30; ++kick) {
      const std::vector<int> before = climber.tour().vertices();
      const Cost cost = climber.cost();
      const int first = static_cast<int>(rng.below(static_cast<std::uint64_t>(climber.tour().size())));
      const int last = (first + 3) % climber.tour().size();
      if (kick % 3 == 0) {
        climber.swap(first, (first + 1) % climber.tour().size(), last);
      } else if (kick % 3 == 1) {
        climber.move_away(first);
      } else if (problem.is_symmetric()) {
        climber.turn(first, last);
      }
      climber.climb();
      EXPECT_EQ(cost_of(instance, problem, climber.tour().vertices()), static_cast<double>(climber.cost()))
          << seed;
      if (kick % 2 == 0) {
        climber.take_back(cost);
        EXPECT_EQ(climber.tour().vertices(), before);
      }
      climber.tour().forget_changes();
    }
  }
}

TEST_P(Search, RecombinesToWhatItSaysAndNeverLoses) {
  int gains = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rng rng(seed);
    const Instance instance = random_instance(30, 3, GetParam(), seed);
    const Problem problem = problem_of(instance);
    const MatrixCosts costs(problem.weights().data(), problem.size());
    std::vector<int> tour = random_tour(problem, rng);
    std::vector<int> other = tour;
    for (int swaps = 0; swaps < 6; ++swaps) {
      const auto i = static_cast<std::size_t>(rng.below(28));
      std::swap(other[i], other[i + 2]);
    }
    const double before = cost_of(instance, problem, tour);
    const double before_other = cost_of(instance, problem, other);
    const Cost change = Recombiner(problem, costs).improve(tour, other);
    const double after = cost_of(instance, problem, tour);
    EXPECT_EQ(after, before + static_cast<double>(change)) << seed;
    EXPECT_LE(after, before);
    gains += after < std::min(before, before_other) ? 1 : 0;
  }
  EXPECT_GT(gains, 20);
}

TEST_P(Search, GivesTheSameAtAnyThreadCount) {
  const Instance instance = random_instance(40, 3, GetParam(), 3);
  Options options{.mode = Mode::kFast, .seed = 9};
  const Solution one = solve(instance, options);
  options.threads = 2;
  const Solution two = solve(instance, options);
  EXPECT_EQ(one.tour, two.tour);
  EXPECT_EQ(one.iterations, two.iterations);
  EXPECT_EQ(one.cost, two.cost);
}

TEST_P(Search, EndsOnceSeveralChainsAgree) {
  const Instance instance = random_instance(12, 2, GetParam(), 6);
  const Problem problem = problem_of(instance);
  ChainSetup setup;
  setup.kicks = 1'000'000;
  setup.enough_hits = 5;
  std::vector<double> costs;
  const std::uint64_t kicks =
      run_chains(problem, setup, [&](int /*chain*/, const std::vector<int>& tour, std::uint64_t /*kicks*/) {
        costs.push_back(cost_of(instance, problem, tour));
      });
  EXPECT_LT(kicks, 20'000U);
  Options options;
  options.mode = Mode::kSlow;
  const Solution proved = solve(instance, options);
  ASSERT_TRUE(proved.proved_optimal);
  EXPECT_EQ(*std::min_element(costs.begin(), costs.end()), proved.cost);
}

/// Stretches that a kick lets change places must not go back in one move of the local search: the search then
/// stays where it began, as it once did.
TEST(Chains, FindMuchTheSameFromEverySeedWhereCostsDifferEachWay) {
  Rng rng(9);
  constexpr int kClusters = 30;
  constexpr int kVertices = 3 * kClusters;
  std::vector<Point> from;
  std::vector<Point> to;
  Instance::Clusters members(kClusters);
  for (int v = 0; v < kVertices; ++v) {
    if (v % 3 == 0) from.push_back({rng.uniform() * 1e4, rng.uniform() * 1e4});
    if (v % 3 != 0) from.push_back({from[v - v % 3].x + rng.uniform() * 500, from[v - v % 3].y});
    to.push_back({from[v].x + rng.uniform() * 2000 - 1000, from[v].y + rng.uniform() * 2000 - 1000});
    members[v / 3].push_back(v);
  }
  std::vector<double> costs;
  for (const Point& end : to) {
    for (const Point& begin : from) costs.push_back(std::floor(std::hypot(begin.x - end.x, begin.y - end.y)));
  }
  const Instance instance = Instance::from_matrix(kVertices, members, costs).value();
  Options options;
  options.bound_effort = 0.0;
  double least = kNoArc;
  double most = 0.0;
  for (options.seed = 1; options.seed <= 4; ++options.seed) {
    const double cost = solve(instance, options).cost;
    least = std::min(least, cost);
    most = std::max(most, cost);
  }
  EXPECT_LE(most, 1.01 * least);
}

INSTANTIATE_TEST_SUITE_P(Both, Search, testing::Values(Symmetry::kBothWaysAlike, Symmetry::kNone));

/// A sparse instance too large for a matrix: lists of arcs say what it says, each way.
TEST(SearchProblem, ListsTheArcsOfLargeSparseInstances) {
  Rng rng(9);
  constexpr int kClusters = 1'700;
  constexpr int kVertices = 5 * kClusters;
  Instance::Clusters clusters(kClusters);
  for (int v = 0; v < kVertices; ++v) clusters[static_cast<std::size_t>(v % kClusters)].push_back(v);
  std::vector<ArcInput> arcs;
  for (int u = 0; u < kVertices; ++u) {
    for (int i = 0; i < 8; ++i) {
      const int v = (u + 1 + static_cast<int>(rng.below(50))) % kVertices;
      arcs.push_back({u, v, std::floor(rng.uniform(0.0, 1000.0))});
    }
  }
  const Instance instance = Instance::from_arcs(kVertices, clusters, arcs).value();
  const Problem problem = problem_of(instance);
  EXPECT_TRUE(problem.weights().empty());
  EXPECT_TRUE(problem.has_missing());
  EXPECT_FALSE(problem.is_symmetric());
  Candidates candidates(problem, nullptr, 6);
  problem.with_costs([&](const auto& costs) {
    for (int i = 0; i < 20'000; ++i) {
      const int u = static_cast<int>(rng.below(kVertices));
      const int v = problem.numbered((problem.original(u) + static_cast<int>(rng.below(60))) % kVertices);
      const double cost = instance.cost(problem.original(u), problem.original(v));
      EXPECT_EQ(costs(u, v), cost == kNoArc ? kMissingArc : static_cast<Cost>(cost));
    }
    for (int v = 0; v < problem.size(); v += 37) {
      for (const Near& near : candidates.out_of(v)) EXPECT_EQ(near.cost, costs(v, near.vertex));
      for (const Near& near : candidates.into(v)) EXPECT_EQ(near.cost, costs(near.vertex, v));
    }
  });
}

/// Whole costs in clusters that follow one another are not copied; in any other order they are the same.
TEST(SearchProblem, SharesTheInstancesWeightsWhereItCan) {
  Rng rng(3);
  constexpr int kVertices = 12;
  std::vector<double> costs(kVertices * kVertices);
  for (double& cost : costs) cost = std::floor(rng.uniform(0.0, 100.0));
  costs[5] = kNoArc;
  Instance::Clusters together(4);
  Instance::Clusters apart(4);
  for (int v = 0; v < kVertices; ++v) {
    together[static_cast<std::size_t>(v / 3)].push_back(v);
    apart[static_cast<std::size_t>(v % 4)].push_back(v);
  }
  for (const Instance::Clusters& clusters : {together, apart}) {
    const Instance instance = Instance::from_matrix(kVertices, clusters, costs).value();
    const Problem problem = problem_of(instance);
    EXPECT_EQ(problem.weights().data() == instance.weights().data(), clusters == together);
    EXPECT_TRUE(problem.has_missing());
    for (int u = 0; u < kVertices; ++u) {
      for (int v = 0; v < kVertices; ++v) {
        const double cost = instance.cost(problem.original(u), problem.original(v));
        if (problem.cluster_of(u) == problem.cluster_of(v)) continue;
        const std::int32_t weight = problem.weights()[static_cast<std::size_t>(u * kVertices + v)];
        EXPECT_EQ(weight == kNoWeight ? kNoArc : weight, cost);
      }
    }
  }
}

TEST(SearchProblem, ComputesLargeInstancesFromPoints) {
  Rng rng(5);
  constexpr int kClusters = 700;
  Instance::Clusters clusters(kClusters);
  std::vector<Point> points;
  for (int v = 0; v < 5 * kClusters; ++v) {
    clusters[static_cast<std::size_t>(v / 5)].push_back(v);
    points.push_back({rng.uniform(0, 1e5), rng.uniform(0, 1e5)});
  }
  const Instance instance = Instance::from_points(clusters, points, Metric::kEuc2D).value();
  const Problem problem = problem_of(instance);
  ASSERT_FALSE(problem.points().empty());
  EXPECT_TRUE(problem.weights().empty());
  const PointTree tree(problem);
  Candidates candidates(problem, &tree, 5);
  for (int v = 0; v < problem.size(); v += 97) {
    double nearest = kNoArc;
    for (int w = 0; w < problem.size(); ++w) {
      if (problem.cluster_of(w) != problem.cluster_of(v)) nearest = std::min(nearest, instance.cost(v, w));
    }
    EXPECT_EQ(static_cast<double>(candidates.out_of(v)[0].cost), nearest);
  }
  const Solution solution = solve(instance, {.mode = Mode::kFast, .stop = {.max_iterations = 500}});
  const auto checked = check_tour(instance, solution.tour, {});
  ASSERT_TRUE(checked.ok()) << checked.error().message;
  EXPECT_EQ(checked.value(), solution.cost);
}

TEST(WarmTour, KeepsWhatIsUsableAndPutsInWhatIsMissing) {
  const Instance instance = random_instance(12, 3, Symmetry::kNone, 4);
  const Problem problem = problem_of(instance);
  const WarmTour warm = usable_part(problem, {5, -1, 17, 99, 5, 29, 3});
  std::vector<int> kept;
  for (const int v : warm.tour) kept.push_back(problem.original(v));
  EXPECT_EQ(kept, (std::vector<int>{5, 3}));  // 17 and 29 are of the cluster of 5
  EXPECT_FALSE(warm.is_whole);
  EXPECT_GT(cost_of(instance, problem, completed(problem, warm.tour)), 0.0);
}

}  // namespace
}  // namespace swallowtail::gtsp::search
