#include "planner/replan/point_to_point.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "tests/unit/planner/replan/random_worlds.hpp"

namespace swallowtail::planner {
namespace {

Obstacle ball(std::uint32_t id, const Vec3& at, double radius) {
  return {.id = id, .shape = Sphere{radius}, .position_m = at};
}

std::shared_ptr<const World> world_of(std::vector<Obstacle> obstacles) {
  return *World::make(Terrain::flat(0.0), std::move(obstacles), Bounds{Vec3(0, 0, 0), Vec3(200, 200, 100)});
}

PlanRequest across() {
  PlanRequest request;
  request.start_m = Vec3(10, 100, 30);
  request.goal_m = Vec3(190, 100, 30);
  return request;
}

TEST(PlanPath, FliesStraightWhereItIsClear) {
  Result<PlanReport> report = plan_path(world_of({}), across(), {});
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->status, PlanStatus::kCertified);
  EXPECT_NEAR(report->length_m, 180.0, 1e-9);
  EXPECT_EQ(report->evaluations, 1u);
}

TEST(PlanPath, GoesRound) {
  const auto world = world_of({ball(1, Vec3(60, 100, 30), 20), ball(2, Vec3(120, 90, 30), 20)});
  Result<PlanReport> report = plan_path(world, across(), {.max_evaluations = 5000});
  ASSERT_EQ(report->status, PlanStatus::kCertified);
  EXPECT_GT(report->length_m, 180.0);
  EXPECT_LT(report->length_m, 195.0);
  EXPECT_TRUE(report->certificate.certified);
  EXPECT_LE(report->evaluations, 5000u);
  EXPECT_EQ(random_worlds::dense_check(report->path, *world, VehicleLimits{}), "");
  for (std::size_t i = 1; i < report->history.size(); ++i) {
    EXPECT_LT(report->history[i].best_length_m, report->history[i - 1].best_length_m);
  }
}

TEST(PlanPath, SameSeedSamePath) {
  const auto world = world_of({ball(1, Vec3(60, 100, 30), 20), ball(2, Vec3(120, 90, 30), 20)});
  const StopCondition stop{.max_evaluations = 4000};
  const PlanReport a = *plan_path(world, across(), stop);
  const PlanReport b = *plan_path(world, across(), stop);
  ASSERT_EQ(a.path.size(), b.path.size());
  for (std::size_t i = 0; i < a.path.size(); ++i) EXPECT_EQ(a.path[i].position_m, b.path[i].position_m);
}

TEST(PlanPath, MeetsMovingObstaclesWhenTheyAreThere) {
  // It stands in the way now but has left when the flight gets there; the other one comes.
  Obstacle leaves = ball(1, Vec3(150, 100, 30), 15);
  leaves.velocity_mps = Vec3(0, 8, 0);
  Obstacle comes = ball(2, Vec3(100, 0, 30), 15);
  comes.velocity_mps = Vec3(0, 9, 0);
  const auto world = world_of({leaves, comes});
  const PlanReport report = *plan_path(world, across(), {.max_evaluations = 10000});
  ASSERT_EQ(report.status, PlanStatus::kCertified);
  EXPECT_EQ(random_worlds::dense_check(report.path, *world, VehicleLimits{}), "");
}

TEST(PlanPath, SaysWhatIsBlocked) {
  const StopCondition stop{.max_evaluations = 1000};
  EXPECT_EQ(plan_path(world_of({ball(1, Vec3(10, 100, 30), 5)}), across(), stop)->status,
            PlanStatus::kStartBlocked);
  const PlanReport goal = *plan_path(world_of({ball(7, Vec3(190, 100, 30), 5)}), across(), stop);
  EXPECT_EQ(goal.status, PlanStatus::kGoalBlocked);
  EXPECT_NE(goal.reason.find("obstacle 7"), std::string::npos);
  PlanRequest outside = across();
  outside.goal_m.x() = 500;
  EXPECT_EQ(plan_path(world_of({}), outside, stop)->status, PlanStatus::kOutOfBounds);
  PlanRequest low = across();
  low.start_m.z() = 1.0;
  EXPECT_EQ(plan_path(world_of({}), low, stop)->status, PlanStatus::kStartBlocked);
}

TEST(PlanPath, FindsNothingThroughAWallAndStaysInItsBudget) {
  const Obstacle wall{.id = 3, .shape = Box{Vec3(5, 400, 400), 0.0}, .position_m = Vec3(100, 100, 50)};
  const PlanReport report = *plan_path(world_of({wall}), across(), {.max_evaluations = 3000});
  EXPECT_EQ(report.status, PlanStatus::kNoneFound);
  EXPECT_TRUE(report.path.empty());
  EXPECT_LE(report.evaluations, 3000u);
  EXPECT_NE(report.reason.find("obstacle 3"), std::string::npos);
}

TEST(PlanPath, SaysThatNoneWasFoundWhereTheGoalIsWalledIn) {
  std::vector<Obstacle> walls;
  const Vec3 goal(150, 100, 50);
  std::uint32_t id = 1;
  for (const Vec3& side :
       {Vec3(20, 0, 0), Vec3(-20, 0, 0), Vec3(0, 20, 0), Vec3(0, -20, 0), Vec3(0, 0, 20), Vec3(0, 0, -20)}) {
    const Vec3 size = Vec3::Constant(46) - 42.0 / 20.0 * side.cwiseAbs();
    walls.push_back({.id = id++, .shape = Box{size, 0.0}, .position_m = goal + side});
  }
  PlanRequest request = across();
  request.goal_m = goal;
  for (const std::uint64_t budget :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{10}, std::uint64_t{5000}}) {
    const PlanReport report = *plan_path(world_of(walls), request, {.max_evaluations = budget});
    EXPECT_EQ(report.status, PlanStatus::kNoneFound);
    EXPECT_TRUE(report.path.empty());
    EXPECT_LE(report.evaluations, std::max<std::uint64_t>(budget, 1));
    EXPECT_NE(report.reason.find("None found in budget"), std::string::npos) << report.reason;
  }
}

