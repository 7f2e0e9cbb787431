#include "tools/sim/samples.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "planner/scenario/load.hpp"
#include "tools/sim/convert.hpp"
#include "tools/sim/task_sample.hpp"

namespace swallowtail::sim {
namespace {

constexpr double kForever_s = 1e9;  // the data contract's "for ever"
constexpr double kMaxCell_m = 1e4;

data::GeoOrigin to_data(const planner::GeoOrigin& origin) {
  return {.lat_deg = origin.lat_deg, .lon_deg = origin.lon_deg, .elevation_m = origin.elevation_m};
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
    auto asked = task_sample(scenario, terrain);
    if (!asked) return asked.error();
    mission.task = std::move(asked->task);
    mission.fields = std::move(asked->fields);
    mission.no_fly = std::move(asked->no_fly);
    mission.refused = std::move(asked->refused);
    if (asked->origin) mission.origin = to_data(*asked->origin);
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
