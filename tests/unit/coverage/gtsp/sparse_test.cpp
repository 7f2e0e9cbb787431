#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "coverage/gtsp/check_tour.hpp"
#include "coverage/gtsp/solver.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp {
namespace {

using testing::HasSubstr;

/// Clusters of `size` vertices on a grid of `side`²; arcs only to the `reach` next in row and column, each
/// with probability `density`, and along one hidden tour (boustrophedon) so that there is a path.
Instance grid(int side, int size, double density, int reach, std::uint64_t seed) {
  Rng rng(seed);
  Instance::Clusters clusters;
  for (int c = 0; c < side * side; ++c) {
    clusters.emplace_back();
    for (int i = 0; i < size; ++i) clusters.back().push_back(c * size + i);
  }
  std::vector<ArcInput> arcs;
  const auto join = [&](int a, int b, double probability) {
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) {
        if (rng.uniform() < probability) arcs.push_back({a * size + i, b * size + j, rng.uniform(1.0, 10.0)});
      }
    }
  };
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const int here = row * side + column;
      for (int far = 1; far <= reach; ++far) {
        if (column + far < side) join(here, here + far, density);
        if (column + far < side) join(here + far, here, density);
        if (row + far < side) join(here, here + far * side, density);
        if (row + far < side) join(here + far * side, here, density);
      }
    }
  }
  int previous = -1;
  for (int row = 0; row < side; ++row) {
    for (int i = 0; i < side; ++i) {
      const int here = row * side + (row % 2 == 0 ? i : side - 1 - i);
      const int vertex = here * size + static_cast<int>(rng.below(static_cast<std::uint64_t>(size)));
      if (previous >= 0) arcs.push_back({previous, vertex, 10.0});
      previous = vertex;
    }
  }
  return Instance::from_arcs(side * side * size, std::move(clusters), arcs).value();
}

TEST(Sparse, FindsOpenToursOverFewArcs) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Instance instance = grid(7, 6, 0.3, 2, seed);
    const Solution solution =
        solve(instance,
              {.mode = Mode::kFast, .seed = seed, .stop = {.max_iterations = 8000}, .kind = TourKind::kOpen});
    const auto checked = check_tour(instance, solution.tour, {.returns_to_start = false});
    ASSERT_TRUE(checked.ok()) << seed << ' ' << name_of(solution.status) << ' ' << checked.error().message;
    EXPECT_NEAR(checked.value(), solution.cost, 1e-9);
    EXPECT_LE(solution.lower_bound, solution.cost);
  }
}

/// Points in the plane, `count` clusters of 5 that lie among each other.
std::vector<Point> points_of_clusters(int count, Rng& rng) {
  std::vector<Point> points;
  for (int c = 0; c < count; ++c) {
    const Point centre{rng.uniform(0.0, 1e4), rng.uniform(0.0, 1e4)};
    for (int i = 0; i < 5; ++i)
      points.push_back({centre.x + rng.uniform(-1e3, 1e3), centre.y + rng.uniform(-1e3, 1e3)});
  }
  return points;
}

/// Of the complete instance only the arcs to the `most` nearest vertices of other clusters, both ways.
Instance nearest_arcs(const Instance& complete, std::size_t most) {
  Instance::Clusters clusters;
  for (int c = 0; c < complete.cluster_count(); ++c)
    clusters.emplace_back(complete.cluster(c).begin(), complete.cluster(c).end());
  std::vector<ArcInput> arcs;
  for (int u = 0; u < complete.vertex_count(); ++u) {
    std::vector<Arc> near;
    for (const Arc arc : complete.arcs_from(u)) {
      if (complete.cluster_of(arc.to) != complete.cluster_of(u)) near.push_back(arc);
    }
    std::sort(near.begin(), near.end(), [](const Arc& a, const Arc& b) { return a.cost < b.cost; });
    near.resize(std::min(most, near.size()));
    for (const Arc& arc : near) {
      arcs.push_back({u, arc.to, arc.cost});
      arcs.push_back({arc.to, u, arc.cost});
    }
  }
  return Instance::from_arcs(complete.vertex_count(), std::move(clusters), arcs).value();
}

