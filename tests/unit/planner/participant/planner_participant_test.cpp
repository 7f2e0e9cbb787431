#include "planner/participant/planner_participant.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/rng.hpp"
#include "tests/unit/planner/participant/planner_fixture.hpp"

namespace swallowtail::planner {
namespace {

using data::Transfer;

class PlannerTest : public ::testing::Test, protected PlannerFixture {
 protected:
  /// Least distance of the flight so far published path to a point.
  static double distance_to(const data::PathPlan& plan, const Vec3& point) {
    double least = 1e9;
    const TimedPath path = to_path(plan.waypoints);
    for (double t = path.front().time_s; t < path.back().time_s; t += 0.02)
      least = std::min(least, (position_at(path, t) - point).norm());
    return least;
  }
  void start_mission(const std::vector<Transfer>& transfers) {
    publish(task());
    publish(plan(transfers));
    run(0.2);
  }
};

TEST_F(PlannerTest, PublishesNothingWithoutAMission) {
  run(3.0);
  EXPECT_EQ(path_count(), 0u);
}

TEST_F(PlannerTest, PlansTheFirstSortieToItsLanding) {
  start_mission({Transfer::kFF, Transfer::kFF, Transfer::kEnd});
  ASSERT_EQ(path_count(), 1u);
  EXPECT_EQ(path().verdict, data::PathVerdict::kCertified);
  EXPECT_TRUE(path().lands);
  EXPECT_EQ(path().basis.coverage_revision, 1u);
  EXPECT_EQ(path().waypoints.front().phase, data::PathPhase::kTakeOff);
  EXPECT_NEAR(path().waypoints.back().position.y_m, 100.0, 1e-9);
  EXPECT_GE(path().waypoints.front().time_s, 0.5);
}

TEST_F(PlannerTest, FliesTheWholePlanWithoutAJump) {
  start_mission({Transfer::kFF, Transfer::kFF, Transfer::kEnd});
  run(90.0);
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kLanded);
  EXPECT_EQ(vehicle.legs_done, 3u);
  EXPECT_EQ(path_count(), 1u) << "nothing changed, so nothing is replanned";
  EXPECT_LT(largest_jump_m, 1e-6);
}

TEST_F(PlannerTest, WaitsForTheChargerBetweenSorties) {
  start_mission({Transfer::kFDUF, Transfer::kEnd});
  run(60.0);
  ASSERT_EQ(vehicle.mode, data::VehicleMode::kLanded);
  EXPECT_EQ(path_count(), 1u);
  charger_ready_at({400, 400, 0});
  run(2.0);
  EXPECT_EQ(path_count(), 1u) << "the charger is elsewhere";
  charger_ready_at(vehicle.position);
  run(2.0);
  ASSERT_EQ(path_count(), 2u);
  run(60.0);
  EXPECT_EQ(vehicle.legs_done, 2u);
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kLanded);
  EXPECT_NEAR(vehicle.position.x_m, 10.0, 1e-6);
}

TEST_F(PlannerTest, WaitsAtTheStartForAChargerThatIsToComeFirst) {
  data::ChargerPlan orders;
  orders.charger_id = 1;
  orders.task_id = 1;
  orders.vehicle_id = 1;
  orders.rendezvous.emplace_back().site = vehicle.position;
  publish(orders);
  start_mission({Transfer::kEnd});
  run(10.0);
  EXPECT_EQ(path_count(), 0u);
  charger_ready_at(vehicle.position);
  run(2.0);
  EXPECT_EQ(path_count(), 1u);
}

TEST_F(PlannerTest, LandsAtTheNextEntryWhereThePlanSaysSo) {
  start_mission({Transfer::kFFDU, Transfer::kEnd});
  run(60.0);
  ASSERT_EQ(vehicle.mode, data::VehicleMode::kLanded);
  EXPECT_EQ(vehicle.legs_done, 1u);
  EXPECT_NEAR(vehicle.position.x_m, 10.0, 1e-6);
  EXPECT_NEAR(vehicle.position.y_m, 100.0, 1e-6);
}

