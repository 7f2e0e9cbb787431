#include <gtest/gtest.h>

#include <cmath>

#include "coverage/gtsp/proof/ascent.hpp"
#include "coverage/gtsp/solver.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp::proof {
namespace {

struct Family {
  int clusters = 10;
  int size = 4;
  double spread = 1.0;   ///< of a cluster, of the square's side
  double skew = 0.0;     ///< how much dearer arcs to the right are
  double density = 1.0;  ///< share of the arcs
};

Instance random_instance(const Family& family, Rng& rng) {
  Instance::Clusters clusters;
  std::vector<Point> points;
  for (int c = 0; c < family.clusters; ++c) {
    clusters.emplace_back();
    const Point middle{rng.uniform(0.0, 1000.0), rng.uniform(0.0, 1000.0)};
    for (int i = 0; i < family.size; ++i) {
      clusters.back().push_back(static_cast<int>(points.size()));
      points.push_back({middle.x + 1000.0 * family.spread * rng.uniform(),
                        middle.y + 1000.0 * family.spread * rng.uniform()});
    }
  }
  std::vector<double> costs;
  for (const Point& a : points) {
    for (const Point& b : points) {
      const double cost =
          std::floor(std::hypot(a.x - b.x, a.y - b.y) * (b.x > a.x ? 1.0 + family.skew : 1.0));
      costs.push_back(rng.uniform() < family.density ? cost : kNoArc);
    }
  }
  const auto n = static_cast<int>(points.size());
  return Instance::from_matrix(n, std::move(clusters), std::move(costs)).value();
}

class Ascent : public testing::TestWithParam<Family> {};

/// The optimum is from dynamic programming over subsets, which knows no walks.
TEST_P(Ascent, NeverClimbsAboveTheOptimum) {
  Rng rng(5);
  double sum_of_bounds = 0.0;
  double sum_of_optima = 0.0;
  for (int i = 0; i < 12; ++i) {
    const Instance instance = random_instance(GetParam(), rng);
    const Solution best = solve(instance, {});
    if (best.status == SolveStatus::kInfeasible) continue;
    ASSERT_EQ(best.status, SolveStatus::kOptimal);
    const detail::Anchor anchor = detail::make_anchor(instance, {});
    const detail::Pruning pruning = detail::prune(instance, anchor);
    for (const double excess : {1.0, 0.3 * best.cost, kNoArc}) {
      WalkGraph graph(instance, anchor, pruning);
      WalkAscent ascent(graph, best.cost + excess);
      for (int climb = 0; climb < 6; ++climb) {
        const WalkAscent::End end = ascent.climb(3e5, {});
        ASSERT_NE(end, WalkAscent::End::kNoWalk) << "instance " << i;
        ASSERT_LE(ascent.bound(), best.cost * (1.0 + 1e-9)) << "instance " << i << ", climb " << climb;
        if (end != WalkAscent::End::kWork) break;
      }
      sum_of_bounds += ascent.bound();
      sum_of_optima += best.cost;
    }
  }
  EXPECT_GT(sum_of_bounds, 0.6 * sum_of_optima);
}

INSTANTIATE_TEST_SUITE_P(Families, Ascent,
                         testing::Values(Family{}, Family{.clusters = 12, .spread = 0.2},
                                         Family{.clusters = 7, .size = 6, .skew = 0.5},
                                         Family{.clusters = 12, .spread = 0.4, .skew = 1.0},
                                         Family{.clusters = 10, .density = 0.25},
                                         Family{.clusters = 14, .size = 3, .spread = 0.1, .density = 0.5}));

}  // namespace
}  // namespace swallowtail::gtsp::proof
