#include "tools/sim/samples.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "coverage/energy/charging.hpp"
#include "coverage/task/energy_of.hpp"
#include "coverage/task/fields_of.hpp"
#include "planner/scenario/load.hpp"
#include "tools/sim/convert.hpp"

namespace swallowtail::sim {
namespace {

constexpr double kForever_s = 1e9;  // the data contract's "for ever"
constexpr double kMaxCell_m = 1e4;

data::GeoOrigin to_data(const planner::GeoOrigin& origin) {
  return {.lat_deg = origin.lat_deg, .lon_deg = origin.lon_deg, .elevation_m = origin.elevation_m};
}

data::VehicleLimits to_data(const planner::VehicleLimits& limits) {
  return {.radius_m = limits.radius_m,
          .margin_m = limits.margin_m,
          .cruise_speed_mps = limits.cruise_speed_mps,
          .climb_speed_mps = limits.climb_speed_mps,
          .descent_speed_mps = limits.descent_speed_mps,
          .turn_max_rad = limits.turn_max_rad,
          .climb_max_rad = limits.climb_max_rad};
}

/// A plane as the smallest raster there is, as wide as the bounds; outside it its edge goes on.
planner::TerrainGrid plane(double elevation_m, const planner::Bounds& bounds) {
  const Vec2 lo = bounds.min_m.head<2>();
  const double span_m = (bounds.max_m.head<2>() - lo).maxCoeff();
  return {.origin_m = lo,
          .cell_size_m = std::clamp(span_m, 1.0, kMaxCell_m),
          .rows = 2,
          .cols = 2,
          .elevation_m = std::vector<float>(4, static_cast<float>(elevation_m))};
}

data::TerrainTile tile_of(const planner::TerrainGrid& grid, int row, int col) {
  data::TerrainTile tile;
  tile.map_id = kTerrainMapId;
  tile.row = static_cast<std::uint32_t>(row);
  tile.col = static_cast<std::uint32_t>(col);
  tile.origin_x_m = grid.origin_m.x();
  tile.origin_y_m = grid.origin_m.y();
  tile.cell_size_m = grid.cell_size_m;
  tile.map_rows = static_cast<std::uint32_t>(grid.rows);
  tile.map_cols = static_cast<std::uint32_t>(grid.cols);
  const int first_row = row * kTileSide;
  const int first_col = col * kTileSide;
  const int rows = std::min(kTileSide, grid.rows - first_row);
  const int cols = std::min(kTileSide, grid.cols - first_col);
  tile.first_row = static_cast<std::uint32_t>(first_row);
  tile.first_col = static_cast<std::uint32_t>(first_col);
  tile.tile_rows = static_cast<std::uint32_t>(rows);
  tile.tile_cols = static_cast<std::uint32_t>(cols);
  tile.elevation_m.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols));
  for (int r = first_row; r < first_row + rows; ++r) {
    const auto begin = grid.elevation_m.begin() + (static_cast<std::ptrdiff_t>(r) * grid.cols + first_col);
    tile.elevation_m.insert(tile.elevation_m.end(), begin, begin + cols);
  }
  return tile;
}

struct FillShape {
  data::Obstacle& sample;

  void operator()(const planner::Sphere& sphere) const {
    sample.shape = data::ObstacleShape::kSphere;
    sample.radius_m = sphere.radius_m;
  }
  void operator()(const planner::Cylinder& cylinder) const {
    sample.shape = data::ObstacleShape::kCylinder;
    sample.radius_m = cylinder.radius_m;
    sample.height_m = cylinder.height_m;
  }
  void operator()(const planner::Cone& cone) const {
    sample.shape = data::ObstacleShape::kCone;
    sample.radius_m = cone.radius_m;
    sample.height_m = cone.height_m;
  }
  void operator()(const planner::Box& box) const {
    sample.shape = data::ObstacleShape::kBox;
    sample.size_m = sim::to_data(box.size_m);
    sample.yaw_rad = box.yaw_rad;
  }
  void operator()(const planner::ConvexMesh& mesh) const {
    sample.shape = data::ObstacleShape::kMesh;
    sample.yaw_rad = mesh.yaw_rad;
    for (const Vec3& vertex : mesh.vertices_m) sample.vertices.push_back(sim::to_data(vertex));
  }
};