TEST_F(PlannerTest, AvoidsAnObstacleThatAppears) {
  start_mission({Transfer::kFF, Transfer::kEnd});
  run(12.0);
  ASSERT_EQ(vehicle.mode, data::VehicleMode::kCovering);
  publish(sphere(7, {0, 80, 20}, 5.0));
  run(0.2);
  ASSERT_EQ(path_count(), 2u);
  EXPECT_EQ(path().verdict, data::PathVerdict::kCertified);
  EXPECT_GE(distance_to(path(), Vec3(0, 80, 20)), 7.5 - 1e-6);
  EXPECT_EQ(path().basis.obstacle_revision, 1u);
  run(60.0);
  EXPECT_EQ(vehicle.legs_done, 2u);
  EXPECT_LT(largest_jump_m, 0.01);
}

/// Least distance of a path to the box between two corners, at any height; 0 inside.
double distance_to_box(const data::PathPlan& plan, const Vec2& lo, const Vec2& hi) {
  double least = 1e9;
  const TimedPath path = to_path(plan.waypoints);
  for (double t = path.front().time_s; t < path.back().time_s; t += 0.01) {
    const Vec2 p = position_at(path, t).head<2>();
    least = std::min(least, (p - p.cwiseMax(lo).cwiseMin(hi)).norm());
  }
  return least;
}

TEST_F(PlannerTest, NeverEntersANoFlyArea) {
  data::CoverageTask t = task();
  // Across the second strip and the transfer after the first.
  t.points.insert(t.points.end(), {{3, 90}, {17, 90}, {17, 120}, {3, 120}});
  t.rings.push_back({0, 4, 4, false, data::AreaKind::kNoFly});
  publish(t);
  publish(plan({Transfer::kFF, Transfer::kFF, Transfer::kEnd}));
  run(0.2);
  ASSERT_EQ(path_count(), 1u);
  EXPECT_EQ(path().verdict, data::PathVerdict::kCertified) << path().reason;
  EXPECT_GT(distance_to_box(path(), Vec2(3, 90), Vec2(17, 120)), 0.0);
}

TEST_F(PlannerTest, StripsMayEndNearerToANoFlyAreaThanItsMargin) {
  data::CoverageTask t = task();
  t.points.insert(t.points.end(), {{-20, 100.1}, {60, 100.1}, {60, 140}, {-20, 140}});
  t.rings.push_back({0, 4, 4, false, data::AreaKind::kNoFly});
  publish(t);
  publish(plan({Transfer::kFF, Transfer::kFF, Transfer::kEnd}));
  run(0.2);
  ASSERT_EQ(path_count(), 1u);
  EXPECT_EQ(path().reason, "route is clear");
}

TEST_F(PlannerTest, RefusesATaskWhoseNoFlyAreaIsNoPolygon) {
  data::CoverageTask t = task();
  t.points.insert(t.points.end(), {{0, 0}, {9, 0}, {9, 9}, {50, 50}, {60, 50}, {60, 60}});
  t.rings.push_back({0, 4, 3, false, data::AreaKind::kNoFly});
  t.rings.push_back({0, 7, 3, true, data::AreaKind::kNoFly});
  publish(t);
  publish(plan({Transfer::kEnd}));
  run(1.0);
  EXPECT_EQ(path_count(), 0u);
}

TEST_F(PlannerTest, ComesDownWhereItWouldHoldWhenItsLandingIsShut) {
  start_mission({Transfer::kEnd});
  run(12.0);
  ASSERT_EQ(vehicle.mode, data::VehicleMode::kCovering);
  data::CoveragePlan down = plan({Transfer::kFDUF, Transfer::kEnd}, 2);
  down.legs[0].kind = data::LegKind::kReposition;
  down.legs[0].entry = down.legs[0].exit = {0, 95, 20};
  down.legs[0].energy_before = 30.0;
  down.legs[0].energy_after = 27.0;
  down.legs[0].end_s = 10.0;
  down.legs[1].start_s = down.legs[1].end_s = 10.0;
  publish(sphere(3, {0, 95, 12}, 6));
  publish(down);
  run(60.0);
  EXPECT_TRUE(std::any_of(paths.begin(), paths.end(), [](const data::PathPlan& p) {
    return p.verdict == data::PathVerdict::kContingency && p.lands;
  })) << path().reason;
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kLanded);
}

TEST_F(PlannerTest, KeepsItsPathWhenAnObstacleAppearsElsewhere) {
  start_mission({Transfer::kFF, Transfer::kEnd});
  run(12.0);
  publish(sphere(7, {300, 80, 20}, 5.0));
  run(1.0);
  EXPECT_EQ(path_count(), 1u);
}

