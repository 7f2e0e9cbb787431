#include "tools/cli/geojson.hpp"

#include <cmath>
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
  for (const Vec3& point : points) {
    Json next = coordinates(point);
    // Over the 180th meridian longitudes run on: the line is not one round the Earth.
    if (origin_ && !line.empty() && next.is_array() && line.back().is_array()) {
      const double step_deg = next[0].get<double>() - line.back()[0].get<double>();
      if (std::abs(step_deg) > 180.0) next[0] = next[0].get<double>() - std::copysign(360.0, step_deg);
    }
    line.push_back(std::move(next));
  }
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