void add_ring(data::CoverageTask& task, const coverage::Ring& ring, bool is_hole) {
  task.rings.push_back({.area_index = static_cast<std::uint32_t>(task.fields.size() - 1),
                        .first_point = static_cast<std::uint32_t>(task.points.size()),
                        .point_count = static_cast<std::uint32_t>(ring.size()),
                        .is_hole = is_hole});
  for (const Vec2& vertex : ring) task.points.push_back({.x_m = vertex.x(), .y_m = vertex.y()});
}

void add_part(const coverage::Field& field, coverage::Polygon part, Mission& mission) {
  data::CoverageTask& task = *mission.task;
  task.fields.push_back({.field_id = field.id, .height_m = field.height_m});
  add_ring(task, part.outline, false);
  for (const coverage::Ring& hole : part.holes) add_ring(task, hole, true);
  mission.fields.push_back({field.id, field.name, std::move(part), field.height_m});
}

/// What a scenario may ask of a plan but a mission does not hear of.
Status check_wire(const planner::CoverageSpec& spec) {
  const bool is_plain = spec.overlap == 0.0 && !spec.sweep_rad &&
                        spec.headland == planner::HeadlandUse::kNone && !spec.lines_beyond_borders &&
                        !spec.ceiling_m;
  if (is_plain) return {};
  return bad_input(
      "The scenario's coverage has overlap, sweep_deg, headland, lines_beyond_borders or ceiling_m, which "
      "the "
      "wire does not carry: a mission would be flown without. Plan with `swallowtail cover`.");
}

Status add_fields(const coverage::ScenarioFields& wanted, const planner::CoverageSpec& spec,
                  Mission& mission) {
  if (const Status status = check_wire(spec); !status) return status;
  if (!wanted.no_fly.empty()) {
    return bad_input(
        "The scenario's field file has " + std::to_string(wanted.no_fly.size()) +
        " no-fly areas, and the wire does not carry them: a mission would fly over them. Plan with "
        "`swallowtail cover`, or make them obstacles.");
  }
  if (!std::holds_alternative<std::monostate>(spec.charger.ground)) {
    return bad_input(
        "The scenario's ground robot keeps to roads or ground that the wire does not carry: in a mission it "
        "would drive straight. Plan with `swallowtail cover`.");
  }
  data::CoverageTask& task = *mission.task;
  for (const coverage::Field& field : wanted.fields) {
    auto parts = coverage::clean(field.polygon);
    if (!parts) {
      mission.refused.push_back("field " + field.name + ": " + parts.error().message);
      continue;
    }
    for (coverage::Polygon& part : *parts) add_part(field, std::move(part), mission);
  }
  if (task.fields.empty()) {
    return bad_input("None of the scenario's fields can be flown; the first: " +
                     (mission.refused.empty() ? std::string("there is none") : mission.refused.front()) +
                     ".");
  }
  if (task.fields.size() > data::kMaxFields || task.rings.size() > data::kMaxRings ||
      task.points.size() > data::kMaxRingPoints) {
    return bad_input("A coverage task holds at most " + std::to_string(data::kMaxFields) + " fields, " +
                     std::to_string(data::kMaxRings) + " rings and " + std::to_string(data::kMaxRingPoints) +
                     " points; the scenario has " + std::to_string(task.fields.size()) + ", " +
                     std::to_string(task.rings.size()) + " and " + std::to_string(task.points.size()) +
                     ". Choose some with coverage.field_ids.");
  }
  return {};
}

/// No flight over the fields is planned higher.
double highest_m(const planner::Scenario& scenario, const planner::Terrain& terrain) {
  const planner::CoverageSpec& spec = *scenario.coverage;
  double height_m = spec.heights.default_m;
  for (const auto& [name, class_height_m] : spec.heights.classes)
    height_m = std::max(height_m, class_height_m);
  const double ground_m = terrain.max_in(scenario.bounds.min_m.head<2>(), scenario.bounds.max_m.head<2>());
  return ground_m + std::max(height_m + spec.height_tolerance_m, scenario.vehicle.limits.clearance_m() + 1.0);
}

/// The wire has one charging rate: the mean one from the reserve to full.
double mean_charge_s_per_unit(const planner::BatterySpec& battery) {
  const coverage::ChargingCurve curve{battery.charge_s_per_unit, battery.capacity, battery.taper_from,
                                      battery.taper_end_rate};
  if (curve.is_linear()) return battery.charge_s_per_unit;
  return curve.seconds(battery.reserve, battery.capacity) / (battery.capacity - battery.reserve);
}

