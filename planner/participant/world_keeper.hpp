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
  /// Convex polygons that no path enters: prisms from below the ground to kNoFlyTop_m above its highest
  /// point, which paths stay below then. Of the vehicle's radius and margin `relief_m` need not be kept from
  /// them. Their ids go down from the greatest there is.
  void set_no_fly(std::vector<std::vector<Vec2>> parts, double relief_m);
  /// Kept from obstacles that move besides their own margins.
  void set_turn_margin(double margin_m);
  /// With terrain there is no World before its tiles are complete; without it the ground is at z = 0.
  void set_has_terrain(bool has_terrain);

  /// The newest World; nullptr while there is none. Built when something has changed.
  std::shared_ptr<const World> world();
  /// The same with no more kept from obstacles that move than the margins stated for them.
  std::shared_ptr<const World> world_without_turns();
  /// The World last built by `world`.
  const std::shared_ptr<const World>& world_now() const { return world_; }
  /// True once after each change.
  bool take_changed() { return std::exchange(changed_, false); }
  std::uint32_t obstacle_revision() const { return obstacle_revision_; }
  std::uint32_t terrain_revision() const { return terrain_revision_; }

  static constexpr std::uint32_t kMapId = 1;
  static constexpr double kNoFlyTop_m = 1000.0;

 private:
  bool map_is_complete() const { return !grid_.elevation_m.empty() && missing_ == 0; }
  bool build_terrain();
  std::shared_ptr<const World> build(double turn_margin_m) const;
  void add_no_fly(std::vector<Obstacle>& obstacles) const;

  std::map<std::uint32_t, Obstacle> obstacles_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> tile_revisions_;
  TerrainGrid grid_;
  std::vector<bool> filled_;
  std::size_t missing_ = 0;
  bool has_terrain_ = false;
  std::optional<Terrain> terrain_;
  double lowest_m_ = 0.0;  ///< of the terrain
  double highest_m_ = 0.0;
  std::vector<std::vector<Vec2>> no_fly_;
  double no_fly_relief_m_ = 0.0;
  double turn_margin_m_ = 0.0;
  Bounds bounds_;
  std::uint32_t obstacle_revision_ = 0;
  std::uint32_t terrain_revision_ = 0;
  bool changed_ = true;
  bool stale_ = true;
  std::shared_ptr<const World> world_;
};

}  // namespace swallowtail::planner
