#pragma once

#include <optional>
#include <string>

#include "planner/world/terrain.hpp"

namespace swallowtail::planner {

/// A geodetic origin of the local east-north-up frame.
struct GeoOrigin {
  double lat_deg = 0.0;
  double lon_deg = 0.0;
  double elevation_m = 0.0;
};

struct RasterOptions {
  /// With an origin the raster is resampled (bilinearly, cells no larger than the file's) onto the local
  /// frame around it; without one it keeps its own metres, its south-west sample at (0, 0).
  std::optional<GeoOrigin> origin;
  /// What stands where the file has no data, in the file's own elevations. Without it a gap is an error that
  /// names the count.
  std::optional<double> no_data_elevation_m;
  /// Of the file and of what it becomes.
  double max_samples = 5e7;
};

/// Reads the first band of a GeoTIFF or any other raster file that GDAL knows, in any projection that it
/// knows. Band scale, offset and feet are applied; with an origin its elevation is subtracted. No data is
/// what the file's mask says and whatever is not finite. A resampled raster is the rectangle around the
/// file's outline; where that is turned, its corners continue the file's edge. Resampling may lower a peak by
/// up to half a cell times the slope beside it: leave that much margin, or plan in the file's own metres.
/// Errors name the file: not a regular file, not a raster, too large, gaps, no georeference; without an
/// origin also degrees, units other than metres, rotation and cells that are not square; with an origin also
/// no coordinate system, and a raster farther than 300 km from it.
Result<Terrain> read_terrain(const std::string& path, const RasterOptions& options);

/// Writes a single-band Float32 GeoTIFF in local metres (no projection), or around `origin` in a transverse
/// Mercator projection centred there with the origin's elevation added. An existing file is replaced.
Status write_terrain(const std::string& path, const TerrainGrid& grid,
                     const std::optional<GeoOrigin>& origin);

/// Local east-north metres of a geodetic position, and back: transverse Mercator on WGS 84 with its centre at
/// the origin and scale 1, so exact there and along its meridian; lengths grow by x²/2R² to the side (1 mm
/// per km at 9 km). Errors: an origin or position out of range, or too far from the origin to project.
Result<Vec2> to_local(const GeoOrigin& origin, double lat_deg, double lon_deg);
Result<Vec2> to_geodetic(const GeoOrigin& origin, const Vec2& local_m);  ///< (lat_deg, lon_deg)

}  // namespace swallowtail::planner
