#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "planner/scenario/load.hpp"
#include "planner/scenario/read.hpp"
#include "planner/scenario/timeline.hpp"

namespace swallowtail::planner {
namespace {

const std::string kValid = std::string(SWALLOWTAIL_SOURCE_DIR) + "/tests/data/scenarios/valid/";

Scenario read(const char* file) {
  ScenarioResult result = read_scenario(kValid + file);
  EXPECT_TRUE(result.ok()) << result.errors().text();
  return std::move(result).value();
}

TEST(ScenarioValues, WorldIsReadAsWritten) {
  const Scenario s = read("full.yaml");
  EXPECT_EQ(s.name, "everything at once");
  ASSERT_TRUE(s.origin);
  EXPECT_EQ(s.origin->lat_deg, 52.1);
  EXPECT_EQ(s.origin->elevation_m, 12.0);
  EXPECT_EQ(s.bounds.max_m, Vec3(800, 600, 150));
  const auto& mountains = std::get<MountainTerrain>(s.terrain);
  ASSERT_EQ(mountains.mountains.size(), 2u);
  EXPECT_EQ(mountains.mountains[1].spread_m2, 20.0);
  ASSERT_EQ(s.obstacles.size(), 5u);
  EXPECT_EQ(std::get<Sphere>(s.obstacles[0].shape).radius_m, 15.0);
  EXPECT_EQ(s.obstacles[1].margin_m, 1.5);
  EXPECT_EQ(std::get<Cone>(s.obstacles[2].shape).height_m, 60.0);
  EXPECT_DOUBLE_EQ(std::get<Box>(s.obstacles[3].shape).yaw_rad, std::numbers::pi / 6);
  EXPECT_EQ(s.obstacles[3].velocity_mps, Vec3(1, 0, 0));
  EXPECT_EQ(s.obstacles[3].valid_until_s, 300.0);
}

TEST(ScenarioValues, MissionIsReadAsWritten) {
  const Scenario s = read("full.yaml");
  EXPECT_EQ(s.vehicle.id, 7u);
  EXPECT_DOUBLE_EQ(s.vehicle.limits.climb_max_rad, std::numbers::pi / 4);
  EXPECT_EQ(s.vehicle.energy.climb_per_s, 1.8);
  ASSERT_TRUE(s.coverage);
  EXPECT_EQ(s.coverage->field_ids, (std::vector<std::string>{"wheat", "2"}));
  EXPECT_EQ(s.coverage->heights.classes.at("orchard"), 30.0);
  EXPECT_EQ(s.coverage->battery.reserve, 25.0);
  EXPECT_EQ(s.coverage->charger.start_m, Vec2(10, 10));
  EXPECT_TRUE(s.coverage->fields_file.ends_with("tests/data/scenarios/fields.geojson"))
      << s.coverage->fields_file;
  EXPECT_DOUBLE_EQ(s.wind.direction_rad, std::numbers::pi / 2);
  EXPECT_EQ(s.battery_noise, 0.05);
  ASSERT_EQ(s.events.size(), 5u);
  EXPECT_EQ(std::get<ObstacleAppears>(s.events[0].what).obstacle.state_time_s, 20.0);
  EXPECT_EQ(std::get<BatteryLoss>(s.events[3].what).energy, 60.0);
}

TEST(ScenarioValues, AMeshStandsInTheMiddleOfItsVertices) {
  const Scenario s = read("full.yaml");
  const Obstacle& mesh = s.obstacles[4];
  // Centre (700, 100, 0); the vertices' middle (10, 10, 15) turned by 45° is (0, 14.14, 15).
  EXPECT_NEAR(mesh.position_m.x(), 700.0, 1e-9);
  EXPECT_NEAR(mesh.position_m.y(), 100.0 + 10.0 * std::numbers::sqrt2, 1e-9);
  EXPECT_NEAR(mesh.position_m.z(), 15.0, 1e-9);
  EXPECT_EQ(std::get<ConvexMesh>(mesh.shape).vertices_m[0], Vec3(-10, -10, -15));
}

TEST(ScenarioValues, WhatIsLeftOutHasTheStructsDefault) {
  const Scenario s = read("smallest.yaml");
  EXPECT_EQ(std::get<FlatTerrain>(s.terrain).elevation_m, 0.0);
  EXPECT_EQ(s.planning.algorithm, "boa");
  EXPECT_EQ(s.vehicle.limits.turn_max_rad, VehicleLimits{}.turn_max_rad);
  EXPECT_EQ(s.vehicle.energy.hover_per_s, 1.0);
  EXPECT_FALSE(s.coverage);
  EXPECT_FALSE(s.origin);
}

TEST(ScenarioValues, WeightsAndBandOfTheCost) {
  const PlanningSpec full = read("full.yaml").planning;
  EXPECT_EQ(full.cost, "BOA");
  EXPECT_EQ(full.weights, (std::vector<std::pair<std::string, double>>{{"energy", 0.5}}));
  EXPECT_EQ(*full.altitude_m, Vec2(20, 90));
  EXPECT_EQ(read("weights.yaml").planning.weights.size(), 15u);
}

TEST(ScenarioTimeline, ObstaclesAppearMoveAndVanish) {
  const Scenario s = read("returning_obstacle.yaml");
  EXPECT_TRUE(obstacles_at(s, 9.9).empty());
  ASSERT_EQ(obstacles_at(s, 10.0).size(), 1u);
  EXPECT_EQ(obstacles_at(s, 15.0)[0].position_at(15.0), Vec3(45, 60, 30));
  EXPECT_EQ(obstacles_at(s, 25.0)[0].position_at(25.0), Vec3(50, 55, 30));
  EXPECT_TRUE(obstacles_at(s, 30.0).empty());
  EXPECT_EQ(obstacles_at(s, 40.0)[0].position_at(50.0), Vec3(60, 40, 30));
}

TEST(ScenarioLoad, BuildsTheWorldKnownAtTheStart) {
  const auto world = load_world(read("full.yaml"));
  ASSERT_TRUE(world.ok()) << world.error().message;
  EXPECT_EQ((*world)->obstacles().size(), 5u);
  EXPECT_NEAR((*world)->terrain().height_at(600, 500), 40.0, 0.5);
}

TEST(ScenarioLoad, MountainsGetCellsFineEnoughForTheNarrowest) {
  Scenario s = read("full.yaml");
  auto& spec = std::get<MountainTerrain>(s.terrain);
  spec.cell_size_m.reset();
  const auto terrain = load_terrain(s);
  ASSERT_TRUE(terrain.ok()) << terrain.error().message;
  EXPECT_NEAR(terrain.value().height_at(100, 500), 25.0, 0.5);
}

TEST(ScenarioLoad, AFieldMissionStartsOnTheGroundAtTheCharger) {
  const Scenario s = read("flat.yaml");
  const auto terrain = load_terrain(s);
  ASSERT_TRUE(terrain.ok());
  EXPECT_EQ(start_position_m(s, terrain.value()), Vec3(0, 0, -2.5));
}

TEST(ScenarioFile, OneThatIsNotThereIsAnError) {
  const ScenarioResult result = read_scenario("/nowhere/at_all.yaml");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.errors().errors.front().text(), "/nowhere/at_all.yaml:0: no such file");
}

}  // namespace
}  // namespace swallowtail::planner
