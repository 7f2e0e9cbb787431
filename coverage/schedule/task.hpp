#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "coverage/energy/battery.hpp"
#include "coverage/field/sub_cells.hpp"
#include "planner/path/path.hpp"
#include "planner/world/raster_file.hpp"

namespace swallowtail::coverage {

/// What is asked for: fields, and what the aircraft and the ground robot can do.
struct Task {
  std::uint32_t id = 1;
  std::uint32_t revision = 1;
  std::uint32_t vehicle_id = 1;
  std::optional<planner::GeoOrigin> origin;
  std::vector<Field> fields;
  double sensor_width_m = 10.0;
  double height_tolerance_m = 2.0;
  double height_band_m = 0.0;  ///< ε of the layers [COV 4.1]
  int neighbours = 5;          ///< X [COV 4.1]
  std::optional<double> sweep_rad{};
  FieldRules rules{};
  std::vector<Polygon> no_fly{};  ///< neither covered nor crossed by transfers
  planner::VehicleLimits vehicle;
  Battery battery;
  Charger charger;
  Vec3 start_m = Vec3::Zero();  ///< the aircraft stands on the ground below it
  std::uint64_t seed = 1;
};

/// Errors name the value and the rule. Fields are judged one by one when they are cut.
Status validate(const Task& task);

}  // namespace swallowtail::coverage
