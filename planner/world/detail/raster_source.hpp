#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/world/raster_file.hpp"

class OGRSpatialReference;

/// Raster files through GDAL, whose headers stay in the .cpp files.
namespace swallowtail::planner::detail {

/// pixel (column, row; centres at half-integers) to georeferenced place: x = g0 + g1·c + g2·r, y = g3 + g4·c
/// + g5·r.
struct GeoTransform {
  double g[6] = {0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  Vec2 place(double col, double row) const {
    return {g[0] + g[1] * col + g[2] * row, g[3] + g[4] * col + g[5] * row};
  }
  double determinant() const { return g[1] * g[5] - g[2] * g[4]; }
  Vec2 pixel(const Vec2& place) const {
    const double x = place.x() - g[0];
    const double y = place.y() - g[3];
    return Vec2(g[5] * x - g[2] * y, g[1] * y - g[4] * x) / determinant();
  }
};

/// A raster file as read: rows from the top of the file, every gap filled.
struct RasterSource {
  int rows = 0;
  int cols = 0;
  std::vector<float> elevation_m;
  GeoTransform transform;
  std::shared_ptr<const OGRSpatialReference> reference;  ///< nullptr where the file names none

  /// Bilinear at (column, row) counted between sample centres; the edge is continued.
  double at(double col, double row) const;
};

Result<RasterSource> read_source(const std::string& path, const RasterOptions& options);

/// The file's own metres, south-west sample at (0, 0).
Result<TerrainGrid> as_own_metres(const std::string& path, const RasterSource& source);
/// Resampled onto the local frame around origin.
Result<TerrainGrid> as_local(const std::string& path, const RasterSource& source, const GeoOrigin& origin,
                             double max_samples);

}  // namespace swallowtail::planner::detail
