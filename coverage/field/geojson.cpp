#include "coverage/field/geojson.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>

#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kMaxDistance_m =
    2e5;  ///< of a vertex from the origin: beyond, the local frame is no longer true to scale

struct Dataset {
  struct Close {
    void operator()(GDALDataset* d) const { GDALClose(d); }
  };
  std::unique_ptr<GDALDataset, Close> owner;
};

struct RawField {
  std::string name;
  std::string height_class;
  std::optional<double> height_m;
  Polygon polygon;  ///< (lon, lat) or metres
};

struct RawFile {
  std::vector<RawField> fields;
  bool is_local = false;
};

Ring read_ring(const OGRLinearRing& ring) {
  Ring out;
  for (int i = 0; i < ring.getNumPoints(); ++i) out.emplace_back(ring.getX(i), ring.getY(i));
  if (out.size() > 1 && out.front() == out.back()) out.pop_back();
  return out;
}

void add_polygons(const OGRGeometry& geometry, const RawField& like, std::vector<RawField>& out) {
  const auto type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon) {
    const OGRPolygon& polygon = *geometry.toPolygon();
    if (polygon.getExteriorRing() == nullptr) return;
    RawField field = like;
    field.polygon.outline = read_ring(*polygon.getExteriorRing());
    for (int i = 0; i < polygon.getNumInteriorRings(); ++i)
      field.polygon.holes.push_back(read_ring(*polygon.getInteriorRing(i)));
    out.push_back(std::move(field));
  } else if (type == wkbMultiPolygon || type == wkbGeometryCollection) {
    const OGRGeometryCollection& parts = *geometry.toGeometryCollection();
    for (int i = 0; i < parts.getNumGeometries(); ++i) {
      RawField part = like;
      if (parts.getNumGeometries() > 1) part.name += "/" + std::to_string(i);
      add_polygons(*parts.getGeometryRef(i), part, out);
    }
  }
}

RawField read_properties(const OGRFeature& feature, bool& says_local) {
  RawField out;
  const auto text = [&](const char* key) -> std::optional<std::string> {
    const int index = feature.GetFieldIndex(key);
    if (index < 0 || !feature.IsFieldSetAndNotNull(index)) return std::nullopt;
    return feature.GetFieldAsString(index);
  };
  out.name = text("id").value_or(text("name").value_or("field-" + std::to_string(feature.GetFID())));
  out.height_class = text("class").value_or("");
  if (text("height_m")) out.height_m = feature.GetFieldAsDouble(feature.GetFieldIndex("height_m"));
  if (text("crs").value_or("") == "local metres") says_local = true;
  return out;
}

/// To (lon, lat); none when the layer is geographic already or says nothing.
Result<std::unique_ptr<OGRCoordinateTransformation>> to_wgs84(const OGRSpatialReference* from) {
  if (from == nullptr) return std::unique_ptr<OGRCoordinateTransformation>();
  OGRSpatialReference target;
  target.SetWellKnownGeogCS("WGS84");
  target.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  OGRSpatialReference source(*from);
  source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (source.IsSame(&target) != 0) return std::unique_ptr<OGRCoordinateTransformation>();
  std::unique_ptr<OGRCoordinateTransformation> transformation(
      OGRCreateCoordinateTransformation(&source, &target));
  if (!transformation) return bad_input("The file's projection cannot be brought to WGS 84.");
  return transformation;
}

bool beyond_degrees(const std::vector<RawField>& fields, std::size_t first) {
  return std::any_of(
      fields.begin() + static_cast<std::ptrdiff_t>(first), fields.end(), [](const RawField& field) {
        return std::any_of(field.polygon.outline.begin(), field.polygon.outline.end(),
                           [](const Vec2& p) { return std::abs(p.x()) > 180.0 || std::abs(p.y()) > 90.0; });
      });
}

