#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coverage/field/polygon.hpp"

/// What a vector file holds, before it is brought into a local frame.
namespace swallowtail::coverage::detail {

struct RawField {
  std::string name;
  std::string height_class;
  std::optional<double> height_m;
  bool no_fly = false;
  Polygon polygon;  ///< (lon, lat) or metres
};

struct RawFile {
  std::vector<RawField> fields;
  bool is_local = false;  ///< metres of no place on Earth
};

/// Every polygon of a file that GDAL reads (also of a zipped Shapefile), or of a .wkt file. Curves are
/// straightened. Errors: see read_fields.
Result<RawFile> read_vector_file(const std::string& path);

}  // namespace swallowtail::coverage::detail
