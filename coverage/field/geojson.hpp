#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coverage/field/sub_cells.hpp"
#include "planner/world/raster_file.hpp"

namespace swallowtail::coverage {

/// Whether the file's fields share one local frame, or each has its own around its middle (fields too far
/// apart for one mission).
enum class FieldFrame { kShared, kPerField };

struct FieldFileOptions {
  FieldFrame frame = FieldFrame::kShared;
  /// Of the local frame; without it the middle of the file's extent (elevation 0). Not used by files in local
  /// metres.
  std::optional<planner::GeoOrigin> origin{};
  double default_height_m = 20.0;
  /// Height above ground by the value of the property `class`. A property `height_m` wins over it.
  std::map<std::string, double> class_heights_m{};
  std::string no_fly_file{};  ///< every polygon of it is a no-fly area; empty: none
};

struct FieldFile {
  std::vector<Field> fields;  ///< ids 1 … n in the file's order; names from the property or feature id
  std::optional<planner::GeoOrigin>
      origin{};  ///< of the frame the fields share; none: local metres, or a frame per field
  std::vector<planner::GeoOrigin> origins;  ///< one per field with FieldFrame::kPerField, else empty
  /// Polygons neither to cover nor to cross: of features whose property `no_fly` is true or whose `class` is
  /// "no-fly", and of no_fly_file. One list, or one per field in its own frame with FieldFrame::kPerField
  /// (areas that come no nearer than 20 km left out).
  std::vector<std::vector<Polygon>> no_fly{};
};

inline constexpr std::size_t kMaxFileFields = 10'000;

/// Reads every polygon of a GeoJSON, KML, Shapefile (also zipped) or any other vector file that GDAL knows,
/// or of a .wkt file (one geometry a line, "SRID=number;" before it where it is not WGS 84). A multi-polygon
/// is several fields, named name/0, name/1 … Coordinates are taken as local metres when the file says so (a
/// property `crs` of "local metres", or a projection of type local/engineering), when it names no
/// coordinate system, or when they lie beyond degrees although the system is in degrees; else they are
/// projected into the local frame. Polygons are not cleaned here, and empty ones kept, so that one bad field
/// does not spoil a file: cut_field refuses it. Errors (kNotFound): no such file. (kBadInput): not a vector
/// file, no polygon in it, no coordinate system although the coordinates seem to be degrees or lie beyond 1e6
/// m, fields of one file in local metres and on Earth, a height that is not positive, too many fields,
/// coordinates far from the origin, of no-fly areas that come near too.
Result<FieldFile> read_fields(const std::string& path, const FieldFileOptions& options);

}  // namespace swallowtail::coverage