TEST(PlanPath, LeavesOutPartsWhenTold) {
  const auto world = world_of({ball(1, Vec3(60, 100, 30), 20), ball(2, Vec3(120, 90, 30), 20)});
  const double whole = plan_path(world, across(), {.max_evaluations = 4000})->length_m;
  for (const CorridorParts& parts : {CorridorParts{.tree = false}, CorridorParts{.butterflies = false},
                                     CorridorParts{.launcher = false}, CorridorParts{.polish = false}}) {
    PlanRequest request = across();
    request.params.parts = parts;
    const PlanReport report = *plan_path(world, request, {.max_evaluations = 4000});
    ASSERT_EQ(report.status, PlanStatus::kCertified);
    EXPECT_LT(report.length_m, 1.05 * whole);
    EXPECT_GE(report.length_m, whole * (1.0 - 1e-3));
  }
  PlanRequest request = across();
  request.params.parts = {.tree = false, .butterflies = false};
  EXPECT_FALSE(plan_path(world, request, {.max_evaluations = 4000}).ok());
}

TEST(PlanPath, StopsWhenAsked) {
  const std::atomic<bool> asked{true};
  const PlanReport report =
      *plan_path(world_of({ball(1, Vec3(100, 100, 30), 20)}), across(), {.stop_requested = &asked});
  EXPECT_EQ(report.status, PlanStatus::kInterrupted);
}

TEST(PlanPath, ClimbsOverARidge) {
  const Terrain ridge = *mountains_terrain({{100, 100, 60, 800}}, Vec2(0, 0), Vec2(200, 200), 2.0);
  const auto world = *World::make(ridge, {}, Bounds{Vec3(0, 0, 0), Vec3(200, 200, 120)});
  const PlanReport report = *plan_path(world, across(), {.max_evaluations = 8000});
  ASSERT_EQ(report.status, PlanStatus::kCertified) << report.reason;
  EXPECT_EQ(random_worlds::dense_check(report.path, *world, VehicleLimits{}), "");
  EXPECT_LT(report.length_m, 260.0);
}

TEST(PlanPath, RefusesBadInput) {
  PlanRequest request = across();
  request.params.algorithm = "none";
  EXPECT_FALSE(plan_path(world_of({}), request, {}).ok());
  request = across();
  request.params.waypoints = 0;
  EXPECT_FALSE(plan_path(world_of({}), request, {}).ok());
  request = across();
  request.goal_m.x() = std::nan("");
  EXPECT_FALSE(plan_path(world_of({}), request, {}).ok());
  request = across();
  request.limits.cruise_speed_mps = 0;
  EXPECT_FALSE(plan_path(world_of({}), request, {}).ok());
  EXPECT_FALSE(plan_path(nullptr, across(), {}).ok());
}

}  // namespace
}  // namespace swallowtail::planner
