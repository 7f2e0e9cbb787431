#include "tools/sim/safety.hpp"

#include <gtest/gtest.h>

namespace swallowtail::sim {
namespace {

std::shared_ptr<const planner::World> world_with(std::vector<planner::Obstacle> obstacles) {
  return planner::World::make(planner::Terrain::flat(0.0), std::move(obstacles), {}).value();
}

planner::Obstacle ball(const Vec3& at_m, double radius_m, double margin_m = 0.0) {
  planner::Obstacle obstacle;
  obstacle.id = 7;
  obstacle.shape = planner::Sphere{radius_m};
  obstacle.position_m = at_m;
  obstacle.margin_m = margin_m;
  return obstacle;
}

Motion flying(double time_s, const Vec3& at_m, data::VehicleMode mode = data::VehicleMode::kTransfer) {
  Motion motion;
  motion.time_s = time_s;
  motion.position_m = at_m;
  motion.mode = mode;
  return motion;
}

/// Flies straight along x at 20 m height and 10 m/s past y = 0.
void fly_by(Safety& safety, double from_m, double to_m) {
  for (double x = from_m; x < to_m - 1e-9; x += 0.5) {
    safety.observe(flying(x / 10, Vec3(x, 0, 20)), flying((x + 0.5) / 10, Vec3(x + 0.5, 0, 20)));
  }
}

const planner::VehicleLimits kLimits{.radius_m = 0.5, .margin_m = 2.0};

TEST(Safety, CountsAnEpisodeOnce) {
  Safety safety(kLimits, world_with({
                             ball(Vec3(20, 6, 20), 4.0),
                         }));
  fly_by(safety, 0, 40);
  EXPECT_EQ(safety.violations(), 1U) << "2 m off, 2.5 m asked";
  EXPECT_EQ(safety.collisions(), 0U);
  EXPECT_NEAR(safety.least_clearance_m(), 2.0, 1e-3);
  EXPECT_NE(safety.first_violation().find("obstacle 7"), std::string::npos);
}

TEST(Safety, CountsNothingAtTheLimit) {
  Safety safety(kLimits, world_with({ball(Vec3(20, 6.5, 20), 4.0)}));
  fly_by(safety, 0, 40);
  EXPECT_EQ(safety.violations(), 0U);
  EXPECT_TRUE(safety.first_violation().empty());
}

TEST(Safety, AddsTheObstaclesOwnMargin) {
  Safety safety(kLimits, world_with({ball(Vec3(20, 7.4, 20), 4.0, 1.0)}));
  fly_by(safety, 0, 40);
  EXPECT_EQ(safety.violations(), 1U);
}

TEST(Safety, TellsCollisions) {
  Safety safety(kLimits, world_with({ball(Vec3(20, 4.3, 20), 4.0)}));
  fly_by(safety, 0, 40);
  EXPECT_EQ(safety.collisions(), 1U);
  EXPECT_EQ(safety.violations(), 1U);
}

TEST(Safety, MissesNothingBetweenTwoSteps) {
  Safety safety(kLimits, world_with({ball(Vec3(20, 0, 20), 1.0)}));
  safety.observe(flying(0, Vec3(0, 0, 20)), flying(4, Vec3(40, 0, 20)));
  EXPECT_EQ(safety.collisions(), 1U);
}

TEST(Safety, FollowsAChangedWorld) {
  Safety safety(kLimits, world_with({}));
  fly_by(safety, 0, 10);
  EXPECT_EQ(safety.violations(), 0U);
  safety.change_world(world_with({ball(Vec3(20, 3, 20), 2.0)}));
  fly_by(safety, 10, 40);
  EXPECT_EQ(safety.violations(), 1U);
}

TEST(Safety, WatchesTheGroundExceptInTakeOffAndLanding) {
  Safety safety(kLimits, world_with({}));
  using data::VehicleMode;
  safety.observe(flying(0, Vec3(0, 0, 1), VehicleMode::kTakingOff),
                 flying(1, Vec3(0, 0, 2), VehicleMode::kTakingOff));
  safety.observe(flying(1, Vec3(0, 0, 2), VehicleMode::kLanding),
                 flying(2, Vec3(0, 0, 0), VehicleMode::kLanded));
  EXPECT_EQ(safety.violations(), 0U);
  safety.observe(flying(2, Vec3(0, 0, 2.4)), flying(3, Vec3(5, 0, 2.4)));
  EXPECT_EQ(safety.violations(), 1U);
  EXPECT_EQ(safety.collisions(), 0U);
  safety.observe(flying(3, Vec3(5, 0, 2.4)), flying(4, Vec3(9, 0, -1)));
  EXPECT_EQ(safety.collisions(), 1U);
  EXPECT_NE(safety.first_violation().find("ground"), std::string::npos);
}

TEST(Safety, CountsNothingOnTheGround) {
  Safety safety(kLimits, world_with({ball(Vec3(0, 0, 0), 5.0)}));
  safety.observe(flying(0, Vec3(0, 0, 0), data::VehicleMode::kLanded),
                 flying(1, Vec3(0, 0, 0), data::VehicleMode::kDocked));
  EXPECT_EQ(safety.violations(), 0U);
  EXPECT_EQ(safety.clearance_m(), 0.0);
}

}  // namespace
}  // namespace swallowtail::sim
