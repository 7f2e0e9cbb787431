#include "coverage/ground/road_file.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace swallowtail::coverage {
namespace {

using Lines = std::vector<std::vector<Vec2>>;

constexpr double kMaxDistance_m = 2e5;

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};

void add_lines(const OGRGeometry& geometry, Lines& out) {
  const auto type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbLineString) {
    const OGRLineString& line = *geometry.toLineString();
    std::vector<Vec2>& points = out.emplace_back();
    for (int i = 0; i < line.getNumPoints(); ++i) points.emplace_back(line.getX(i), line.getY(i));
  } else if (type == wkbMultiLineString || type == wkbGeometryCollection) {
    const OGRGeometryCollection& parts = *geometry.toGeometryCollection();
    for (int i = 0; i < parts.getNumGeometries(); ++i) add_lines(*parts.getGeometryRef(i), out);
  }
}

bool is_beyond_degrees(const Lines& lines) {
  return std::any_of(lines.begin(), lines.end(), [](const auto& line) {
    return std::any_of(line.begin(), line.end(),
                       [](const Vec2& p) { return std::abs(p.x()) > 180.0 || std::abs(p.y()) > 90.0; });
  });
}

/// A layer's lines, and whether they are in local metres.
bool read_lines(OGRLayer& layer, Lines& out) {
  const OGRSpatialReference* reference = layer.GetSpatialRef();
  bool is_local = reference == nullptr || reference->IsLocal() != 0;
  for (auto& feature : layer) {
    const int crs = feature->GetFieldIndex("crs");
    if (crs >= 0 && std::string(feature->GetFieldAsString(crs)) == "local metres") is_local = true;
    if (const OGRGeometry* geometry = feature->GetGeometryRef()) add_lines(*geometry, out);
  }
  const bool projected = reference != nullptr && reference->IsProjected() != 0;
  return is_local || (!projected && is_beyond_degrees(out));
}

Status project(const OGRSpatialReference& reference, const std::optional<planner::GeoOrigin>& origin,
               Lines& lines) {
  if (!origin)
    return bad_input("its roads are on Earth, and there is no origin to bring them into the local frame.");
  OGRSpatialReference target;
  target.SetWellKnownGeogCS("WGS84");
  target.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRSpatialReference source(reference);
  source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> to_wgs84(
      OGRCreateCoordinateTransformation(&source, &target));
  if (!to_wgs84) return bad_input("its projection cannot be brought to WGS 84.");
  for (std::vector<Vec2>& line : lines) {
    for (Vec2& p : line) {
      if (to_wgs84->Transform(1, &p.x(), &p.y()) == 0)
        return bad_input("a vertex cannot be brought to WGS 84.");
      const Result<Vec2> local = planner::to_local(*origin, p.y(), p.x());
      if (!local) return local.error();
      if (local->norm() > kMaxDistance_m) return bad_input("a vertex lies more than 200 km from the origin.");
      p = *local;
    }
  }
  return {};
}

Result<Lines> read(const std::string& path, const std::optional<planner::GeoOrigin>& origin) {
  const std::unique_ptr<GDALDataset, CloseDataset> dataset(static_cast<GDALDataset*>(
      GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr)));
  if (!dataset) return bad_input("'" + path + "' is not a vector file that GDAL can read.");
  Lines out;
  for (OGRLayer* layer : dataset->GetLayers()) {
    Lines lines;
    if (!read_lines(*layer, lines) && !lines.empty()) {
      if (const Status status = project(*layer->GetSpatialRef(), origin, lines); !status)
        return Error{status.error().code, "'" + path + "': " + status.error().message};
    }
    out.insert(out.end(), lines.begin(), lines.end());
  }
  if (out.empty()) return bad_input("'" + path + "' holds no line.");
  return out;
}

}  // namespace

Result<Lines> read_roads(const std::string& path, const std::optional<planner::GeoOrigin>& origin) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return not_found("There is no file '" + path + "'.");
  GDALAllRegister();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  Result<Lines> out = read(path, origin);
  CPLPopErrorHandler();
  return out;
}

}  // namespace swallowtail::coverage
