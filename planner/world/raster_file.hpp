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
  /// With an origin the raster is projected into the local frame around it; without one it keeps its own metres, its south-west sample at (0, 0).
  std::optional<GeoOrigin> origin;
  /// What stands where the file has no data. Without it a gap is an error.
  std::optional<double> no_data_elevation_m;
  double max_samples = 5e7;
};

/// Reads a GeoTIFF or any other raster that GDAL knows, in any projection that it knows. Elevations are metres; with an origin its elevation is subtracted.
Result<Terrain> read_terrain(const std::string& path, const RasterOptions& options);

/// Writes a single-band Float32 GeoTIFF in local metres (no projection), or around `origin` in a transverse Mercator projection centred there.
Status write_terrain(const std::string& path, const TerrainGrid& grid, const std::optional<GeoOrigin>& origin);

/// Local east-north-up metres of a geodetic position, and back, by an azimuthal projection around the origin that is exact at it (transverse Mercator on WGS 84, scale 1).
Result<Vec2> to_local(const GeoOrigin& origin, double lat_deg, double lon_deg);
Result<Vec2> to_geodetic(const GeoOrigin& origin, const Vec2& local_m);  ///< (lat_deg, lon_deg)

}  // namespace swallowtail::planner
