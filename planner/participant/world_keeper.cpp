#include "planner/participant/world_keeper.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "planner/participant/convert.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kMaxSamples = 5e7;
constexpr double kBelowGround_m = 10.0;

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

void WorldKeeper::set_no_fly(std::vector<std::vector<Vec2>> parts, double relief_m) {
  if (parts == no_fly_ && relief_m == no_fly_relief_m_) return;
  no_fly_ = std::move(parts);
  no_fly_relief_m_ = relief_m;
  stale_ = true;
  changed_ = true;
}

void WorldKeeper::set_turn_margin(double margin_m) {
  if (margin_m == turn_margin_m_) return;
  turn_margin_m_ = margin_m;
  const bool any_moves =
      std::ranges::any_of(obstacles_, [](const auto& known) { return known.second.moves(); });
  stale_ = stale_ || any_moves;
  changed_ = changed_ || any_moves;
}

void WorldKeeper::set_has_terrain(bool has_terrain) {
  if (has_terrain == has_terrain_) return;
  has_terrain_ = has_terrain;
  terrain_.reset();
  stale_ = true;
  changed_ = true;
}

bool WorldKeeper::build_terrain() {
  if (terrain_) return true;
  lowest_m_ = highest_m_ = 0.0;
  if (has_terrain_) {
    Result<Terrain> terrain = Terrain::from_grid(grid_);
    if (!terrain) return false;
    terrain_ = std::move(terrain).value();
    const auto [low, high] = std::minmax_element(grid_.elevation_m.begin(), grid_.elevation_m.end());
    lowest_m_ = *low;
    highest_m_ = *high;
  } else {
    terrain_ = Terrain::flat(0.0);
  }
  return true;
}

void WorldKeeper::add_no_fly(std::vector<Obstacle>& obstacles) const {
  std::uint32_t id = std::numeric_limits<std::uint32_t>::max();
  for (const std::vector<Vec2>& part : no_fly_) {
    while (obstacles_.contains(id)) --id;
    Obstacle prism;
    prism.id = id--;
    prism.position_m = Vec3(part.front().x(), part.front().y(), lowest_m_);
    prism.relief_m = no_fly_relief_m_;
    ConvexMesh mesh;
    for (const double z : {-kBelowGround_m, highest_m_ - lowest_m_ + kNoFlyTop_m}) {
      for (const Vec2& p : part)
        mesh.vertices_m.emplace_back(p.x() - part.front().x(), p.y() - part.front().y(), z);
    }
    prism.shape = std::move(mesh);
    // What is too thin to be a solid lies between others.
    if (validate(prism)) obstacles.push_back(std::move(prism));
  }
}

/// nullptr if the obstacles fit no World.
std::shared_ptr<const World> WorldKeeper::build(double turn_margin_m) const {
  std::vector<Obstacle> obstacles;
  for (const auto& [id, obstacle] : obstacles_) {
    obstacles.push_back(obstacle);
    if (obstacle.moves()) obstacles.back().margin_m += turn_margin_m;
  }
  add_no_fly(obstacles);
  Bounds bounds = bounds_;
  if (!no_fly_.empty()) bounds.max_m.z() = std::min(bounds.max_m.z(), highest_m_ + kNoFlyTop_m);
  auto made = World::make(*terrain_, std::move(obstacles), bounds, terrain_revision_, obstacle_revision_);
  return made ? std::move(made).value() : nullptr;
}

std::shared_ptr<const World> WorldKeeper::world() {
  if (!stale_) return world_;
  if (has_terrain_ && !map_is_complete()) return world_;
  if (!build_terrain()) return world_;
  if (auto made = build(turn_margin_m_)) {
    world_ = std::move(made);
    stale_ = false;
  }
  return world_;
}

std::shared_ptr<const World> WorldKeeper::world_without_turns() {
  if (turn_margin_m_ == 0.0 || stale_) return world();
  return build(0.0);
}

}  // namespace swallowtail::planner