Status read_layer(OGRLayer& layer, RawFile& out) {
  const std::size_t first = out.fields.size();
  const OGRSpatialReference* reference = layer.GetSpatialRef();
  bool says_local = reference != nullptr && reference->IsLocal() != 0;
  for (auto& feature : layer) {
    const RawField like = read_properties(*feature, says_local);
    if (feature->GetGeometryRef() != nullptr) add_polygons(*feature->GetGeometryRef(), like, out.fields);
    if (out.fields.size() > kMaxFileFields) return bad_input("The file holds more than 10000 polygons.");
  }
  const bool geographic = reference != nullptr && reference->IsGeographic() != 0;
  const bool projected = reference != nullptr && reference->IsProjected() != 0;
  if (says_local ||
      (!projected && (beyond_degrees(out.fields, first) || (reference == nullptr && !geographic)))) {
    out.is_local = true;
    return {};
  }
  auto transformation = to_wgs84(reference);
  if (!transformation) return transformation.error();
  if (*transformation == nullptr) return {};
  const auto project = [&](Ring& ring) {
    return std::all_of(ring.begin(), ring.end(),
                       [&](Vec2& p) { return (*transformation)->Transform(1, &p.x(), &p.y()) != 0; });
  };
  for (std::size_t i = first; i < out.fields.size(); ++i) {
    Polygon& polygon = out.fields[i].polygon;
    const bool good =
        project(polygon.outline) && std::all_of(polygon.holes.begin(), polygon.holes.end(), project);
    if (!good) return bad_input("Field '" + out.fields[i].name + "' cannot be brought to WGS 84.");
  }
  return {};
}

Result<RawFile> read_raw(const std::string& path) {
  GDALAllRegister();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  const Dataset dataset{decltype(Dataset::owner)(static_cast<GDALDataset*>(
      GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr)))};
  RawFile out;
  Status status;
  if (dataset.owner) {
    for (OGRLayer* layer : dataset.owner->GetLayers()) {
      if (status.ok()) status = read_layer(*layer, out);
    }
  }
  CPLPopErrorHandler();
  if (!dataset.owner) return bad_input("'" + path + "' is not a vector file that GDAL can read.");
  if (!status) return Error{status.error().code, "'" + path + "': " + status.error().message};
  if (out.fields.empty()) return bad_input("'" + path + "' holds no polygon.");
  return out;
}

planner::GeoOrigin middle_of(std::span<const RawField> fields) {
  Box box{fields.front().polygon.outline.front(), fields.front().polygon.outline.front()};
  for (const RawField& field : fields) {
    for (const Vec2& p : field.polygon.outline) {
      box.lo = box.lo.cwiseMin(p);
      box.hi = box.hi.cwiseMax(p);
    }
  }
  const Vec2 middle = (box.lo + box.hi) / 2.0;
  return {middle.y(), middle.x(), 0.0};
}

Status to_local(Ring& ring, const planner::GeoOrigin& origin) {
  for (Vec2& p : ring) {
    if (!is_finite(p)) continue;  // left for clean() to name
    const Result<Vec2> local = planner::to_local(origin, p.y(), p.x());
    if (!local) return local.error();
    if (local->norm() > kMaxDistance_m)
      return bad_input("A vertex lies more than 200 km from the origin of the local frame.");
    p = *local;
  }
  return {};
}

Status to_local(Polygon& polygon, const planner::GeoOrigin& origin) {
  Status status = to_local(polygon.outline, origin);
  for (Ring& hole : polygon.holes) {
    if (status.ok()) status = to_local(hole, origin);
  }
  return status;
}

Result<double> height_of(const RawField& field, const FieldFileOptions& options) {
  double height = options.default_height_m;
  const auto known = options.class_heights_m.find(field.height_class);
  if (known != options.class_heights_m.end()) height = known->second;
  if (field.height_m) height = *field.height_m;
  if (!is_positive(height))
    return bad_input("Field '" + field.name + "' has a height_m of " + std::to_string(height) +
                     "; it must be positive.");
  return height;
}

}  // namespace

Result<FieldFile> read_fields(const std::string& path, const FieldFileOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return not_found("There is no file '" + path + "'.");
  Result<RawFile> raw = read_raw(path);
  if (!raw) return raw.error();
  FieldFile out;
  std::erase_if(raw->fields, [](const RawField& field) { return field.polygon.outline.empty(); });
  if (raw->fields.empty()) return bad_input("'" + path + "' holds no polygon.");
  const bool shares = options.frame == FieldFrame::kShared;
  if (!raw->is_local && shares) out.origin = options.origin ? *options.origin : middle_of(raw->fields);
  for (RawField& field : raw->fields) {
    const Result<double> height = height_of(field, options);
    if (!height) return height.error();
    if (!raw->is_local) {
      if (!shares) out.origins.push_back(middle_of({&field, 1}));
      const Status status = to_local(field.polygon, shares ? *out.origin : out.origins.back());
      if (!status)
        return Error{status.error().code,
                     "'" + path + "', field '" + field.name + "': " + status.error().message};
    }
    out.fields.push_back(
        {static_cast<std::uint32_t>(out.fields.size() + 1), field.name, std::move(field.polygon), *height});
  }
  return out;
}

}  // namespace swallowtail::coverage
