#include "planner/kernels/obstacle_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/world/clearance.hpp"
#include "tests/unit/planner/replan/random_worlds.hpp"

namespace swallowtail::planner {
namespace {

std::shared_ptr<const World> world_of(std::vector<Obstacle> obstacles,
                                      Terrain terrain = Terrain::flat(-1000.0)) {
  return *World::make(std::move(terrain), std::move(obstacles), Bounds{});
}

/// Agrees with FCL (which knows no depth) wherever the flight is outside, for each shape, moving or not.
TEST(ObstacleField, AgreesWithTheClearanceQuery) {
  random_worlds::SceneOptions options;
  Rng rng(17);
  for (int trial = 0; trial < 3000; ++trial) {
    Obstacle obstacle = random_worlds::random_obstacle(rng, 1, options, trial % 3 == 0);
    const auto world = world_of({obstacle});
    const ObstacleField field(world, VehicleLimits{});
    const ClearanceQuery query(world);
    const Vec3 near = obstacle.position_at(50.0);
    const Vec3 a = near + Vec3(rng.uniform(-30, 30), rng.uniform(-30, 30), rng.uniform(-10, 60));
    const Vec3 b = near + Vec3(rng.uniform(-30, 30), rng.uniform(-30, 30), rng.uniform(-10, 60));
    const double duration = rng.uniform(0.5, 5.0);
    const double mine = field.approach(0, a, 50.0, b, 50.0 + duration).signed_distance_m;
    const double fcl = query.of_flight(a, 50.0, b, 50.0 + duration, 500.0).distance_m;
    if (fcl > 0.0) {
      ASSERT_NEAR(mine, fcl, 2e-3) << "trial " << trial;
    } else {
      ASSERT_LE(mine, 1e-6) << "trial " << trial;
    }
  }
}

TEST(ObstacleField, NeverOverstatesTheDistanceToAMesh) {
  Rng rng(23);
  for (int trial = 0; trial < 500; ++trial) {
    ConvexMesh mesh;
    for (int i = 0; i < 12; ++i)
      mesh.vertices_m.push_back(Vec3(rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(0, 10)));
    mesh.yaw_rad = rng.uniform(0, 3);
    const Obstacle obstacle{.id = 1, .shape = mesh};
    const auto world = world_of({obstacle});
    const ObstacleField field(world, VehicleLimits{});
    const Vec3 a(rng.uniform(-20, 20), rng.uniform(-20, 20), rng.uniform(-5, 20));
    const Vec3 b(rng.uniform(-20, 20), rng.uniform(-20, 20), rng.uniform(-5, 20));
    const double fcl = ClearanceQuery(world).of_flight(a, 0, b, 1, 500.0).distance_m;
    ASSERT_LE(field.approach(0, a, 0, b, 1).signed_distance_m, fcl + 1e-3) << "trial " << trial;
  }
}

/// Far taller than wide, and aslant: what no fixed directions bound well.
TEST(ObstacleField, BoundsUprightPrismsByTheirOwnFaces) {
  Rng rng(29);
  for (int trial = 0; trial < 2000; ++trial) {
    const int corners = 3 + static_cast<int>(rng.below(8));
    const double length_m = std::pow(10.0, rng.uniform(0.0, 2.0));
    const double turn = rng.uniform(0.0, 2.0 * std::numbers::pi);
    const double top_m = std::pow(10.0, rng.uniform(0.5, 3.0));
    ConvexMesh mesh;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.8 * rng.uniform()) / corners;
      const Vec2 p(length_m * std::cos(angle), 4.0 * std::sin(angle));
      for (const double z : {-10.0, top_m})
        mesh.vertices_m.emplace_back(std::cos(turn) * p.x() - std::sin(turn) * p.y(),
                                     std::sin(turn) * p.x() + std::cos(turn) * p.y(), z);
    }
    const Obstacle obstacle{.id = 1, .shape = mesh};
    if (!validate(obstacle)) continue;
    const auto world = world_of({obstacle});
    const ObstacleField field(world, VehicleLimits{});
    const double reach_m = length_m + 20.0;
    Vec3 a(rng.uniform(-reach_m, reach_m), rng.uniform(-reach_m, reach_m), rng.uniform(-20, top_m + 20));
    Vec3 b(rng.uniform(-reach_m, reach_m), rng.uniform(-reach_m, reach_m), rng.uniform(-20, top_m + 20));
    const bool level = rng.uniform() < 0.5;
    if (level) a.z() = b.z() = rng.uniform(-9.0, top_m);
    const double exact = ClearanceQuery(world).of_flight(a, 0, b, 1, 5000.0).distance_m;
    const double bound = field.approach(0, a, 0, b, 1).signed_distance_m;
    ASSERT_LE(bound, exact + 1e-3) << "trial " << trial;
    const double least = level ? std::cos(std::numbers::pi / 12.0) : 0.7;
    if (exact == 0.0) continue;
    ASSERT_GE(bound, least * exact - 1e-3) << "trial " << trial << (level ? ", level" : "");
  }
}

TEST(ObstacleField, TellsTheDepthOfAHeadOnHit) {
  Obstacle ball{.id = 4, .shape = Sphere{5.0}};
  const ObstacleField field(world_of({ball}), VehicleLimits{.radius_m = 0.5, .margin_m = 1.5});
  EXPECT_NEAR(field.violation_m(Vec3(-20, 0, 0), 0, Vec3(20, 0, 0), 5), 7.0, 1e-2);
  EXPECT_NEAR(field.violation_m(Vec3(-20, 6, 0), 0, Vec3(20, 6, 0), 5), 1.0, 1e-2);
  EXPECT_EQ(field.violation_m(Vec3(-20, 7.1, 0), 0, Vec3(20, 7.1, 0), 5), 0.0);
}

TEST(ObstacleField, ForgetsWhatIsNoLongerThere) {
  Obstacle ball{.id = 4, .shape = Sphere{5.0}};
  ball.valid_until_s = 10.0;
  const ObstacleField field(world_of({ball}), VehicleLimits{});
  EXPECT_GT(field.violation_m(Vec3(-20, 0, 0), 7, Vec3(20, 0, 0), 12), 0.0) << "met at 9.5 s";
  EXPECT_EQ(field.violation_m(Vec3(-20, 0, 0), 9, Vec3(20, 0, 0), 14), 0.0) << "gone when it gets there";
  EXPECT_EQ(field.violation_m(Vec3(-20, 0, 0), 11, Vec3(20, 0, 0), 16), 0.0);
}

TEST(ObstacleField, KeepsOffTheGround) {
  const ObstacleField field(world_of({}, Terrain::flat(10.0)),
                            VehicleLimits{.radius_m = 0.5, .margin_m = 1.5});
  EXPECT_NEAR(field.terrain_violation_m(Vec3(0, 0, 20), Vec3(9, 0, 11)), 1.0, 1e-3);
  EXPECT_EQ(field.terrain_violation_m(Vec3(0, 0, 20), Vec3(9, 0, 12.1)), 0.0);
}

}  // namespace
}  // namespace swallowtail::planner
