#include "idl/data/validate.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/unit/idl/samples.hpp"

namespace swallowtail {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// What is said of a valid sample of T after `spoil` has changed it.
template <class T>
data::Refusal after(const std::function<void(T&)>& spoil) {
  T sample = testing::make_sample<T>(testing::Extent::kRandom, 1);
  EXPECT_EQ(data::validate(sample), data::Refusal{});
  spoil(sample);
  return data::validate(sample);
}

data::CoverageTask task_with(std::vector<data::Point2> points) {
  data::CoverageTask task;
  task.fields = {{1, 20.0}};
  task.rings = {{0, 0, static_cast<std::uint32_t>(points.size()), false}};
  task.points = std::move(points);
  return task;
}

TEST(Validate, AcceptsSamplesAtTheirBounds) {
  testing::for_each_type([](auto type) {
    using T = decltype(type);
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      for (const auto extent : {testing::Extent::kEmpty, testing::Extent::kRandom, testing::Extent::kFull}) {
        const auto refusal = data::validate(testing::make_sample<T>(extent, seed));
        EXPECT_FALSE(refusal) << *refusal << ", seed " << seed;
      }
    }
  });
}

TEST(Validate, TileMustBeFiniteInsideItsMapAndOfItsSize) {
  using T = data::TerrainTile;
  EXPECT_EQ(after<T>([](T& t) { t.elevation_m[0] = std::numeric_limits<float>::quiet_NaN(); }),
            "elevation out of range");
  EXPECT_EQ(after<T>([](T& t) { t.elevation_m.push_back(0.0f); }), "tile size differs from its elevations");
  EXPECT_EQ(after<T>([](T& t) { t.tile_rows = 1u << 31, t.tile_cols = 2; }), "tile above its bound");
  EXPECT_EQ(after<T>([](T& t) { t.tile_rows = 0; }), "empty raster");
  EXPECT_EQ(after<T>([](T& t) { t.first_row = ~0u; }), "tile outside its map");
  EXPECT_EQ(after<T>([](T& t) { t.cell_size_m = 0.0; }), "cell size out of range");
  EXPECT_EQ(after<T>([](T& t) { t.map_cols = ~0u; }), "map out of range");
  EXPECT_EQ(after<T>([](T& t) { t.origin.lat_deg = 91.0; }), "geodetic origin out of range");
}

TEST(Validate, ObstacleMustHaveTheDimensionsOfItsShape) {
  using T = data::Obstacle;
  const auto with = [](data::ObstacleShape shape, std::function<void(T&)> spoil) {
    T obstacle;
    obstacle.radius_m = obstacle.height_m = 1.0;
    obstacle.size_m = {1, 1, 1};
    obstacle.shape = shape;
    if (shape == data::ObstacleShape::kMesh) obstacle.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_EQ(data::validate(obstacle), data::Refusal{});
    spoil(obstacle);
    return data::validate(obstacle);
  };
  using enum data::ObstacleShape;
  EXPECT_EQ(with(kSphere, [](T& o) { o.radius_m = -1.0; }), "radius out of range");
  EXPECT_EQ(with(kSphere, [](T& o) { o.radius_m = kNan; }), "not finite");
  EXPECT_EQ(with(kSphere, [](T& o) { o.position.x_m = kNan; }), "position out of range");
  EXPECT_EQ(with(kSphere, [](T& o) { o.velocity_mps.y_m = kInf; }), "speed out of range");
  EXPECT_EQ(with(kSphere, [](T& o) { o.velocity_mps = {150, 150, 0}; }), "speed out of range");
  EXPECT_EQ(with(kSphere, [](T& o) { o.valid_until_s = -1.0; }), "valid-until out of range");
  EXPECT_EQ(with(kSphere, [](T& o) { o.vertices.resize(4); }), "vertices without a mesh");
  EXPECT_EQ(with(kSphere, [](T& o) { o.margin_m = -0.1; }), "margin out of range");
  EXPECT_EQ(with(kCylinder, [](T& o) { o.height_m = 0.0; }), "height out of range");
  EXPECT_EQ(with(kCone, [](T& o) { o.radius_m = 1e5; }), "radius out of range");
  EXPECT_EQ(with(kBox, [](T& o) { o.size_m.z_m = 0.0; }), "box size out of range");
  EXPECT_EQ(with(kMesh, [](T& o) { o.vertices.pop_back(); }), "mesh has under 4 vertices");
  EXPECT_EQ(with(kMesh, [](T& o) { o.vertices[3] = {1, 1, 0}; }), "mesh is flat");
  EXPECT_EQ(with(kMesh, [](T& o) { o.vertices[2] = {2, 0, 0}, o.vertices[3] = {3, 0, 0}; }), "mesh is flat");
  EXPECT_EQ(with(kMesh, [](T& o) { o.vertices[0].z_m = kNan; }), "mesh vertex out of range");
  EXPECT_EQ(with(kMesh, [](T& o) { o.vertices.resize(257); }), "sequence above its bound");
}

