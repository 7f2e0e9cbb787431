#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "idl/data/types.hpp"
#include "planner/base/result.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::coverage {

/// Puts the tiles of terrain map 1 together. Tiles of another size of map begin it anew; older revisions of a
/// tile are ignored.
class GroundMap {
 public:
  static constexpr std::uint32_t kMapId = 1;

  /// Errors (kBadInput): a tile that does not fit the map it claims to be of.
  Status put(const data::TerrainTile& tile);
  bool complete() const { return missing_ == 0 && !grid_.elevation_m.empty(); }
  /// True once after each change that left it complete.
  bool take_changed() { return std::exchange(changed_, false); }
  /// Of a complete map. Errors: see Terrain::from_grid.
  Result<planner::Terrain> terrain() const { return planner::Terrain::from_grid(grid_); }
  std::uint32_t revision() const { return revision_; }

 private:
  planner::TerrainGrid grid_;
  std::vector<char> filled_;
  std::size_t missing_ = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> revisions_;
  std::uint32_t revision_ = 0;
  bool changed_ = false;
};

}  // namespace swallowtail::coverage
