#pragma once

#include <cstdint>
#include <vector>

#include "idl/data/common.hpp"

/// idl/mission.idl; see types.hpp.
namespace swallowtail::data {

struct Field {
  std::uint32_t field_id = 0;
  double height_m = 0.0;
  bool operator==(const Field&) const = default;
};

enum class AreaKind : std::uint8_t { kField, kNoFly, kNoDrive };

struct Ring {
  std::uint32_t area_index = 0;
  std::uint32_t first_point = 0;
  std::uint32_t point_count = 0;
  bool is_hole = false;
  AreaKind kind = AreaKind::kField;
  bool operator==(const Ring&) const = default;
};

struct Road {
  std::uint32_t first_point = 0;
  std::uint32_t point_count = 0;
  bool operator==(const Road&) const = default;
};

enum class HeadlandUse : std::uint8_t { kNone, kSkip, kFly };

struct FieldRules {
  double overlap = 0.0;
  bool has_sweep = false;
  double sweep_rad = 0.0;
  HeadlandUse headland = HeadlandUse::kNone;
  double headland_m = 0.0;
  bool lines_beyond_borders = false;
  bool has_ceiling = false;
  double ceiling_m = 0.0;
  bool operator==(const FieldRules&) const = default;
};

struct Multirotor {
  double mass_kg = 3.0;
  double payload_kg = 0.0;
  std::uint32_t rotors = 4;
  double rotor_radius_m = 0.2;
  double drag_area_m2 = 0.04;
  double solidity = 0.1;
  double blade_drag = 0.012;
  double tip_speed_mps = 80.0;
  double induced_factor = 1.15;
  double efficiency = 0.75;
  double avionics_w = 10.0;
  double air_density_kgpm3 = 1.225;
  double air_speed_max_mps = 20.0;
  bool operator==(const Multirotor&) const = default;
};

struct EnergyModel {
  double level_per_s = 1.0;
  double climb_per_s = 1.0;
  double descent_per_s = 1.0;
  double hover_per_s = 1.0;
  double landed_per_s = 0.0;
  double altitude_per_m = 0.0;
  double altitude_from_m = 0.0;
  bool is_multirotor = false;
  Multirotor multirotor;
  double unit_j = 3600.0;
  double wind_east_mps = 0.0;
  double wind_north_mps = 0.0;
  bool operator==(const EnergyModel&) const = default;
};

struct BatteryLimits {
  double capacity = 500.0;
  double reserve = 25.0;
  std::uint32_t levels = 10;
  double charge_s_per_unit = 2.0;
  double taper_from = 1.0;
  double taper_end_rate = 0.1;
  EnergyModel model;
  bool operator==(const BatteryLimits&) const = default;
};

enum class GroundKind : std::uint8_t { kOpen, kRoads, kRough };

struct GroundLimits {
  GroundKind kind = GroundKind::kOpen;
  double off_road_speed_mps = 0.0;
  double off_road_max_m = 200.0;
  double slope_max_rad = 0.35;
  double cell_m = 2.0;
  Point2 area_min;
  Point2 area_max;
  bool operator==(const GroundLimits&) const = default;
};

struct ChargerLimits {
  std::uint32_t charger_id = 1;
  double speed_mps = 1.6;
  double take_off_s = 5.0;
  double landing_s = 5.0;
  Vec3 start;
  GroundLimits ground;
  bool has_battery = false;
  RobotBattery battery;
  bool operator==(const ChargerLimits&) const = default;
};

struct CoverageTask {
  std::uint32_t task_id = 1;
  std::uint32_t revision = 1;
  std::uint32_t vehicle_id = 1;
  GeoOrigin origin;
  std::vector<Field> fields;
  std::vector<Ring> rings;
  std::vector<Road> roads;
  std::vector<Point2> points;
  FieldRules rules;
  double sensor_width_m = 10.0;
  double height_tolerance_m = 2.0;
  double height_band_m = 0.0;
  std::uint32_t neighbours = 5;
  VehicleLimits vehicle;
  BatteryLimits battery;
  ChargerLimits charger;
  Vec3 start;
  std::uint64_t seed = 1;
  bool has_terrain = false;
  bool operator==(const CoverageTask&) const = default;
};

struct Goal {
  std::uint32_t vehicle_id = 1;
  std::uint32_t revision = 1;
  GeoOrigin origin;
  Vec3 start;
  Vec3 position;
  VehicleLimits vehicle;
  Vec3 bounds_min;
  Vec3 bounds_max;
  std::uint64_t seed = 1;
  bool has_terrain = false;
  bool operator==(const Goal&) const = default;
};

enum class ClockState : std::uint8_t { kWaiting, kRunning, kEnded };

struct MissionClock {
  double time_s = 0.0;
  double rate = 1.0;
  ClockState state = ClockState::kWaiting;
  bool operator==(const MissionClock&) const = default;
};

}  // namespace swallowtail::data