TEST(Validate, VehicleAndBatteryMustBeInRange) {
  using V = data::VehicleState;
  EXPECT_EQ(after<V>([](V& v) { v.position.z_m = 2.1e4; }), "position out of range");
  EXPECT_EQ(after<V>([](V& v) { v.time_s = -1e-9; }), "time out of range");
  EXPECT_EQ(after<V>([](V& v) { v.yaw_rad = kInf; }), "attitude out of range");
  EXPECT_EQ(after<V>([](V& v) { v.mode = data::VehicleMode::kDocked, v.docked_charger_id = 0; }),
            "docked without a charger");
  EXPECT_EQ(after<V>([](V& v) { v.leg_index = 4097; }), "leg index above its bound");
  using B = data::BatteryState;
  EXPECT_EQ(after<B>([](B& b) { b.energy = b.capacity * 1.001; }), "energy above capacity");
  EXPECT_EQ(after<B>([](B& b) { b.energy = -1.0; }), "energy below zero");
  EXPECT_EQ(after<B>([](B& b) { b.energy = kNan; }), "not finite");
  EXPECT_EQ(after<B>([](B& b) { b.capacity = 0.0; }), "capacity out of range");
  EXPECT_EQ(after<B>([](B& b) { b.power = kInf; }), "power out of range");
  EXPECT_EQ(after<B>([](B& b) { b.health = 1.01; }), "health out of range");
}

TEST(Validate, TaskMustHaveProperRings) {
  const std::vector<data::Point2> square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_EQ(data::validate(task_with(square)), data::Refusal{});
  EXPECT_EQ(data::validate(task_with({{0, 0}, {10, 0}})), "ring has under 3 points");
  EXPECT_EQ(data::validate(task_with({{0, 0}, {10, 10}, {10, 0}, {0, 10}})), "ring crosses itself");
  EXPECT_EQ(data::validate(task_with({{0, 0}, {10, 0}, {5, 0}, {5, 5}})), "ring crosses itself") << "a spike";
  EXPECT_EQ(data::validate(task_with({{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}})), "ring crosses itself")
      << "a touch";
  EXPECT_EQ(data::validate(task_with({{0, 0}, {10, 0}, {10, 0}, {0, 10}})), "ring crosses itself")
      << "a repeated point";
  EXPECT_EQ(data::validate(task_with({{0, 0}, {10, 0}, {20, 0}})), "ring crosses itself") << "no area";
  EXPECT_EQ(data::validate(task_with({{0, 0}, {5, 0}, {10, 0}, {10, 10}, {0, 10}})), data::Refusal{})
      << "a point in line";
  EXPECT_EQ(data::validate(task_with({{0, 0}, {kNan, 0}, {10, 10}})), "point out of range");
  auto task = task_with(square);
  task.rings.push_back({0, 0, 4, false});
  EXPECT_EQ(data::validate(task), "area has two outlines");
  task.rings[1] = {1, 0, 4, false};
  EXPECT_EQ(data::validate(task), "ring of no field");
  task.rings[1] = {0, 2, 3, true};
  EXPECT_EQ(data::validate(task), "ring outside the points");
  task.rings[1] = {0, ~0u, 3, true};
  EXPECT_EQ(data::validate(task), "ring outside the points") << "the sum must not wrap";
  task.rings[1] = {0, 0, 4, true};
  EXPECT_EQ(data::validate(task), data::Refusal{});
  task.rings[0].is_hole = true;
  EXPECT_EQ(data::validate(task), "hole before its outline");
  task = task_with(square);
  task.fields.push_back({2, 10.0});
  EXPECT_EQ(data::validate(task), "area without an outline");
}

