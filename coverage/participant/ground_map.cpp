#include "coverage/participant/ground_map.hpp"

#include <algorithm>

namespace swallowtail::coverage {
namespace {

constexpr std::uint64_t kMaxSamples = 50'000'000;

}  // namespace

Status GroundMap::put(const data::TerrainTile& tile) {
  if (tile.map_id != kMapId) return {};
  const std::uint64_t samples = static_cast<std::uint64_t>(tile.map_rows) * tile.map_cols;
  if (tile.map_rows < 2 || tile.map_cols < 2 || samples > kMaxSamples)
    return bad_input("The terrain map has too few or too many samples.");
  const bool fits = tile.first_row + static_cast<std::uint64_t>(tile.tile_rows) <= tile.map_rows &&
                    tile.first_col + static_cast<std::uint64_t>(tile.tile_cols) <= tile.map_cols &&
                    tile.elevation_m.size() == static_cast<std::size_t>(tile.tile_rows) * tile.tile_cols;
  if (!fits) return bad_input("The terrain tile does not fit its map.");
  const Vec2 origin(tile.origin_x_m, tile.origin_y_m);
  const bool same = grid_.rows == static_cast<int>(tile.map_rows) &&
                    grid_.cols == static_cast<int>(tile.map_cols) && grid_.cell_size_m == tile.cell_size_m &&
                    grid_.origin_m == origin;
  if (!same) {
    grid_ = {origin, tile.cell_size_m, static_cast<int>(tile.map_rows), static_cast<int>(tile.map_cols), {}};
    grid_.elevation_m.assign(samples, 0.0F);
    filled_.assign(samples, 0);
    missing_ = samples;
    revisions_.clear();
  }
  const auto known = revisions_.find({tile.row, tile.col});
  if (known != revisions_.end() && known->second >= tile.revision) return {};
  revisions_[{tile.row, tile.col}] = tile.revision;
  for (std::uint32_t r = 0; r < tile.tile_rows; ++r) {
    for (std::uint32_t c = 0; c < tile.tile_cols; ++c) {
      const std::size_t at =
          static_cast<std::size_t>(tile.first_row + r) * tile.map_cols + tile.first_col + c;
      grid_.elevation_m[at] = tile.elevation_m[static_cast<std::size_t>(r) * tile.tile_cols + c];
      if (filled_[at] == 0) --missing_;
      filled_[at] = 1;
    }
  }
  revision_ = std::max(revision_, tile.revision);
  if (complete()) changed_ = true;
  return {};
}

}  // namespace swallowtail::coverage