/// The wire has one rate for each phase: those of the most that the energy model asks for there.
void fill_task(const planner::Scenario& scenario, const planner::Terrain& terrain, data::CoverageTask& task) {
  const planner::CoverageSpec& spec = *scenario.coverage;
  const coverage::EnergyModel rates = coverage::greatest_rates(
      coverage::energy_model_of(scenario), scenario.vehicle.limits, highest_m(scenario, terrain));
  task.task_id = kTaskId;
  task.vehicle_id = scenario.vehicle.id;
  task.sensor_width_m = spec.sensor_width_m;
  task.height_tolerance_m = spec.height_tolerance_m;
  task.height_band_m = spec.height_band_m;
  task.neighbours = static_cast<std::uint32_t>(spec.neighbours);
  task.vehicle = to_data(scenario.vehicle.limits);
  task.battery = {.capacity = spec.battery.capacity,
                  .reserve = spec.battery.reserve,
                  .levels = static_cast<std::uint32_t>(spec.battery.levels),
                  .charge_s_per_unit = mean_charge_s_per_unit(spec.battery),
                  .model = {.level_per_s = rates.level_per_s,
                            .climb_per_s = rates.climb_per_s,
                            .descent_per_s = rates.descent_per_s,
                            .hover_per_s = rates.hover_per_s,
                            .landed_per_s = rates.landed_per_s}};
  const Vec2& site = spec.charger.start_m;
  task.charger = {.charger_id = spec.charger.id,
                  .speed_mps = spec.charger.speed_mps,
                  .take_off_s = spec.charger.take_off_s,
                  .landing_s = spec.charger.landing_s,
                  .start = {.x_m = site.x(), .y_m = site.y(), .z_m = terrain.height_at(site.x(), site.y())}};
}

bool has_terrain(const planner::Terrain& terrain) {
  return !terrain.is_flat() || terrain.flat_elevation_m() != 0.0;
}

}  // namespace

std::vector<data::TerrainTile> terrain_tiles(const planner::Terrain& terrain, const planner::Bounds& bounds,
                                             const data::GeoOrigin& origin) {
  if (!has_terrain(terrain)) return {};
  const planner::TerrainGrid grid =
      terrain.is_flat() ? plane(terrain.flat_elevation_m(), bounds) : *terrain.grid();
  std::vector<data::TerrainTile> tiles;
  for (int row = 0; row * kTileSide < grid.rows; ++row) {
    for (int col = 0; col * kTileSide < grid.cols; ++col) {
      tiles.push_back(tile_of(grid, row, col));
      tiles.back().origin = origin;
    }
  }
  return tiles;
}

data::Obstacle to_sample(const planner::Obstacle& obstacle, std::uint32_t revision) {
  data::Obstacle sample;
  sample.obstacle_id = obstacle.id;
  sample.revision = revision;
  sample.position = to_data(obstacle.position_m);
  sample.velocity_mps = to_data(obstacle.velocity_mps);
  sample.state_time_s = obstacle.state_time_s;
  sample.valid_until_s = std::min(obstacle.valid_until_s, kForever_s);
  sample.margin_m = obstacle.margin_m;
  std::visit(FillShape{sample}, obstacle.shape);
  return sample;
}

Result<Mission> make_mission(const planner::Scenario& scenario, const planner::Terrain& terrain,
                             std::uint64_t seed) {
  Mission mission;
  mission.start_m = planner::start_position_m(scenario, terrain);
  if (scenario.origin) mission.origin = to_data(*scenario.origin);
  if (scenario.coverage) {
    auto wanted = coverage::fields_of(scenario);
    if (!wanted) return wanted.error();
    if (wanted->origin) mission.origin = to_data(*wanted->origin);
    mission.task.emplace();
    fill_task(scenario, terrain, *mission.task);
    if (Status filled = add_fields(*wanted, *scenario.coverage, mission); !filled) return filled.error();
    mission.task->origin = mission.origin;
    mission.task->start = to_data(mission.start_m);
    mission.task->seed = seed;
    mission.task->has_terrain = has_terrain(terrain);
    return mission;
  }
  if (!scenario.goal_m) return bad_input(scenario.file + ": there is neither a goal nor a coverage.");
  mission.goal = data::Goal{.vehicle_id = scenario.vehicle.id,
                            .origin = mission.origin,
                            .start = to_data(mission.start_m),
                            .position = to_data(*scenario.goal_m),
                            .vehicle = to_data(scenario.vehicle.limits),
                            .bounds_min = to_data(scenario.bounds.min_m),
                            .bounds_max = to_data(scenario.bounds.max_m),
                            .seed = seed,
                            .has_terrain = has_terrain(terrain)};
  return mission;
}

}  // namespace swallowtail::sim
