#include "planner/world/detail/projection.hpp"

#include <cpl_error.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include "planner/base/checks.hpp"

namespace swallowtail::planner {
namespace detail {

void TransformDeleter::operator()(OGRCoordinateTransformation* transform) const {
  OGRCoordinateTransformation::DestroyCT(transform);
}

QuietGdal::QuietGdal() {
  CPLErrorReset();
  CPLPushErrorHandler(CPLQuietErrorHandler);
}
QuietGdal::~QuietGdal() { CPLPopErrorHandler(); }

std::string last_gdal_message() {
  const std::string message = CPLGetLastErrorMsg();
  return message.empty() ? "no reason given" : message;
}

Status validate(const GeoOrigin& origin) {
  if (!is_within(origin.lat_deg, -90.0, 90.0) || !is_within(origin.lon_deg, -180.0, 180.0) ||
      !is_within(origin.elevation_m, -1e4, 1e4)) {
    return bad_input(fmt::format("The origin ({}°, {}°, {} m) must lie within ±90°, ±180° and ±10000 m.",
                                 origin.lat_deg, origin.lon_deg, origin.elevation_m));
  }
  return {};
}

OGRSpatialReference wgs84() {
  OGRSpatialReference reference;
  reference.SetWellKnownGeogCS("WGS84");
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

Result<OGRSpatialReference> local_frame(const GeoOrigin& origin) {
  if (Status status = validate(origin); !status) return status.error();
  OGRSpatialReference reference;
  reference.SetProjCS("local east-north");
  reference.SetWellKnownGeogCS("WGS84");
  if (reference.SetTM(origin.lat_deg, origin.lon_deg, 1.0, 0.0, 0.0) != OGRERR_NONE) {
    return internal_error("GDAL cannot make a transverse Mercator projection: " + last_gdal_message() + ".");
  }
  reference.SetLinearUnits(SRS_UL_METER, 1.0);
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

Result<Transform> make_transform(const OGRSpatialReference& from, const OGRSpatialReference& to) {
  Transform transform(OGRCreateCoordinateTransformation(&from, &to));
  if (!transform)
    return bad_input("GDAL cannot convert between these coordinate systems: " + last_gdal_message() + ".");
  return transform;
}

}  // namespace detail

namespace {

Result<Vec2> project(const GeoOrigin& origin, bool to_local_frame, Vec2 at) {
  const detail::QuietGdal quiet;
  auto frame = detail::local_frame(origin);
  if (!frame) return frame.error();
  const OGRSpatialReference geodetic = detail::wgs84();
  auto transform =
      to_local_frame ? detail::make_transform(geodetic, *frame) : detail::make_transform(*frame, geodetic);
  if (!transform) return transform.error();
  const Vec2 asked = at;
  if (!(*transform)->Transform(1, &at.x(), &at.y()) || !is_finite(at)) {
    return bad_input(fmt::format("The position ({}, {}) cannot be projected around the origin ({}°, {}°).",
                                 asked.x(), asked.y(), origin.lat_deg, origin.lon_deg));
  }
  return at;
}

}  // namespace

Result<Vec2> to_local(const GeoOrigin& origin, double lat_deg, double lon_deg) {
  if (!is_within(lat_deg, -90.0, 90.0) || !is_within(lon_deg, -180.0, 180.0)) {
    return bad_input(
        fmt::format("The position ({}°, {}°) must lie within ±90° and ±180°.", lat_deg, lon_deg));
  }
  return project(origin, true, Vec2(lon_deg, lat_deg));
}

Result<Vec2> to_geodetic(const GeoOrigin& origin, const Vec2& local_m) {
  if (!is_finite(local_m)) return bad_input("The local position is not finite.");
  auto geodetic = project(origin, false, local_m);
  if (!geodetic) return geodetic;
  return Vec2(geodetic->y(), geodetic->x());
}

}  // namespace swallowtail::planner
