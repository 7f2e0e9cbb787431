#include "tools/sim/samples.hpp"

#include <gtest/gtest.h>

#include <set>

#include "idl/data/validate.hpp"
#include "planner/base/rng.hpp"
#include "planner/scenario/load.hpp"
#include "scenario_fixture.hpp"

namespace swallowtail::sim {
namespace {

TEST(TerrainTiles, PutTogetherAreTheRaster) {
  Rng rng(4);
  planner::TerrainGrid grid{
      .origin_m = Vec2(-50, 30), .cell_size_m = 2.5, .rows = 250, .cols = 131, .elevation_m = {}};
  for (int i = 0; i < grid.rows * grid.cols; ++i)
    grid.elevation_m.push_back(static_cast<float>(rng.uniform(0, 90)));
  const auto terrain = planner::Terrain::from_grid(grid).value();
  const auto tiles = terrain_tiles(terrain, {}, {.lat_deg = 1, .lon_deg = 2, .elevation_m = 3});
  EXPECT_EQ(tiles.size(), 6U);
  std::vector<float> together(grid.elevation_m.size(), -1.0F);
  std::set<std::pair<std::uint32_t, std::uint32_t>> keys;
  for (const data::TerrainTile& tile : tiles) {
    EXPECT_FALSE(data::validate(tile)) << *data::validate(tile);
    EXPECT_EQ(tile.origin.lon_deg, 2.0);
    EXPECT_TRUE(keys.insert({tile.row, tile.col}).second);
    EXPECT_LE(tile.elevation_m.size() * sizeof(float), 60'000U);
    for (std::uint32_t r = 0; r < tile.tile_rows; ++r) {
      for (std::uint32_t c = 0; c < tile.tile_cols; ++c) {
        together[(tile.first_row + r) * tile.map_cols + tile.first_col + c] =
            tile.elevation_m[r * tile.tile_cols + c];
      }
    }
  }
  EXPECT_EQ(together, grid.elevation_m);
}

TEST(TerrainTiles, APlaneAtZeroNeedsNone) {
  EXPECT_TRUE(terrain_tiles(planner::Terrain::flat(0.0), {}, {}).empty());
}

TEST(TerrainTiles, AnotherPlaneIsOneSmallTile) {
  const planner::Bounds bounds{.min_m = Vec3(-100, -100, -5), .max_m = Vec3(900, 700, 100)};
  const auto tiles = terrain_tiles(planner::Terrain::flat(-2.5), bounds, {});
  ASSERT_EQ(tiles.size(), 1U);
  EXPECT_FALSE(data::validate(tiles[0]));
  EXPECT_EQ(tiles[0].elevation_m, std::vector<float>(4, -2.5F));
}

TEST(ObstacleSample, EveryShapeIsWithinTheContract) {
  planner::Obstacle obstacle{.id = 3,
                             .shape = planner::Sphere{2},
                             .position_m = Vec3(1, 2, 3),
                             .velocity_mps = Vec3(1, 0, 0),
                             .state_time_s = 5,
                             .margin_m = 1.5};
  const auto check = [&](planner::Shape shape, data::ObstacleShape expected) {
    obstacle.shape = std::move(shape);
    const data::Obstacle sample = to_sample(obstacle, 4);
    EXPECT_EQ(sample.shape, expected);
    EXPECT_EQ(sample.revision, 4U);
    EXPECT_EQ(sample.state_time_s, 5.0);
    EXPECT_EQ(sample.margin_m, 1.5);
    EXPECT_FALSE(data::validate(sample)) << *data::validate(sample);
  };
  check(planner::Sphere{2}, data::ObstacleShape::kSphere);
  check(planner::Cylinder{2, 9}, data::ObstacleShape::kCylinder);
  check(planner::Cone{2, 9}, data::ObstacleShape::kCone);
  check(planner::Box{Vec3(1, 2, 3), 0.5}, data::ObstacleShape::kBox);
  check(planner::ConvexMesh{{Vec3(0, 0, 0), Vec3(9, 0, 0), Vec3(0, 9, 0), Vec3(0, 0, 9)}, 0.5},
        data::ObstacleShape::kMesh);
}

TEST(Mission, AsksForTheScenariosFields) {
  const auto scenario = scenario_with();
  const auto mission = make_mission(scenario, planner::Terrain::flat(0.0), 11);
  ASSERT_TRUE(mission.ok()) << mission.error().message;
  ASSERT_TRUE(mission->task);
  EXPECT_FALSE(mission->goal);
  const data::CoverageTask& task = *mission->task;
  EXPECT_FALSE(data::validate(task)) << *data::validate(task);
  ASSERT_EQ(task.fields.size(), 1U);
  EXPECT_EQ(task.fields[0].height_m, 20.0);
  EXPECT_EQ(task.points.size(), 4U);
  EXPECT_EQ(task.seed, 11U);
  EXPECT_EQ(task.battery.capacity, 100.0);
  EXPECT_EQ(task.charger.start, (data::Vec3{-20, 5, 0}));
  EXPECT_EQ(task.start, task.charger.start);
  EXPECT_FALSE(task.has_terrain);
}

const std::string kValid = std::string(SWALLOWTAIL_SOURCE_DIR) + "/tests/data/scenarios/valid/";

Mission sample_mission(const std::string& file) {
  const auto scenario = planner::read_scenario(kValid + file);
  EXPECT_TRUE(scenario.ok()) << file;
  const auto mission = make_mission(*scenario, planner::load_terrain(*scenario).value(), 1);
  EXPECT_TRUE(mission.ok()) << file << ": " << mission.error().message;
  return mission.value();
}

TEST(Mission, OfEachSampleScenarioIsWithinTheContract) {
  for (const char* file : {"full.yaml", "flat.yaml", "smallest.yaml", "returning_obstacle.yaml",
                           "field_rules.yaml", "robot_on_roads.yaml", "robot_on_rough.yaml"}) {
    SCOPED_TRACE(file);
    const auto scenario = planner::read_scenario(kValid + file);
    ASSERT_TRUE(scenario.ok()) << scenario.errors().text();
    const auto terrain = planner::load_terrain(*scenario);
    ASSERT_TRUE(terrain.ok());
    const auto mission = make_mission(*scenario, *terrain, 1);
    ASSERT_TRUE(mission.ok()) << mission.error().message;
    const auto refusal = mission->task ? data::validate(*mission->task) : data::validate(*mission->goal);
    EXPECT_FALSE(refusal) << *refusal;
    const bool has_terrain = mission->task ? mission->task->has_terrain : mission->goal->has_terrain;
    const auto tiles = terrain_tiles(*terrain, scenario->bounds, mission->origin);
    EXPECT_EQ(has_terrain, !tiles.empty());
    for (const auto& tile : tiles) EXPECT_FALSE(data::validate(tile));
  }
}

TEST(Mission, SaysWhyNoFieldCanBeFlown) {
  auto scenario = scenario_with();
  std::ofstream(scenario.coverage->fields_file)
      << R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"id":"bow tie","crs":"local metres"},
"geometry":{"type":"Polygon","coordinates":[[[0,0],[100,100],[100,0],[0,100],[0,0]]]}}]})";
  const auto mission = make_mission(scenario, planner::Terrain::flat(0.0), 1);
  ASSERT_FALSE(mission.ok());
  EXPECT_NE(mission.error().message.find("bow tie"), std::string::npos);
}