TEST(Validate, AreasOfEachKindAreCountedFromZero) {
  using enum data::AreaKind;
  auto task = task_with({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  task.rings.push_back({0, 0, 4, false, kNoFly});
  task.rings.push_back({0, 0, 4, true, kNoFly});
  task.rings.push_back({0, 0, 4, false, kNoDrive});
  EXPECT_EQ(data::validate(task), data::Refusal{});
  task.rings[3].area_index = 1;
  EXPECT_EQ(data::validate(task), "area without an outline");
  task.rings[3] = {0, 0, 4, true, kNoDrive};
  EXPECT_EQ(data::validate(task), "hole before its outline");
  task.rings[3] = {data::kMaxAreas, 0, 4, false, kNoDrive};
  EXPECT_EQ(data::validate(task), "area index above its bound");
  task.rings[3] = {0, 0, 4, false, static_cast<data::AreaKind>(3)};
  EXPECT_EQ(data::validate(task), "enumerator out of range");
}

TEST(Validate, TaskMustHaveProperRulesAndGround) {
  using T = data::CoverageTask;
  EXPECT_EQ(after<T>([](T& t) { t.rules.overlap = 0.91; }), "overlap out of range");
  EXPECT_EQ(after<T>([](T& t) { t.rules.sweep_rad = kNan; }), "sweep out of range");
  EXPECT_EQ(after<T>([](T& t) { t.rules.headland_m = -1.0; }), "headland out of range");
  EXPECT_EQ(after<T>([](T& t) { t.rules.headland = static_cast<data::HeadlandUse>(3); }),
            "enumerator out of range");
  EXPECT_EQ(after<T>([](T& t) { t.rules.has_ceiling = true, t.rules.ceiling_m = 0.0; }),
            "ceiling out of range");
  EXPECT_EQ(after<T>([](T& t) { t.roads = {{0, 1}}; }), "road has under 2 points");
  EXPECT_EQ(after<T>([](T& t) { t.roads = {{~0u, 2}}; }), "road outside the points");
  EXPECT_EQ(after<T>([](T& t) { t.roads.clear(), t.charger.ground.kind = data::GroundKind::kRoads; }),
            "charger without roads");
  EXPECT_EQ(after<T>([](T& t) {
              t.charger.ground.kind = data::GroundKind::kRough;
              t.charger.ground.area_max = t.charger.ground.area_min;
            }),
            "ground area is empty");
  EXPECT_EQ(after<T>([](T& t) { t.charger.ground.slope_max_rad = kNan; }), "slope limit out of range");
  EXPECT_EQ(after<T>([](T& t) { t.charger.ground.cell_m = 0.0; }), "cell size out of range");
  EXPECT_EQ(after<T>([](T& t) { t.charger.ground.off_road_max_m = -1.0; }), "off-road limits out of range");
}

TEST(Validate, EnergyModelMustBeFinite) {
  using T = data::CoverageTask;
  EXPECT_EQ(after<T>([](T& t) { t.battery.taper_from = 1.1; }), "charging taper out of range");
  EXPECT_EQ(after<T>([](T& t) { t.battery.taper_end_rate = 0.0; }), "charging taper out of range");
  EXPECT_EQ(after<T>([](T& t) { t.battery.model.altitude_per_m = -0.1; }), "energy model out of range");
  EXPECT_EQ(after<T>([](T& t) { t.battery.model.unit_j = 0.0; }), "energy unit out of range");
  EXPECT_EQ(after<T>([](T& t) { t.battery.model.wind_north_mps = kInf; }), "wind out of range");
  EXPECT_EQ(after<T>([](T& t) { t.battery.model.multirotor.rotors = 0; }), "multirotor out of range");
  EXPECT_EQ(after<T>([](T& t) { t.battery.model.multirotor.mass_kg = kNan; }), "multirotor out of range");
}

TEST(Validate, TaskMustHaveUsableLimits) {
  using T = data::CoverageTask;
  EXPECT_EQ(after<T>([](T& t) { t.fields.clear(); }), "task without fields");
  EXPECT_EQ(after<T>([](T& t) { t.fields[0].height_m = 0.0; }), "field height out of range");
  EXPECT_EQ(after<T>([](T& t) { t.sensor_width_m = kNan; }), "sensor width out of range");
  EXPECT_EQ(after<T>([](T& t) { t.battery.reserve = t.battery.capacity * 2; }), "reserve above capacity");
  EXPECT_EQ(after<T>([](T& t) { t.battery.levels = 0; }), "battery levels out of range");
  EXPECT_EQ(after<T>([](T& t) { t.battery.model.hover_per_s = -1; }), "energy model out of range");
  EXPECT_EQ(after<T>([](T& t) { t.vehicle.cruise_speed_mps = 0; }), "vehicle speed out of range");
  EXPECT_EQ(after<T>([](T& t) { t.vehicle.turn_max_rad = 4; }), "turn limit out of range");
  EXPECT_EQ(after<T>([](T& t) { t.vehicle.radius_m = -1; }), "vehicle radius out of range");
  EXPECT_EQ(after<T>([](T& t) { t.charger.speed_mps = kInf; }), "charger speed out of range");
  EXPECT_EQ(after<T>([](T& t) { t.neighbours = 0; }), "neighbours out of range");
}

TEST(Validate, GoalAndClockMustBeInRange) {
  using G = data::Goal;
  EXPECT_EQ(after<G>([](G& g) { g.bounds_max.x_m = g.bounds_min.x_m; }), "bounds are empty");
  EXPECT_EQ(
      after<G>([](G& g) { g.bounds_max.x_m = g.position.x_m - 1, g.bounds_min.x_m = g.position.x_m - 2; }),
      "goal outside its bounds");
  EXPECT_EQ(after<G>([](G& g) { g.start.y_m = kNan; }), "position out of range");
  using C = data::MissionClock;
  EXPECT_EQ(after<C>([](C& c) { c.time_s = kNan; }), "time out of range");
  EXPECT_EQ(after<C>([](C& c) { c.rate = -1; }), "rate out of range");
}

}  // namespace
}  // namespace swallowtail