TEST_F(PlannerTest, AvoidsAnObstacleThatMovesIntoItsWay) {
  start_mission({Transfer::kFF, Transfer::kEnd});
  run(10.0);
  data::Obstacle mover = sphere(7, {-60, 70, 20}, 4.0);
  mover.state_time_s = time_s;
  mover.velocity_mps = {60.0 / 6.0, 0, 0};
  publish(mover);
  run(0.2);
  for (const data::PathPlan& p : paths) {
    const TimedPath flown = to_path(p.waypoints);
    if (&p != &paths.back()) continue;
    for (double t = std::max(time_s, flown.front().time_s); t < flown.back().time_s; t += 0.02) {
      const Vec3 at(-60 + mover.velocity_mps.x_m * (t - mover.state_time_s), 70, 20);
      ASSERT_GE((position_at(flown, t) - at).norm(), 6.5 - 1e-3) << t;
    }
  }
  run(60.0);
  EXPECT_EQ(vehicle.legs_done, 2u);
}

TEST_F(PlannerTest, HoldsWhenItsGoalIsBlockedAndGoesOnWhenItIsFreeAgain) {
  start_mission({Transfer::kEnd});
  run(12.0);
  const data::Obstacle lid = sphere(9, {0, 100, 10}, 8.0);
  publish(lid);
  run(0.5);
  ASSERT_GE(path_count(), 2u);
  EXPECT_EQ(path().verdict, data::PathVerdict::kContingency);
  EXPECT_NE(path().reason.find("obstacle 9"), std::string::npos) << path().reason;
  run(20.0);
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kHolding);
  remove(lid);
  run(1.0);
  EXPECT_EQ(path().verdict, data::PathVerdict::kCertified);
  run(30.0);
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kLanded);
  EXPECT_EQ(vehicle.legs_done, 1u);
}

TEST_F(PlannerTest, FollowsANewCoveragePlanInFlight) {
  start_mission({Transfer::kFF, Transfer::kFF, Transfer::kEnd});
  run(10.0);
  publish(plan({Transfer::kFDUF, Transfer::kFF, Transfer::kEnd}, 2));
  run(0.2);
  ASSERT_EQ(path_count(), 2u);
  EXPECT_EQ(path().basis.coverage_revision, 2u);
  EXPECT_NEAR(path().waypoints.back().position.x_m, 0.0, 1e-9) << "it lands after the first leg now";
  EXPECT_TRUE(path().lands);
  run(30.0);
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kLanded);
  EXPECT_LT(largest_jump_m, 0.01);
}

TEST_F(PlannerTest, FollowsANewCoveragePlanOnceThereIsAPathForIt) {
  start_mission({Transfer::kFF, Transfer::kFF, Transfer::kEnd});
  run(12.0);
  // For a second there is no safe path from anywhere that the aircraft can reach; nothing tells of its end.
  data::Obstacle around = sphere(9, vehicle.position, 30.0);
  around.valid_until_s = time_s + 1.5;
  publish(around);
  publish(plan({Transfer::kFDUF, Transfer::kFF, Transfer::kEnd}, 2));
  run(0.3);
  ASSERT_EQ(path_count(), 1u) << path().reason;
  run(3.0);
  EXPECT_EQ(path().basis.coverage_revision, 2u);
  EXPECT_EQ(path().verdict, data::PathVerdict::kCertified);
  EXPECT_LE(path_count(), 3u) << "it does not go on once there is one";
  run(30.0);
  EXPECT_NEAR(vehicle.position.x_m, 0.0, 1e-6) << "it lands after the first leg now";
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kLanded);
}

TEST_F(PlannerTest, ResumesInMidMissionAfterARestart) {
  start_mission({Transfer::kFF, Transfer::kFF, Transfer::kEnd});
  run(14.0);
  const std::uint32_t revision = path().revision;
  stop_planner();
  run(2.0);
  start_planner();
  run(2.0);
  ASSERT_GT(path().revision, revision);
  EXPECT_EQ(path().verdict, data::PathVerdict::kCertified);
  run(90.0);
  EXPECT_EQ(vehicle.legs_done, 3u);
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kLanded);
  EXPECT_LT(largest_jump_m, 0.3);
}

