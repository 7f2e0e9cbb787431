#include "planner/replan/taut_string.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/base/rng.hpp"
#include "planner/replan/ground_probe.hpp"
#include "planner/replan/sidestep.hpp"
#include "tests/unit/planner/replan/quality_scenes.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kAnyLength = std::numeric_limits<double>::infinity();

struct OneBall {
  explicit OneBall(double scale = 1.0, double climb_max_rad = 0.5 * std::numbers::pi)
      : world(*World::make(Terrain::flat(-100.0 * scale),
                           {{.id = 1, .shape = Sphere{3.0 * scale}, .position_m = scale * Vec3(10, 0.5, 0)}},
                           {Vec3::Constant(-90.0 * scale), Vec3::Constant(90.0 * scale)})),
        limits(quality_scenes::point_vehicle(climb_max_rad)) {
    limits.radius_m = 0.5 * scale;
  }
  std::shared_ptr<const World> world;
  VehicleLimits limits;
};

/// The way round a ball from one point to another as far from its centre: two tangents and an arc.
double length_round(double away, double radius, double angle_between) {
  const double arc = angle_between - 2.0 * std::acos(radius / away);
  return 2.0 * std::sqrt(away * away - radius * radius) + radius * arc;
}

TEST(TautString, FindsTangentsAndArcOfABall) {
  const OneBall scene;
  const ObstacleField field(scene.world, scene.limits);
  NearbySolids nearby(field);
  TautString taut(field, nearby, scene.limits, 20.0);
  std::vector<Vec3> chain{Vec3(0, 0, 0), Vec3(10, -7, 2), Vec3(20, 0, 0)};
  TautResult result;
  for (int k = 0; k < 4; ++k) {
    result = taut.tighten(chain, 0.0, 1000, kAnyLength);
    taut.refine(chain, 1e-5, 64);
  }
  const double away = std::hypot(10, 0.5);
  const double exact = length_round(away, 3.5, std::numbers::pi - 2.0 * std::atan2(0.5, 10.0));
  EXPECT_GT(result.length_m, exact);
  EXPECT_LT(result.length_m, exact * 1.001);
  EXPECT_LT(result.violation_m, 1e-3);
}

TEST(TautString, ScalesExactlyWithAPowerOfTwo) {
  std::vector<std::vector<Vec3>> chains;
  for (const double scale : {1.0, 8.0}) {
    const OneBall scene(scale);
    const ObstacleField field(scene.world, scene.limits);
    NearbySolids nearby(field);
    TautString taut(field, nearby, scene.limits, 20.0 * scale);
    std::vector<Vec3> chain{Vec3(0, 0, 0), scale * Vec3(9, -7, 2), scale * Vec3(20, 1, 0)};
    taut.tighten(chain, 0.0, 1000, kAnyLength);
    chains.push_back(chain);
  }
  for (std::size_t i = 0; i < chains[0].size(); ++i) EXPECT_EQ(8.0 * chains[0][i], chains[1][i]);
}

TEST(TautString, GivesUpWhatComesOutTooLong) {
  const OneBall scene;
  const ObstacleField field(scene.world, scene.limits);
  NearbySolids nearby(field);
  TautString taut(field, nearby, scene.limits, 20.0);
  std::vector<Vec3> chain{Vec3(0, 0, 0), Vec3(10, -7, 2), Vec3(20, 0, 0)};
  EXPECT_TRUE(taut.tighten(chain, 0.0, 1000, 20.1).given_up);
}

TEST(FlownLength, IsStraightWithinTheLimitAndBentBeyond) {
  EXPECT_DOUBLE_EQ(flown_length_m(Vec3(3, 0, 3), 1.0), std::sqrt(18.0));
  EXPECT_DOUBLE_EQ(flown_length_m(Vec3(3, 0, 7), 1.0), 4.0 + std::sqrt(18.0));
  EXPECT_DOUBLE_EQ(flown_length_m(Vec3(0, 0, -7), 1.0), 7.0);
}

TEST(LowestOver, AgreesWithTheTerrainAndWithDenseLooks) {
  Rng rng(5);
  for (int trial = 0; trial < 200; ++trial) {
    const auto scene = quality_scenes::hills_and_balls(static_cast<std::uint64_t>(1 + trial % 7), 1.0);
    const Terrain& terrain = scene.world->terrain();
    const Vec3 a(rng.uniform(-5, 45), rng.uniform(-5, 45), rng.uniform(0, 30));
    const Vec3 b(rng.uniform(-5, 45), trial % 5 == 0 ? a.y() : rng.uniform(-5, 45), rng.uniform(0, 30));
    const GroundContact low = lowest_over(terrain, a, b, 0.0, 1.0);
    EXPECT_NEAR(low.height_m, terrain.min_height_above(a, b), 1e-9);
    const Vec3 p = a + low.fraction * (b - a);
    EXPECT_NEAR(p.z() - terrain.height_at(p.x(), p.y()), low.height_m, 1e-6);
  }
}

TEST(Sidestep, FindsAClearChainInEveryScene) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto scene = seed % 2 == 0 ? quality_scenes::spheres(seed, 10, 0.5 * std::numbers::pi)
                                     : quality_scenes::hills_and_balls(seed, 0.5 * std::numbers::pi);
    const ObstacleField field(scene.world, scene.request.limits);
    NearbySolids nearby(field);
    Sidestep sidestep(field, nearby, scene.request.limits);
    Rng rng(seed);
    std::vector<Vec3> chain;
    sidestep.find(scene.request.start_m, scene.request.goal_m, 0.0, 0.0, rng, 4000, chain);
    ASSERT_GE(chain.size(), 2u) << "seed " << seed;
    EXPECT_EQ(chain.front(), scene.request.start_m);
    EXPECT_EQ(chain.back(), scene.request.goal_m);
    for (std::size_t i = 1; i < chain.size(); ++i) {
      EXPECT_EQ(field.violation_m(chain[i - 1], 0.0, chain[i], 0.0), 0.0) << "seed " << seed;
      EXPECT_GT(scene.world->terrain().min_height_above(chain[i - 1], chain[i]), 0.0) << "seed " << seed;
    }
  }
}

TEST(NearbySolids, LeavesOutNothingThatIsNear) {
  const auto scene = quality_scenes::city(3, 500, 600.0);
  const ObstacleField field(scene.world, scene.request.limits);
  NearbySolids nearby(field);
  Rng rng(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 a(rng.uniform(-50, 650), rng.uniform(-50, 650), rng.uniform(0, 100));
    const Vec3 b = a + Vec3(rng.uniform(-200, 200), rng.uniform(-200, 200), rng.uniform(-50, 50));
    const double cap = rng.uniform(0, 20);
    const auto found = nearby.along(a, b, cap);
    for (std::uint32_t i = 0; i < field.size(); ++i) {
      if (field.near(i, a, 0.0, b, 0.0, cap)) {
        EXPECT_TRUE(std::ranges::binary_search(found, i));
      }
    }
  }
}

}  // namespace
}  // namespace swallowtail::planner