TEST(Mission, CarriesNoFlyAreas) {
  auto scenario = scenario_with();
  std::ofstream(scenario.coverage->fields_file)
      << R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"id":"field","crs":"local metres"},
"geometry":{"type":"Polygon","coordinates":[[[0,0],[100,0],[100,100],[0,100],[0,0]]]}},
{"type":"Feature","properties":{"id":"pond","no_fly":"true","crs":"local metres"},
"geometry":{"type":"Polygon","coordinates":[[[40,40],[60,40],[60,60],[40,60],[40,40]],[[45,45],[55,45],[55,55],[45,55],[45,45]]]}}]})";
  const auto mission = make_mission(scenario, planner::Terrain::flat(0.0), 1);
  ASSERT_TRUE(mission.ok()) << mission.error().message;
  const data::CoverageTask& task = *mission->task;
  EXPECT_FALSE(data::validate(task)) << *data::validate(task);
  EXPECT_EQ(task.fields.size(), 1U);
  ASSERT_EQ(mission->no_fly.size(), 1U);
  ASSERT_EQ(task.rings.size(), 3U);
  EXPECT_EQ(task.rings[1].kind, data::AreaKind::kNoFly);
  EXPECT_FALSE(task.rings[1].is_hole);
  EXPECT_TRUE(task.rings[2].is_hole);
  EXPECT_EQ(task.points.size(), 12U);
}

