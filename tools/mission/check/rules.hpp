#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "idl/data/types.hpp"

/// The independent checker of flown missions. It shares no geometry, interpolation or certification code with
/// what it judges: everything it needs stands in this folder.
namespace swallowtail::check {

struct P2 {
  double x = 0.0;
  double y = 0.0;
};

struct P3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// A solid between two mission times, moving in a straight line from `at` since `since_s`.
struct Solid {
  std::uint32_t id = 0;
  data::ObstacleShape shape = data::ObstacleShape::kSphere;
  P3 at;
  P3 velocity_mps;
  double since_s = 0.0;  ///< when it stands at `at`
  double appears_s = 0.0;
  double vanishes_s = std::numeric_limits<double>::infinity();
  double radius_m = 0.0;
  double height_m = 0.0;
  P3 size_m;
  double yaw_rad = 0.0;
  double margin_m = 0.0;
  std::vector<P3> vertices;
};

/// Ground samples, row by row going north; one sample means a plane.
struct Ground {
  double west_m = 0.0;
  double south_m = 0.0;
  double cell_m = 1.0;
  std::size_t rows = 1;
  std::size_t cols = 1;
  std::vector<float> z_m = {0.0F};

  double at(double x, double y) const;
};

using Rings = std::vector<std::vector<P2>>;  ///< outline, then holes

struct FieldArea {
  std::string id;
  double height_m = 0.0;  ///< required, above ground
  Rings rings;
};

struct RobotLoss {
  double at_s = 0.0;
  double energy = 0.0;
};

/// The ground robot's own.
struct RobotBattery {
  double capacity = 0.0;
  double reserve = 0.0;
  double drive_per_s = 0.0;
  double per_charged = 1.0;
  P2 depot;
  std::vector<RobotLoss> losses;
};

/// Another aircraft takes over, with so much in its battery.
struct Replacement {
  double from_s = 0.0;  ///< or as soon after as the one before has stood on the ground for a while
  double energy = 0.0;
};

/// What a mission must keep to, taken from its scenario.
struct Rules {
  data::VehicleLimits vehicle;
  P3 bounds_min{-1e6, -1e6, -1e3};
  P3 bounds_max{1e6, 1e6, 2e4};
  std::vector<Solid> solids;
  Ground ground;
  bool has_coverage = false;
  std::vector<FieldArea> fields;
  double sensor_width_m = 0.0;
  double height_tolerance_m = 0.0;
  double battery_capacity = 0.0;  ///< drawn in reports
  double battery_reserve = 0.0;
  std::vector<Replacement> replacements;
  double charger_speed_mps = 0.0;
  std::optional<RobotBattery> robot_battery;
  std::vector<Rings> no_fly;           ///< the aircraft is never inside
  double skipped_border_m = 0.0;       ///< of fields: not to be seen
  std::vector<Rings> no_drive;         ///< the robot is never inside
  std::vector<std::vector<P2>> roads;  ///< empty: it drives anywhere
  double off_road_m = 0.0;             ///< how far from a road it may be
};

}  // namespace swallowtail::check
