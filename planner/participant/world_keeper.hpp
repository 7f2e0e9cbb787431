#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "idl/data/types.hpp"
#include "planner/base/result.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::planner {

/// Gathers terrain tiles and obstacles from the wire into one World after the other.
class WorldKeeper {
 public:
  /// Tiles of other maps than kMapId are ignored; older revisions of a tile too. Errors: a tile that does not
  /// fit the map of the tiles before it. A tile of another map size or cell begins the map anew.
  Status put(const data::TerrainTile& tile);
  /// Errors: an obstacle that the planner cannot use.
  Status put(const data::Obstacle& obstacle);
  void remove_obstacle(std::uint32_t id);
  void set_bounds(const Bounds& bounds);
  /// With terrain there is no World before its tiles are complete; without it the ground is at z = 0.
  void set_has_terrain(bool has_terrain);

  /// The newest World; nullptr while there is none. Built when something has changed.
  std::shared_ptr<const World> world();
  /// The World last built.
  const std::shared_ptr<const World>& world_now() const { return world_; }
  /// True once after each change.
  bool take_changed() { return std::exchange(changed_, false); }
  std::uint32_t obstacle_revision() const { return obstacle_revision_; }
  std::uint32_t terrain_revision() const { return terrain_revision_; }

  static constexpr std::uint32_t kMapId = 1;

 private:
  bool map_is_complete() const { return !grid_.elevation_m.empty() && missing_ == 0; }

  std::map<std::uint32_t, Obstacle> obstacles_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> tile_revisions_;
  TerrainGrid grid_;
  std::vector<bool> filled_;
  std::size_t missing_ = 0;
  bool has_terrain_ = false;
  std::optional<Terrain> terrain_;
  Bounds bounds_;
  std::uint32_t obstacle_revision_ = 0;
  std::uint32_t terrain_revision_ = 0;
  bool changed_ = true;
  bool stale_ = true;
  std::shared_ptr<const World> world_;
};

}  // namespace swallowtail::planner
