#pragma once

#include <memory>
#include <string>

#include "planner/base/result.hpp"
#include "planner/world/raster_file.hpp"

class OGRCoordinateTransformation;
class OGRSpatialReference;

/// Coordinate systems through GDAL, whose headers stay in the .cpp files.
namespace swallowtail::planner::detail {

struct TransformDeleter {
  void operator()(OGRCoordinateTransformation* transform) const;
};
using Transform = std::unique_ptr<OGRCoordinateTransformation, TransformDeleter>;

/// Keeps GDAL's messages off stderr while it lives; what it said last is in last_gdal_message().
class QuietGdal {
 public:
  QuietGdal();
  ~QuietGdal();
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};
std::string last_gdal_message();

Status validate(const GeoOrigin& origin);
/// The local frame of `origin`: transverse Mercator on WGS 84, scale 1, in metres.
Result<OGRSpatialReference> local_frame(const GeoOrigin& origin);
OGRSpatialReference wgs84();
Result<Transform> make_transform(const OGRSpatialReference& from, const OGRSpatialReference& to);

}  // namespace swallowtail::planner::detail
