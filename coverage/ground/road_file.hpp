#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"
#include "planner/world/raster_file.hpp"

namespace swallowtail::coverage {

/// Every line of a GeoJSON or any other vector file that GDAL reads. Taken as local metres when a feature's
/// property `crs` is "local metres", the file's projection is a local one or named nowhere, or a coordinate
/// lies beyond degrees; else projected into the frame around `origin`. Errors (kNotFound): no such file.
/// (kBadInput): not a vector file, no line in it, on Earth without an origin, more than 200 km away from it.
Result<std::vector<std::vector<Vec2>>> read_roads(const std::string& path,
                                                  const std::optional<planner::GeoOrigin>& origin);

}  // namespace swallowtail::coverage