/// A tour over a few arcs a vertex costs little more than one over all, and never less than its bound.
TEST(Sparse, ComesCloseToTheCompleteInstancesTours) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Rng rng(seed);
    const std::vector<Point> points = points_of_clusters(60, rng);
    Instance::Clusters clusters(60);
    for (int v = 0; v < 300; ++v) clusters[static_cast<std::size_t>(v / 5)].push_back(v);
    const Instance complete = Instance::from_points(clusters, points, Metric::kEuc2D).value();
    const double best = solve(complete, {.mode = Mode::kFast}).cost;
    const Instance sparse = nearest_arcs(complete, 20);
    const Solution solution = solve(sparse, {.mode = Mode::kFast, .seed = seed});
    const auto checked = check_tour(sparse, solution.tour, {});
    ASSERT_TRUE(checked.ok()) << seed << ' ' << checked.error().message;
    EXPECT_LE(solution.cost, 1.05 * best) << seed;
    EXPECT_LE(solution.lower_bound, solution.cost);
  }
}

TEST(Sparse, SolvesCoverageSizeWithinTheBudget) {
  const Instance instance = grid(8, 20, 0.3, 3, 4);
  const Solution cold = solve(
      instance,
      {.mode = Mode::kFast, .stop = {.max_iterations = 3000}, .kind = TourKind::kOpen, .start_vertex = 0});
  ASSERT_TRUE(check_tour(instance, cold.tour, {.returns_to_start = false, .start = 0}).ok()) << cold.reason;
  const Solution warm = solve(instance, {.mode = Mode::kFast,
                                         .stop = {.max_iterations = 500},
                                         .kind = TourKind::kOpen,
                                         .warm_tour = cold.tour,
                                         .start_vertex = 0});
  EXPECT_LE(warm.cost, cold.cost);
}

/// Two halves that no arc joins, or joins one way only.
Instance halves(bool one_way) {
  std::vector<ArcInput> arcs;
  for (int half = 0; half < 2; ++half) {
    for (int i = 0; i < 10; ++i) {
      for (int j = 0; j < 10; ++j) {
        if (i != j) arcs.push_back({10 * half + i, 10 * half + j, 1.0});
      }
    }
  }
  if (one_way) arcs.push_back({3, 14, 1.0});
  Instance::Clusters clusters;
  for (int v = 0; v < 20; ++v) clusters.push_back({v});
  return Instance::from_arcs(20, std::move(clusters), arcs).value();
}

