#include "planner/participant/world_keeper.hpp"

#include <algorithm>

#include "planner/participant/convert.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kMaxSamples = 5e7;

}  // namespace

Status WorldKeeper::put(const data::TerrainTile& tile) {
  if (tile.map_id != kMapId) return {};
  const bool fits = tile.first_row + tile.tile_rows <= tile.map_rows &&
                    tile.first_col + tile.tile_cols <= tile.map_cols &&
                    static_cast<double>(tile.map_rows) * tile.map_cols <= kMaxSamples &&
                    tile.elevation_m.size() == static_cast<std::size_t>(tile.tile_rows) * tile.tile_cols;
  if (!fits) return bad_input("The terrain tile lies outside its map.");
  const auto rows = static_cast<int>(tile.map_rows);
  const auto cols = static_cast<int>(tile.map_cols);
  if (rows != grid_.rows || cols != grid_.cols || tile.cell_size_m != grid_.cell_size_m ||
      Vec2(tile.origin_x_m, tile.origin_y_m) != grid_.origin_m) {
    grid_ = {Vec2(tile.origin_x_m, tile.origin_y_m), tile.cell_size_m, rows, cols, {}};
    missing_ = static_cast<std::size_t>(tile.map_rows) * tile.map_cols;
    grid_.elevation_m.assign(missing_, 0.0F);
    filled_.assign(missing_, false);
    tile_revisions_.clear();
  }
  std::uint32_t& revision = tile_revisions_[{tile.row, tile.col}];
  if (tile.revision <= revision) return {};
  revision = tile.revision;
  for (std::uint32_t r = 0; r < tile.tile_rows; ++r) {
    for (std::uint32_t c = 0; c < tile.tile_cols; ++c) {
      const std::size_t at =
          static_cast<std::size_t>(tile.first_row + r) * tile.map_cols + tile.first_col + c;
      grid_.elevation_m[at] = tile.elevation_m[static_cast<std::size_t>(r) * tile.tile_cols + c];
      if (!filled_[at]) --missing_;
      filled_[at] = true;
    }
  }
  terrain_revision_ = std::max(terrain_revision_, tile.revision);
  terrain_.reset();
  stale_ = true;
  changed_ = true;
  return {};
}

Status WorldKeeper::put(const data::Obstacle& sample) {
  Obstacle obstacle = to_obstacle(sample);
  if (Status valid = validate(obstacle); !valid) return valid;
  obstacles_.insert_or_assign(obstacle.id, std::move(obstacle));
  ++obstacle_revision_;
  stale_ = true;
  changed_ = true;
  return {};
}

void WorldKeeper::remove_obstacle(std::uint32_t id) {
  if (obstacles_.erase(id) == 0) return;
  ++obstacle_revision_;
  stale_ = true;
  changed_ = true;
}

void WorldKeeper::set_bounds(const Bounds& bounds) {
  if (bounds.min_m == bounds_.min_m && bounds.max_m == bounds_.max_m) return;
  bounds_ = bounds;
  stale_ = true;
  changed_ = true;
}

void WorldKeeper::set_has_terrain(bool has_terrain) {
  if (has_terrain == has_terrain_) return;
  has_terrain_ = has_terrain;
  terrain_.reset();
  stale_ = true;
  changed_ = true;
}

std::shared_ptr<const World> WorldKeeper::world() {
  if (!stale_) return world_;
  if (has_terrain_ && !map_is_complete()) return world_;
  if (!terrain_) {
    if (has_terrain_) {
      Result<Terrain> terrain = Terrain::from_grid(grid_);
      if (!terrain) return world_;
      terrain_ = std::move(terrain).value();
    } else {
      terrain_ = Terrain::flat(0.0);
    }
  }
  std::vector<Obstacle> obstacles;
  for (const auto& [id, obstacle] : obstacles_) obstacles.push_back(obstacle);
  Result<std::shared_ptr<const World>> made =
      World::make(*terrain_, std::move(obstacles), bounds_, terrain_revision_, obstacle_revision_);
  if (made) {
    world_ = std::move(made).value();
    stale_ = false;
  }
  return world_;
}

}  // namespace swallowtail::planner
