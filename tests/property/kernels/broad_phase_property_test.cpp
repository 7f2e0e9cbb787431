#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <vector>

#include "planner/kernels/batch_field.hpp"
#include "planner/kernels/detail/batch_kernel.hpp"
#include "tests/support/scenes.hpp"

namespace swallowtail::planner {
namespace {

const Vec3 kLo(-400.0, -400.0, 0.0);
const Vec3 kHi(400.0, 400.0, 80.0);

std::shared_ptr<const World> crowded_world(Rng& rng) {
  constexpr std::uint32_t kCounts[] = {0, 3, 16, 17, 40, 300};
  std::vector<Obstacle> obstacles;
  const std::uint32_t count = kCounts[rng.below(6)];
  const double size_m = rng.uniform(2.0, 40.0);
  for (std::uint32_t id = 1; id <= count; ++id)
    obstacles.push_back(test::random_obstacle(rng, id, kLo, kHi, size_m));
  return *World::make(Terrain::flat(-100.0), obstacles, Bounds{});
}

Vec3 hop_from(Rng& rng, const Vec3& a) {
  const double share = rng.below(4) == 0 ? 1.0 : 0.05;
  return rng.below(10) == 0 ? a : Vec3(a + share * test::random_point(rng, kLo, kHi));
}

/// The very same bits: the trees leave out only what the plain loop leaves out, and keep its order.
TEST(BroadPhaseProperty, SumsAreThoseOfThePlainLoop) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    Rng rng(seed);
    const ObstacleField field(crowded_world(rng), VehicleLimits{});
    for (int hop = 0; hop < 20; ++hop) {
      const Vec3 a = test::random_point(rng, kLo, kHi);
      const Vec3 b = hop_from(rng, a);
      const double t0 = rng.uniform(0.0, 40.0);
      const double t1 = t0 + rng.uniform(0.0, 20.0);
      const double cap = rng.below(2) == 0 ? 0.0 : rng.uniform(0.0, 60.0);
      double sum = 0.0;
      std::vector<std::size_t> near;
      for (std::size_t i = 0; i < field.size(); ++i) {
        sum += field.violation_m(i, a, t0, b, t1);
        if (field.near(i, a, t0, b, t1, cap)) near.push_back(i);
      }
      std::vector<std::size_t> visited;
      field.for_each_near(a, t0, b, t1, cap, [&](std::size_t i) { visited.push_back(i); });
      RC_ASSERT(field.violation_m(a, t0, b, t1) == sum);
      RC_ASSERT(visited == near);
    }
  }));
}

TEST(BroadPhaseProperty, BatchesAreThoseOfThePlainLoop) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    Rng rng(seed);
    const ObstacleField field(crowded_world(rng), VehicleLimits{});
    const BatchField batch(field);
    const std::vector<detail::BallNode> one_leaf = {
        {.count = static_cast<std::uint32_t>(field.standing()), .next = 1, .is_leaf = true}};
    const detail::SolidList plain{field.solids().data(), one_leaf, field.supports().data()};
    for (int trial = 0; trial < 5; ++trial) {
      LanePoint a, b;
      for (int lane = 0; lane < kLanes; ++lane) {
        const Vec3 from = test::random_point(rng, kLo, kHi);
        const Vec3 to = hop_from(rng, from);
        a.x[lane] = from.x(), a.y[lane] = from.y(), a.z[lane] = from.z();
        b.x[lane] = to.x(), b.y[lane] = to.y(), b.z[lane] = to.z();
      }
      Lanes with_tree = Lanes::Zero();
      Lanes without = Lanes::Zero();
      batch.add_violation(a, b, with_tree);
      detail::batch_kernels().back().add_violation(plain, a, b, without);
      RC_ASSERT((with_tree == without).all());
      std::vector<LaneDistance> buffer;
      std::vector<LaneDistance> expected(field.standing());
      const double cap = rng.uniform(0.0, 60.0);
      const auto found = batch.distances(a, b, cap, buffer);
      const std::size_t count = detail::batch_kernels().back().distances(plain, a, b, cap, expected.data());
      RC_ASSERT(found.size() == count);
      for (std::size_t i = 0; i < count; ++i) {
        RC_ASSERT(found[i].obstacle == expected[i].obstacle);
        RC_ASSERT((found[i].signed_distance_m == expected[i].signed_distance_m).all());
      }
    }
  }));
}

}  // namespace
}  // namespace swallowtail::planner
