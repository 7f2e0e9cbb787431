#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "coverage/field/sub_cells.hpp"
#include "planner/base/vec.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::sim {

struct SwathParams {
  double sensor_width_m = 10.0;
  double height_tolerance_m = 2.0;
  double finest_cell_m = 0.5;         ///< cells are at most this size unless there would be too many of them
  std::size_t max_cells = 2'000'000;  ///< over all fields
  std::vector<coverage::Polygon> no_fly{};  ///< not asked for
  double skipped_border_m = 0.0;            ///< nor what is nearer to a field's border
};

/// Which part of the fields has been seen from the required height: one raster per field, a cell counts when
/// its centre lies in the field, outside no-fly areas and the skipped border, and has been under the swath.
class CoverageRaster {
 public:
  CoverageRaster(std::span<const coverage::Field> fields, const planner::Terrain& terrain,
                 const SwathParams& params);

  /// Stamps the swath of a straight flight: half a sensor width to each side, nothing beyond the ends, on
  /// fields whose height above ground is kept at both ends.
  void stamp(const Vec3& from_m, const Vec3& to_m);

  /// Of all cells within fields, 0 … 100.
  double covered_percent() const;
  double cell_size_m() const { return cell_m_; }
  std::size_t cells() const;

 private:
  enum Cell : std::uint8_t { kOutside, kOpen, kSeen };

  struct Raster {
    Vec2 origin_m = Vec2::Zero();  ///< centre of cell (0, 0)
    std::size_t rows = 0;
    std::size_t cols = 0;
    double height_m = 0.0;
    std::vector<Cell> cells{};
  };

  void add_field(const coverage::Field& field);
  void mark(Raster& raster, const coverage::Polygon& polygon, Cell as) const;
  void skip_border(Raster& raster, const coverage::Polygon& polygon) const;
  void stamp(Raster& raster, const Vec2& from_m, const Vec2& to_m);

  planner::Terrain terrain_;
  SwathParams params_;
  double cell_m_ = 1.0;
  std::vector<Raster> rasters_;
  std::size_t inside_ = 0;
  std::size_t seen_ = 0;
};

}  // namespace swallowtail::sim