TEST(Mission, CarriesRulesEnergyModelAndCharging) {
  const auto rules = sample_mission("field_rules.yaml").task.value();
  const auto scenario = planner::read_scenario(kValid + "field_rules.yaml");
  EXPECT_EQ(rules.rules.overlap, scenario->coverage->overlap);
  EXPECT_EQ(rules.rules.has_sweep, scenario->coverage->sweep_rad.has_value());
  EXPECT_EQ(rules.rules.headland == data::HeadlandUse::kNone,
            scenario->coverage->headland == planner::HeadlandUse::kNone);
  EXPECT_EQ(rules.rules.headland_m, scenario->coverage->headland_m);
  EXPECT_EQ(rules.rules.has_ceiling, scenario->coverage->ceiling_m.has_value());
  auto flown = scenario_with();
  flown.vehicle.energy.altitude_per_m = 1e-4;
  flown.vehicle.multirotor = planner::MultirotorSpec{.mass_kg = 2.5, .unit_j = 1800.0};
  flown.wind = {.speed_mps = 3.0, .direction_rad = 1.5707963267948966};
  flown.coverage->battery.taper_from = 0.7;
  flown.coverage->battery.taper_end_rate = 0.2;
  const auto mission = make_mission(flown, planner::Terrain::flat(0.0), 1);
  ASSERT_TRUE(mission.ok()) << mission.error().message;
  const data::BatteryLimits& battery = mission->task->battery;
  EXPECT_TRUE(battery.model.is_multirotor);
  EXPECT_EQ(battery.model.multirotor.mass_kg, 2.5);
  EXPECT_EQ(battery.model.unit_j, 1800.0);
  EXPECT_EQ(battery.model.altitude_per_m, 1e-4);
  EXPECT_NEAR(battery.model.wind_east_mps, 3.0, 1e-9);
  EXPECT_NEAR(battery.model.wind_north_mps, 0.0, 1e-9);
  EXPECT_EQ(battery.charge_s_per_unit, flown.coverage->battery.charge_s_per_unit);
  EXPECT_EQ(battery.taper_from, 0.7);
  EXPECT_EQ(battery.taper_end_rate, 0.2);
  EXPECT_FALSE(data::validate(*mission->task)) << *data::validate(*mission->task);
}

TEST(Mission, CarriesTheRobotsGround) {
  const auto roads = sample_mission("robot_on_roads.yaml").task.value();
  EXPECT_EQ(roads.charger.ground.kind, data::GroundKind::kRoads);
  EXPECT_EQ(roads.charger.ground.off_road_speed_mps, 1.2);
  EXPECT_FALSE(roads.roads.empty());
  const auto rough = sample_mission("robot_on_rough.yaml").task.value();
  EXPECT_EQ(rough.charger.ground.kind, data::GroundKind::kRough);
  EXPECT_EQ(rough.charger.ground.cell_m, 4.0);
  EXPECT_EQ(rough.rings.back().kind, data::AreaKind::kNoDrive);
}

}  // namespace
}  // namespace swallowtail::sim
