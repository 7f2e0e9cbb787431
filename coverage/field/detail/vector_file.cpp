#include "coverage/field/detail/vector_file.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>

#include "coverage/field/geojson.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::coverage::detail {
namespace {

/// Of local metres, in which no field lies farther from the origin than clean() takes.
constexpr double kMaxLocal_m = 1e6;
/// A file without a projection whose fields are all smaller than this is in degrees.
constexpr double kLeastLocalExtent_m = 1.0;

/// What is looked for in an archive.
constexpr std::array kVectorExtensions = {".shp", ".geojson", ".json", ".kml", ".gpkg", ".gml"};

struct Dataset {
  struct Close {
    void operator()(GDALDataset* d) const { GDALClose(d); }
  };
  std::unique_ptr<GDALDataset, Close> owner;
};

Ring read_ring(const OGRLinearRing& ring) {
  Ring out;
  for (int i = 0; i < ring.getNumPoints(); ++i) out.emplace_back(ring.getX(i), ring.getY(i));
  if (out.size() > 1 && out.front() == out.back()) out.pop_back();
  return out;
}

void add_polygon(const OGRPolygon& polygon, RawField field, std::vector<RawField>& out) {
  if (polygon.getExteriorRing() != nullptr) field.polygon.outline = read_ring(*polygon.getExteriorRing());
  for (int i = 0; i < polygon.getNumInteriorRings(); ++i)
    field.polygon.holes.push_back(read_ring(*polygon.getInteriorRing(i)));
  out.push_back(std::move(field));
}

/// What is empty becomes a field without vertices: clean() refuses it by name.
void add_polygons(const OGRGeometry& geometry, const RawField& like, std::vector<RawField>& out) {
  if (geometry.hasCurveGeometry() != 0) {
    const std::unique_ptr<OGRGeometry> straight(geometry.getLinearGeometry());
    if (straight && straight->hasCurveGeometry() == 0) add_polygons(*straight, like, out);
    return;
  }
  const auto type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPolygon || type == wkbTriangle) {
    add_polygon(*geometry.toPolygon(), like, out);
  } else if (type == wkbMultiPolygon || type == wkbGeometryCollection) {
    const OGRGeometryCollection& parts = *geometry.toGeometryCollection();
    if (parts.getNumGeometries() == 0) out.push_back(like);
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
    const std::string value = feature.GetFieldAsString(index);
    return value.empty() ? std::nullopt : std::optional(value);
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

/// Of all vertices from a field on.
Box box_of(std::span<const RawField> fields, std::size_t first) {
  Ring all;
  for (std::size_t i = first; i < fields.size(); ++i)
    all.insert(all.end(), fields[i].polygon.outline.begin(), fields[i].polygon.outline.end());
  return bounds_of(all);
}

std::string numbers(const Vec2& p) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "(%.8g, %.8g)", p.x(), p.y());
  return text.data();
}

/// Whether coordinates without a projection can be local metres.
Status check_local(const std::vector<RawField>& fields, std::size_t first, bool has_system) {
  const Box box = box_of(fields, first);
  if (std::max(box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff()) > kMaxLocal_m) {
    return bad_input(
        "The file names no coordinate system (a Shapefile needs its .prj), and coordinates such as " +
        numbers(box.hi) + " are neither degrees nor local metres, which end at 1e6.");
  }
  const double extent = (box.hi - box.lo).maxCoeff();
  const Vec2 farthest = box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs());
  if (has_system && extent < kLeastLocalExtent_m && farthest.x() <= 90.0 && farthest.y() <= 180.0) {
    return bad_input("Its fields near " + numbers(box.lo) +
                     " seem to have latitude and longitude the wrong way round: longitude comes first.");
  }
  if (extent > 0.0 && extent < kLeastLocalExtent_m && box.hi.cwiseAbs().maxCoeff() > extent) {
    return bad_input(
        "The file names no coordinate system (a Shapefile needs its .prj), and its fields near " +
        numbers(box.lo) + " would be less than 1 m across in local metres: they seem to be in degrees.");
  }
  return {};
}

/// Whether every field from `first` on is so small that it must be in degrees, of longitudes that may run on
/// past 180.
bool seems_degrees(const std::vector<RawField>& fields, std::size_t first, const Vec2& farthest) {
  if (farthest.x() > 540.0 || farthest.y() > 90.0) return false;
  for (std::size_t i = first; i < fields.size(); ++i) {
    const Box box = box_of(std::span(&fields[i], 1), 0);
    if (!((box.hi - box.lo).maxCoeff() < kLeastLocalExtent_m)) return false;
  }
  return true;
}