/// 8,820 vertices: beyond what is searched as a matrix.
TEST(Sparse, FindsToursOfLargeInstances) {
  const Instance instance = grid(42, 5, 0.4, 2, 1);
  const Solution solution =
      solve(instance, {.mode = Mode::kFast, .stop = {.max_iterations = 15'000}, .kind = TourKind::kOpen});
  const auto checked = check_tour(instance, solution.tour, {.returns_to_start = false});
  ASSERT_TRUE(checked.ok()) << name_of(solution.status) << ' ' << checked.error().message;
  EXPECT_NEAR(checked.value(), solution.cost, 1e-6);
  EXPECT_LE(solution.lower_bound, solution.cost);
}

TEST(Sparse, NamesTheClusterThatMakesATourImpossible) {
  const Solution apart = solve(halves(false), {.mode = Mode::kFast});
  EXPECT_EQ(apart.status, SolveStatus::kInfeasible);
  EXPECT_THAT(apart.reason, HasSubstr("Cluster "));
  EXPECT_TRUE(apart.tour.empty());
  EXPECT_EQ(solve(halves(true), {.mode = Mode::kFast}).status, SolveStatus::kInfeasible);
  const Solution across = solve(halves(true), {.mode = Mode::kFast, .kind = TourKind::kOpen});
  EXPECT_TRUE(check_tour(halves(true), across.tour, {.returns_to_start = false}).ok()) << across.reason;
  const Solution backwards =
      solve(halves(true), {.mode = Mode::kFast, .kind = TourKind::kOpen, .start_vertex = 15});
  EXPECT_EQ(backwards.status, SolveStatus::kInfeasible);
}

TEST(Sparse, NamesTheClusterThatAllWaysLeadThrough) {
  // Two rings of ten that share cluster 7: each vertex has its arcs, and all are in reach of each other.
  std::vector<ArcInput> arcs;
  const auto join_ring = [&](const std::vector<int>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      arcs.push_back({ring[i], ring[(i + 1) % ring.size()], 1.0});
      arcs.push_back({ring[(i + 1) % ring.size()], ring[i], 1.0});
      arcs.push_back({ring[i], ring[(i + 2) % ring.size()], 1.0});
    }
  };
  Instance::Clusters clusters;
  for (int v = 0; v < 31; ++v) clusters.push_back({v});
  std::vector<int> one{7};
  std::vector<int> other{7};
  for (int v = 0; v < 31; ++v) {
    if (v != 7) (v < 16 ? one : other).push_back(v);
  }
  join_ring(one);
  join_ring(other);
  const Solution solution = solve(Instance::from_arcs(31, clusters, arcs).value(), {.mode = Mode::kFast});
  EXPECT_EQ(solution.status, SolveStatus::kInfeasible);
  EXPECT_THAT(solution.reason, HasSubstr("Without cluster 7 "));
}

TEST(Sparse, DropsVerticesThatOneClusterAloneLeadsToAndFrom) {
  // Cluster 2 can only be come to from cluster 0 and left to it.
  const std::vector<ArcInput> arcs{{0, 1, 1}, {1, 0, 1}, {0, 2, 1}, {2, 0, 1}, {0, 3, 1},
                                   {3, 1, 1}, {1, 3, 1}, {3, 0, 1}, {4, 2, 1}, {2, 4, 1}};
  const Instance instance = Instance::from_arcs(5, {{0, 4}, {1}, {2}, {3}}, arcs).value();
  const Solution solution = solve(instance, {.mode = Mode::kFast});
  EXPECT_EQ(solution.status, SolveStatus::kInfeasible);
  EXPECT_THAT(solution.reason, HasSubstr("Cluster 2 has no vertex"));
}

TEST(Sparse, NamesAClusterAmongThoseThatStarveForSuccessors) {
  std::vector<ArcInput> arcs;
  for (int leaf = 2; leaf < 20; ++leaf) {
    for (const int hub : {0, 1}) {
      arcs.push_back({hub, leaf, 1.0});
      arcs.push_back({leaf, hub, 1.0});
    }
  }
  Instance::Clusters clusters;
  for (int v = 0; v < 20; ++v) clusters.push_back({v});
  const Instance hubs = Instance::from_arcs(20, std::move(clusters), arcs).value();
  const Solution solution = solve(hubs, {.mode = Mode::kFast});
  EXPECT_EQ(solution.status, SolveStatus::kInfeasible);
  EXPECT_THAT(solution.reason, HasSubstr("cluster "));
}

TEST(Sparse, OwnsUpWhenItFindsNothing) {
  // Three copies of Petersen's graph: each vertex has three neighbours and an assignment exists, but no
  // Hamiltonian cycle does, nor a path between the neighbours 0 and 1, at which the copies are joined.
  std::vector<ArcInput> arcs;
  const auto join = [&](int a, int b) {
    arcs.push_back({a, b, 1.0});
    arcs.push_back({b, a, 1.0});
  };
  for (int copy = 0; copy < 3; ++copy) {
    const int base = 10 * copy;
    for (int i = 0; i < 5; ++i) {
      join(base + i, base + (i + 1) % 5);
      join(base + i, base + 5 + i);
      join(base + 5 + i, base + 5 + (i + 2) % 5);
    }
    join(base, (base + 10) % 30);
    join(base + 1, (base + 11) % 30);
  }
  Instance::Clusters clusters;
  for (int v = 0; v < 30; ++v) clusters.push_back({v});
  const Instance instance = Instance::from_arcs(30, std::move(clusters), arcs).value();
  const Solution solution = solve(instance, {.mode = Mode::kFast});
  EXPECT_EQ(solution.status, SolveStatus::kNoneFound);
  EXPECT_TRUE(solution.tour.empty());
  EXPECT_EQ(solution.cost, kNoArc);
}

}  // namespace
}  // namespace swallowtail::gtsp