TEST_F(PlannerTest, FliesToAGoalAndHoldsThere) {
  vehicle.position = {5, 5, 0};
  data::Goal goal;
  goal.vehicle_id = 1;
  goal.start = {5, 5, 30};
  goal.position = {150, 90, 40};
  goal.bounds_min = {0, 0, 0};
  goal.bounds_max = {200, 200, 100};
  publish(sphere(3, {80, 48, 35}, 15.0));
  publish(goal);
  run(1.0);
  ASSERT_EQ(path_count(), 1u);
  EXPECT_EQ(path().verdict, data::PathVerdict::kCertified);
  EXPECT_FALSE(path().lands);
  EXPECT_EQ(path().basis.goal_revision, 1u);
  EXPECT_GE(distance_to(path(), Vec3(80, 48, 35)), 17.5 - 1e-6);
  run(60.0);
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kHolding);
  EXPECT_LT((position() - Vec3(150, 90, 40)).norm(), 1e-6);
}

TEST_F(PlannerTest, WaitsForTheWholeTerrain) {
  data::CoverageTask t = task();
  t.has_terrain = true;
  publish(t);
  publish(plan({Transfer::kEnd}));
  data::TerrainTile tile;
  tile.map_id = 1;
  tile.origin_x_m = -50;
  tile.origin_y_m = -50;
  tile.cell_size_m = 20;
  tile.map_rows = tile.tile_rows = 12;
  tile.map_cols = 24;
  tile.tile_cols = 12;
  tile.elevation_m.assign(144, 0.0F);
  publish(tile);
  run(1.0);
  EXPECT_EQ(path_count(), 0u);
  tile.col = 1;
  tile.first_col = 12;
  publish(tile);
  run(1.0);
  ASSERT_EQ(path_count(), 1u);
  EXPECT_EQ(path().basis.terrain_revision, 1u);
}

TEST_F(PlannerTest, CountsWhatIsNotForIt) {
  data::CoveragePlan other = plan({Transfer::kEnd});
  other.vehicle_id = 2;
  publish(other);
  run(0.1);
  std::uint64_t refused = 0;
  for (const data::Rejection& r : planner_bus_->statistics().rejected) {
    if (r.topic == "CoveragePlan" && r.reason == "unknown vehicle") refused += r.count;
  }
  EXPECT_EQ(refused, 1u);
}

TEST_F(PlannerTest, EveryPublishedPathIsCertifiedInTheWorldItNames) {
  start_mission({Transfer::kFF, Transfer::kFF, Transfer::kEnd});
  std::vector<data::Obstacle> known;
  Rng rng(5);
  for (std::uint32_t i = 1; i <= 12; ++i) {
    run(4.0);
    known.push_back(
        sphere(i, {rng.uniform(0, 20), rng.uniform(15, 85), rng.uniform(16, 24)}, rng.uniform(1, 3)));
    if ((to_vec(known.back().position) - position()).norm() < 20.0) known.back().position.x_m += 60.0;
    publish(known.back());
    run(0.1);
    std::vector<Obstacle> obstacles;
    for (const data::Obstacle& o : known) obstacles.push_back(to_obstacle(o));
    if (path().basis.obstacle_revision != known.size()) continue;
    const Result<std::shared_ptr<const World>> world = World::make(Terrain::flat(0.0), obstacles, Bounds{});
    EXPECT_TRUE(certify(to_path(path().waypoints), ClearanceQuery(*world), VehicleLimits{}).certified);
  }
  EXPECT_GT(path_count(), 2u);
}

TEST(PlannerLead, GrowsWithTheRateAndTheBudget) {
  EXPECT_DOUBLE_EQ(PlannerParticipant::lead_s(1.0, 60.0), 0.5);
  EXPECT_DOUBLE_EQ(PlannerParticipant::lead_s(10.0, 60.0), 1.5);
  EXPECT_DOUBLE_EQ(PlannerParticipant::lead_s(10.0, 440.0), 5.0);
}

TEST(PlannerOptionsRules, RefusesWhatMakesNoSense) {
  EXPECT_TRUE(validate(PlannerOptions{}).ok());
  EXPECT_FALSE(validate(PlannerOptions{.vehicle_id = 0}).ok());
  EXPECT_FALSE(validate(PlannerOptions{.budget_ms = 0.0}).ok());
  EXPECT_FALSE(validate(PlannerOptions{.ownership_strength = -1}).ok());
  EXPECT_FALSE(validate(PlannerOptions{.obstacle_acceleration_mps2 = -1.0}).ok());
}

}  // namespace
}  // namespace swallowtail::planner
