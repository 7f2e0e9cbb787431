#include "tools/cli/geojson.hpp"

#include <utility>

namespace swallowtail::cli {

using Json = nlohmann::ordered_json;

Json GeoJsonWriter::coordinates(const Vec3& point) const {
  if (!origin_) return {point.x(), point.y(), point.z()};
  const auto place = planner::to_geodetic(*origin_, point.head<2>());
  if (!place) return nullptr;
  return {place.value().y(), place.value().x(), point.z() + origin_->elevation_m};
}

void GeoJsonWriter::add(const char* type, Json coordinates, Json properties) {
  if (!origin_) properties["crs"] = "local metres";
  features_.push_back({{"type", "Feature"},
                       {"properties", std::move(properties)},
                       {"geometry", {{"type", type}, {"coordinates", std::move(coordinates)}}}});
}

void GeoJsonWriter::add_line(const std::vector<Vec3>& points, Json properties) {
  Json line = Json::array();
  for (const Vec3& point : points) line.push_back(coordinates(point));
  add("LineString", std::move(line), std::move(properties));
}

void GeoJsonWriter::add_point(const Vec3& point, Json properties) {
  add("Point", coordinates(point), std::move(properties));
}

std::string GeoJsonWriter::text() const {
  Json out = {{"type", "FeatureCollection"}};
  out["features"] = features_;
  return out.dump(1) + "\n";
}

}  // namespace swallowtail::cli
