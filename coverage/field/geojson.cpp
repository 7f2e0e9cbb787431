#include "coverage/field/geojson.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <span>

#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kMaxDistance_m =
    2e5;  ///< of a vertex from the origin: beyond, the local frame is no longer true to scale
constexpr double kNoFlyDistance_m = 2e4;

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
  bool no_fly = false;
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
    RawField field = like;
    if (polygon.getExteriorRing() == nullptr) {
      out.push_back(std::move(field));  // empty: left for clean() to name
      return;
    }
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
  const std::string no_fly = text("no_fly").value_or("");
  out.no_fly = no_fly == "1" || no_fly == "true" || out.height_class == "no-fly";
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

/// Brings the fields from `first` on to degrees, or takes them as local metres.
Status settle_frame(const OGRSpatialReference* reference, bool says_local, std::size_t first, RawFile& out) {
  const bool projected = reference != nullptr && reference->IsProjected() != 0;
  if (says_local || (!projected && (beyond_degrees(out.fields, first) || reference == nullptr))) {
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

Status read_layer(OGRLayer& layer, RawFile& out) {
  const std::size_t first = out.fields.size();
  const OGRSpatialReference* reference = layer.GetSpatialRef();
  bool says_local = reference != nullptr && reference->IsLocal() != 0;
  for (auto& feature : layer) {
    const RawField like = read_properties(*feature, says_local);
    if (feature->GetGeometryRef() == nullptr) {
      out.fields.push_back(like);  // empty: left for clean() to name
    } else {
      add_polygons(*feature->GetGeometryRef(), like, out.fields);
    }
    if (out.fields.size() > kMaxFileFields) return bad_input("The file holds more than 10000 polygons.");
  }
  return settle_frame(reference, says_local, first, out);
}

/// A geometry a line, "SRID=number;" before it where it is not WGS 84.
Result<RawFile> read_wkt(const std::string& path) {
  std::ifstream stream(path);
  RawFile out;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string where = "'" + path + "', line " + std::to_string(number) + ": ";
    OGRSpatialReference reference;
    reference.SetWellKnownGeogCS("WGS84");
    std::size_t begin = 0;
    if (line.rfind("SRID=", 0) == 0) {
      begin = line.find(';');
      if (begin == std::string::npos || reference.importFromEPSG(std::atoi(line.c_str() + 5)) != OGRERR_NONE)
        return bad_input(where + "the SRID is not known.");
      ++begin;
    }
    OGRGeometry* geometry = nullptr;
    const OGRErr error = OGRGeometryFactory::createFromWkt(line.c_str() + begin, nullptr, &geometry);
    const std::unique_ptr<OGRGeometry> owned(geometry);
    if (error != OGRERR_NONE || !owned) return bad_input(where + "is not a geometry in WKT.");
    const std::size_t first = out.fields.size();
    RawField like;
    like.name = "line-" + std::to_string(number);
    add_polygons(*owned, like, out.fields);
    if (out.fields.size() > kMaxFileFields) return bad_input(where + "more than 10000 polygons.");
    if (const Status status = settle_frame(&reference, false, first, out); !status)
      return bad_input(where + status.error().message);
  }
  return out;
}

Result<RawFile> read_vector(const std::string& path) {
  const Dataset dataset{decltype(Dataset::owner)(static_cast<GDALDataset*>(
      GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr)))};
  if (!dataset.owner) return bad_input("'" + path + "' is not a vector file that GDAL can read.");
  RawFile out;
  for (OGRLayer* layer : dataset.owner->GetLayers()) {
    if (const Status status = read_layer(*layer, out); !status)
      return Error{status.error().code, "'" + path + "': " + status.error().message};
  }
  return out;
}

Result<RawFile> read_raw(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return not_found("There is no file '" + path + "'.");
  GDALAllRegister();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  Result<RawFile> out = path.ends_with(".wkt") ? read_wkt(path) : read_vector(path);
  CPLPopErrorHandler();
  if (out && out->fields.empty()) return bad_input("'" + path + "' holds no polygon.");
  return out;
}

planner::GeoOrigin middle_of(std::span<const RawField> fields) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Box box{Vec2(kFar, kFar), Vec2(-kFar, -kFar)};
  for (const RawField& field : fields) {
    for (const Vec2& p : field.polygon.outline) {
      if (!is_finite(p)) continue;
      box.lo = box.lo.cwiseMin(p);
      box.hi = box.hi.cwiseMax(p);
    }
  }
  if (box.lo.x() > box.hi.x()) return {};
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

/// The areas in the frame around the origin (or as they are), those far from it left out.
std::vector<Polygon> near(const std::vector<RawField>& areas,
                          const std::optional<planner::GeoOrigin>& origin) {
  std::vector<Polygon> out;
  for (const RawField& area : areas) {
    Polygon polygon = area.polygon;
    const bool usable = !origin || to_local(polygon, *origin).ok();
    if (!usable || polygon.outline.empty()) continue;
    if (origin && polygon.outline.front().norm() > kNoFlyDistance_m) continue;
    out.push_back(std::move(polygon));
  }
  return out;
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
  Result<RawFile> raw = read_raw(path);
  if (!raw) return raw.error();
  std::vector<RawField> no_fly;
  if (!options.no_fly_file.empty()) {
    Result<RawFile> more = read_raw(options.no_fly_file);
    if (!more) return more.error();
    if (more->is_local != raw->is_local) {
      return bad_input("'" + options.no_fly_file + "' and '" + path +
                       "': one is in local metres, the other on Earth.");
    }
    no_fly = std::move(more->fields);
  }
  for (RawField& field : raw->fields) {
    if (field.no_fly) no_fly.push_back(std::move(field));
  }
  std::erase_if(raw->fields, [](const RawField& field) { return field.no_fly; });
  if (raw->fields.empty()) return bad_input("'" + path + "' holds no polygon to cover.");
  FieldFile out;
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
  if (out.origins.empty()) {
    out.no_fly.push_back(near(no_fly, out.origin));
  } else {
    for (const planner::GeoOrigin& origin : out.origins) out.no_fly.push_back(near(no_fly, origin));
  }
  return out;
}

}  // namespace swallowtail::coverage