/// Brings the fields from `first` on to degrees, or takes them as local metres.
Status settle_frame(const OGRSpatialReference* reference, bool says_local, std::size_t first, RawFile& out) {
  if (first == out.fields.size()) return {};
  const bool projected = reference != nullptr && reference->IsProjected() != 0;
  const Box box = box_of(out.fields, first);
  const Vec2 farthest = box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs());
  const bool beyond_degrees = (farthest.x() > 180.0 || farthest.y() > 90.0) &&
                              !(reference != nullptr && seems_degrees(out.fields, first, farthest));
  const bool is_local = says_local || (!projected && (beyond_degrees || reference == nullptr));
  if (first > 0 && is_local != out.is_local)
    return bad_input("Some of its fields are in local metres, others on Earth.");
  out.is_local = is_local;
  if (is_local) return says_local ? Status() : check_local(out.fields, first, reference != nullptr);
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

/// Adds a geometry's polygons. Errors: not WKT, too many polygons.
Status read_wkt_line(const char* text, const std::string& name, RawFile& out) {
  OGRGeometry* geometry = nullptr;
  const OGRErr error = OGRGeometryFactory::createFromWkt(text, nullptr, &geometry);
  const std::unique_ptr<OGRGeometry> owned(geometry);
  if (error != OGRERR_NONE || !owned) return bad_input("is not a geometry in WKT.");
  RawField like;
  like.name = name;
  add_polygons(*owned, like, out.fields);
  if (out.fields.size() > kMaxFileFields) return bad_input("more than 10000 polygons.");
  return {};
}

/// A geometry a line, "SRID=number;" before it where it is not WGS 84. Lines without are settled together.
Result<RawFile> read_wkt(const std::string& path) {
  std::ifstream stream(path);
  RawFile out;
  RawFile plain;
  OGRSpatialReference reference;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string where = "'" + path + "', line " + std::to_string(number) + ": ";
    const std::string name = "line-" + std::to_string(number);
    const bool has_srid = line.rfind("SRID=", 0) == 0;
    std::size_t begin = 0;
    if (has_srid) {
      begin = line.find(';');
      if (begin == std::string::npos || reference.importFromEPSG(std::atoi(line.c_str() + 5)) != OGRERR_NONE)
        return bad_input(where + "the SRID is not known.");
      ++begin;
    }
    RawFile& file = has_srid ? out : plain;
    const std::size_t first = file.fields.size();
    Status status = read_wkt_line(line.c_str() + begin, name, file);
    if (status.ok() && has_srid) status = settle_frame(&reference, false, first, out);
    if (!status) return bad_input(where + status.error().message);
  }
  reference.SetWellKnownGeogCS("WGS84");
  if (const Status status = settle_frame(&reference, false, 0, plain); !status) return status.error();
  if (!out.fields.empty() && !plain.fields.empty() && out.is_local != plain.is_local)
    return bad_input("'" + path + "': some lines are in local metres, others have an SRID.");
  out.is_local = out.fields.empty() ? plain.is_local : out.is_local;
  out.fields.insert(out.fields.end(), plain.fields.begin(), plain.fields.end());
  return out;
}

std::string extension_of(const std::string& path) {
  std::string out = std::filesystem::path(path).extension().string();
  std::ranges::transform(out, out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

Dataset open_vector(const std::string& name) {
  return {decltype(Dataset::owner)(static_cast<GDALDataset*>(
      GDALOpenEx(name.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr)))};
}

/// Of an archive that GDAL does not open as it is, since they lie in folders.
std::vector<Dataset> open_within(const std::string& archive) {
  const CPLStringList names(VSIReadDirRecursive(archive.c_str()));
  std::vector<Dataset> out;
  for (int i = 0; i < names.size(); ++i) {
    const std::string name = names[i];
    const bool is_vector = std::ranges::count(kVectorExtensions, extension_of(name)) > 0;
    if (!is_vector || name.starts_with("__MACOSX")) continue;
    Dataset dataset = open_vector(archive + "/" + name);
    if (dataset.owner) out.push_back(std::move(dataset));
  }
  return out;
}

Result<RawFile> read_vector(const std::string& path) {
  const bool is_archive = extension_of(path) == ".zip";
  const std::string name = is_archive ? "/vsizip/{" + std::filesystem::absolute(path).string() + "}" : path;
  std::vector<Dataset> datasets;
  if (Dataset whole = open_vector(name); whole.owner) {
    datasets.push_back(std::move(whole));
  } else if (is_archive) {
    datasets = open_within(name);
  }
  if (datasets.empty()) return bad_input("'" + path + "' is not a vector file that GDAL can read.");
  RawFile out;
  for (const Dataset& dataset : datasets) {
    for (OGRLayer* layer : dataset.owner->GetLayers()) {
      if (const Status status = read_layer(*layer, out); !status)
        return Error{status.error().code, "'" + path + "': " + status.error().message};
    }
  }
  return out;
}

}  // namespace

Result<RawFile> read_vector_file(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return not_found("There is no file '" + path + "'.");
  GDALAllRegister();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  Result<RawFile> out = extension_of(path) == ".wkt" ? read_wkt(path) : read_vector(path);
  CPLPopErrorHandler();
  if (out && out->fields.empty()) return bad_input("'" + path + "' holds no polygon.");
  return out;
}

}  // namespace swallowtail::coverage::detail
