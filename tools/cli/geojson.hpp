#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "planner/base/vec.hpp"
#include "planner/world/raster_file.hpp"

namespace swallowtail::cli {

/// Collects features for a GeoJSON file: longitude, latitude and elevation around `origin`; without one local
/// metres, and each feature says so in its property `crs`. Longitudes of a line over the 180th meridian run
/// on past it.
class GeoJsonWriter {
 public:
  explicit GeoJsonWriter(std::optional<planner::GeoOrigin> origin) : origin_(origin) {}

  void add_line(const std::vector<Vec3>& points, nlohmann::ordered_json properties);
  void add_point(const Vec3& point, nlohmann::ordered_json properties);
  std::string text() const;

 private:
  nlohmann::ordered_json coordinates(const Vec3& point) const;
  void add(const char* type, nlohmann::ordered_json coordinates, nlohmann::ordered_json properties);

  std::optional<planner::GeoOrigin> origin_;
  nlohmann::ordered_json features_ = nlohmann::ordered_json::array();
};

}  // namespace swallowtail::cli
