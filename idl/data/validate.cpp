#include "idl/data/validate.hpp"

#include <cmath>
#include <cstdint>

#include "idl/data/ranges.hpp"
#include "idl/data/rings.hpp"

namespace swallowtail::data {

namespace {

using namespace ranges;

constexpr std::uint32_t kMaxRotors = 64;
constexpr double kMaxOverlap = 0.9;

Refusal check(const VehicleLimits& limits) {
  if (!is_size(limits.radius_m)) return "vehicle radius out of range";
  if (!is_within(limits.margin_m, 0.0, kMaxSize_m)) return "vehicle margin out of range";
  if (!is_positive_speed(limits.cruise_speed_mps) || !is_positive_speed(limits.climb_speed_mps) ||
      !is_positive_speed(limits.descent_speed_mps)) {
    return "vehicle speed out of range";
  }
  if (!(limits.turn_max_rad > 0.0 && limits.turn_max_rad <= kMaxTurn_rad)) return "turn limit out of range";
  if (!(limits.climb_max_rad > 0.0 && limits.climb_max_rad <= kMaxClimb_rad))
    return "climb limit out of range";
  return {};
}

Refusal check(const Multirotor& craft) {
  for (const double value :
       {craft.mass_kg, craft.payload_kg, craft.rotor_radius_m, craft.drag_area_m2, craft.solidity,
        craft.blade_drag, craft.tip_speed_mps, craft.induced_factor, craft.efficiency, craft.avionics_w,
        craft.air_density_kgpm3, craft.air_speed_max_mps}) {
    if (!is_within(value, 0.0, kMaxPower)) return "multirotor out of range";
  }
  return craft.rotors >= 1 && craft.rotors <= kMaxRotors ? Refusal{} : "multirotor out of range";
}

Refusal check(const EnergyModel& model) {
  for (const double rate :
       {model.level_per_s, model.climb_per_s, model.descent_per_s, model.hover_per_s, model.landed_per_s}) {
    if (!is_within(rate, 0.0, kMaxPower)) return "energy model out of range";
  }
  if (!is_within(model.altitude_per_m, 0.0, 1.0) || !is_height(model.altitude_from_m))
    return "energy model out of range";
  if (!(model.unit_j > 0.0 && model.unit_j <= kMaxEnergy)) return "energy unit out of range";
  if (!is_within(model.wind_east_mps, -kMaxSpeed_mps, kMaxSpeed_mps) ||
      !is_within(model.wind_north_mps, -kMaxSpeed_mps, kMaxSpeed_mps))
    return "wind out of range";
  return check(model.multirotor);
}

Refusal check(const FieldRules& rules) {
  if (rules.headland > HeadlandUse::kFly) return "enumerator out of range";
  if (!is_within(rules.overlap, 0.0, kMaxOverlap)) return "overlap out of range";
  if (!is_angle(rules.sweep_rad)) return "sweep out of range";
  if (!is_within(rules.headland_m, 0.0, kMaxSize_m)) return "headland out of range";
  if (!is_within(rules.ceiling_m, 0.0, kMaxSize_m)) return "ceiling out of range";
  if (rules.has_ceiling && rules.ceiling_m == 0.0) return "ceiling out of range";
  return {};
}

Refusal check_roads(const CoverageTask& task) {
  for (const Road& road : task.roads) {
    if (road.point_count < 2) return "road has under 2 points";
    if (std::uint64_t{road.first_point} + road.point_count > task.points.size())
      return "road outside the points";
  }
  if (task.charger.ground.kind == GroundKind::kRoads && task.roads.empty()) return "charger without roads";
  return {};
}

Refusal check(const BatteryLimits& battery) {
  if (!(battery.capacity > 0.0 && battery.capacity <= kMaxEnergy)) return "capacity out of range";
  if (!is_within(battery.reserve, 0.0, battery.capacity)) return "reserve above capacity";
  if (battery.levels < 1 || battery.levels > 1000) return "battery levels out of range";
  if (!is_within(battery.charge_s_per_unit, 0.0, kMaxEnergy)) return "charge time out of range";
  if (!is_taper(battery.taper_from, battery.taper_end_rate)) return "charging taper out of range";
  return check(battery.model);
}

Refusal check(const GroundLimits& ground) {
  if (ground.kind > GroundKind::kRough) return "enumerator out of range";
  if (!is_speed(ground.off_road_speed_mps) || !is_within(ground.off_road_max_m, 0.0, kMaxHorizontal_m))
    return "off-road limits out of range";
  if (!is_within(ground.slope_max_rad, 0.0, kMaxClimb_rad)) return "slope limit out of range";
  if (!is_size(ground.cell_m)) return "cell size out of range";
  if (!is_horizontal(ground.area_min.x_m) || !is_horizontal(ground.area_min.y_m) ||
      !is_horizontal(ground.area_max.x_m) || !is_horizontal(ground.area_max.y_m))
    return "ground area out of range";
  const bool has_area =
      ground.area_min.x_m < ground.area_max.x_m && ground.area_min.y_m < ground.area_max.y_m;
  if (ground.kind == GroundKind::kRough && !has_area) return "ground area is empty";
  return {};
}

Refusal check(const ChargerLimits& charger) {
  if (!is_speed(charger.speed_mps)) return "charger speed out of range";
  if (!is_time(charger.take_off_s) || !is_time(charger.landing_s))
    return "charger handling time out of range";
  if (!is_position(charger.start)) return "charger start out of range";
  if (charger.has_battery && !is_robot_battery(charger.battery)) return "charger battery out of range";
  return check(charger.ground);
}

/// Whether the vertices span a volume.
bool is_solid(const std::vector<Vec3>& vertices) {
  const auto minus = [](const Vec3& a, const Vec3& b) {
    return Vec3{a.x_m - b.x_m, a.y_m - b.y_m, a.z_m - b.z_m};
  };
  const auto cross = [](const Vec3& a, const Vec3& b) {
    return Vec3{a.y_m * b.z_m - a.z_m * b.y_m, a.z_m * b.x_m - a.x_m * b.z_m, a.x_m * b.y_m - a.y_m * b.x_m};
  };
  const auto dot = [](const Vec3& a, const Vec3& b) { return a.x_m * b.x_m + a.y_m * b.y_m + a.z_m * b.z_m; };
  Vec3 edge;
  for (const Vec3& v : vertices) {
    const Vec3 candidate = minus(v, vertices.front());
    if (dot(candidate, candidate) > dot(edge, edge)) edge = candidate;
  }
  Vec3 normal;
  for (const Vec3& v : vertices) {
    const Vec3 candidate = cross(edge, minus(v, vertices.front()));
    if (dot(candidate, candidate) > dot(normal, normal)) normal = candidate;
  }
  const double length = std::sqrt(dot(normal, normal));
  double thickness = 0.0;
  for (const Vec3& v : vertices) {
    thickness = std::fmax(thickness, std::fabs(dot(normal, minus(v, vertices.front()))));
  }
  return length > 0.0 && thickness > kFlat_m * length;
}

Refusal check_mesh(const std::vector<Vec3>& vertices) {
  if (vertices.size() < 4) return "mesh has under 4 vertices";
  for (const Vec3& v : vertices) {
    if (!is_within(v.x_m, -kMaxSize_m, kMaxSize_m) || !is_within(v.y_m, -kMaxSize_m, kMaxSize_m) ||
        !is_within(v.z_m, -kMaxSize_m, kMaxSize_m)) {
      return "mesh vertex out of range";
    }
  }
  if (!is_solid(vertices)) return "mesh is flat";
  return {};
}

Refusal check_shape(const Obstacle& obstacle) {
  switch (obstacle.shape) {
    case ObstacleShape::kSphere:
      return is_size(obstacle.radius_m) ? Refusal{} : "radius out of range";
    case ObstacleShape::kCylinder:
    case ObstacleShape::kCone:
      if (!is_size(obstacle.radius_m)) return "radius out of range";
      return is_size(obstacle.height_m) ? Refusal{} : "height out of range";
    case ObstacleShape::kBox:
      if (is_size(obstacle.size_m.x_m) && is_size(obstacle.size_m.y_m) && is_size(obstacle.size_m.z_m))
        return {};
      return "box size out of range";
    case ObstacleShape::kMesh:
      return check_mesh(obstacle.vertices);
  }
  return "enumerator out of range";
}

}  // namespace

Refusal validate(const TerrainTile& tile) {
  if (!is_origin(tile.origin)) return "geodetic origin out of range";
  if (!is_size(tile.cell_size_m)) return "cell size out of range";
  if (tile.map_rows < 1 || tile.map_cols < 1 || tile.tile_rows < 1 || tile.tile_cols < 1)
    return "empty raster";
  if (!is_horizontal(tile.origin_x_m) || !is_horizontal(tile.origin_y_m) ||
      !is_horizontal(tile.origin_x_m + tile.cell_size_m * (tile.map_cols - 1.0)) ||
      !is_horizontal(tile.origin_y_m + tile.cell_size_m * (tile.map_rows - 1.0))) {
    return "map out of range";
  }
  const std::uint64_t cells = std::uint64_t{tile.tile_rows} * tile.tile_cols;
  if (cells > kMaxTileCells) return "tile above its bound";
  if (cells != tile.elevation_m.size()) return "tile size differs from its elevations";
  if (std::uint64_t{tile.first_row} + tile.tile_rows > tile.map_rows ||
      std::uint64_t{tile.first_col} + tile.tile_cols > tile.map_cols) {
    return "tile outside its map";
  }
  for (const float elevation : tile.elevation_m) {
    if (!is_height(elevation)) return "elevation out of range";
  }
  return {};
}

Refusal validate(const Obstacle& obstacle) {
  if (!is_position(obstacle.position)) return "position out of range";
  if (!is_velocity(obstacle.velocity_mps)) return "speed out of range";
  if (!is_time(obstacle.state_time_s)) return "time out of range";
  if (!is_within(obstacle.valid_until_s, obstacle.state_time_s, kForever_s))
    return "valid-until out of range";
  if (!is_finite(obstacle.radius_m) || !is_finite(obstacle.height_m) || !is_finite(obstacle.size_m.x_m) ||
      !is_finite(obstacle.size_m.y_m) || !is_finite(obstacle.size_m.z_m)) {
    return "not finite";
  }
  if (!is_angle(obstacle.yaw_rad)) return "yaw out of range";
  if (!is_within(obstacle.margin_m, 0.0, kMaxSize_m)) return "margin out of range";
  if (obstacle.vertices.size() > kMaxMeshVertices) return "sequence above its bound";
  if (obstacle.shape != ObstacleShape::kMesh && !obstacle.vertices.empty()) return "vertices without a mesh";
  return check_shape(obstacle);
}

Refusal validate(const VehicleState& state) {
  if (!is_time(state.time_s)) return "time out of range";
  if (!is_position(state.position)) return "position out of range";
  if (!is_velocity(state.velocity_mps)) return "speed out of range";
  if (!is_angle(state.roll_rad) || !is_angle(state.pitch_rad) || !is_angle(state.yaw_rad)) {
    return "attitude out of range";
  }
  if (state.mode > VehicleMode::kDocked) return "enumerator out of range";
  if (state.mode == VehicleMode::kDocked && state.docked_charger_id == 0) return "docked without a charger";
  if (state.leg_index > kMaxLegs || state.legs_done > kMaxLegs) return "leg index above its bound";
  return {};
}

Refusal validate(const BatteryState& state) {
  if (!is_time(state.time_s)) return "time out of range";
  if (!(state.capacity > 0.0 && state.capacity <= kMaxEnergy)) return "capacity out of range";
  if (!is_finite(state.energy)) return "not finite";
  if (state.energy < 0.0) return "energy below zero";
  if (state.energy > state.capacity) return "energy above capacity";
  if (!is_within(state.power, -kMaxPower, kMaxPower)) return "power out of range";
  if (!is_within(state.health, 0.0, 1.0)) return "health out of range";
  return {};
}

Refusal validate(const CoverageTask& task) {
  if (!is_origin(task.origin)) return "geodetic origin out of range";
  if (task.fields.empty()) return "task without fields";
  if (task.fields.size() > kMaxFields || task.rings.size() > kMaxRings || task.roads.size() > kMaxRoads ||
      task.points.size() > kMaxTaskPoints) {
    return "sequence above its bound";
  }
  for (const Field& field : task.fields) {
    if (!is_size(field.height_m)) return "field height out of range";
  }
  if (!is_size(task.sensor_width_m)) return "sensor width out of range";
  if (!is_size(task.height_tolerance_m)) return "height tolerance out of range";
  if (!is_within(task.height_band_m, 0.0, kMaxSize_m)) return "height band out of range";
  if (task.neighbours < 1 || task.neighbours > kMaxLegs) return "neighbours out of range";
  if (!is_position(task.start)) return "start out of range";
  if (const Refusal refusal = check(task.vehicle)) return refusal;
  if (const Refusal refusal = check(task.battery)) return refusal;
  if (const Refusal refusal = check(task.charger)) return refusal;
  if (const Refusal refusal = check(task.rules)) return refusal;
  if (const Refusal refusal = check_roads(task)) return refusal;
  return check_rings(task);
}

Refusal validate(const Goal& goal) {
  if (!is_origin(goal.origin)) return "geodetic origin out of range";
  if (!is_position(goal.start) || !is_position(goal.position)) return "position out of range";
  if (!is_position(goal.bounds_min) || !is_position(goal.bounds_max)) return "bounds out of range";
  if (!(goal.bounds_min.x_m < goal.bounds_max.x_m && goal.bounds_min.y_m < goal.bounds_max.y_m &&
        goal.bounds_min.z_m < goal.bounds_max.z_m)) {
    return "bounds are empty";
  }
  if (!is_within(goal.position.x_m, goal.bounds_min.x_m, goal.bounds_max.x_m) ||
      !is_within(goal.position.y_m, goal.bounds_min.y_m, goal.bounds_max.y_m) ||
      !is_within(goal.position.z_m, goal.bounds_min.z_m, goal.bounds_max.z_m)) {
    return "goal outside its bounds";
  }
  return check(goal.vehicle);
}

Refusal validate(const MissionClock& clock) {
  if (!is_time(clock.time_s)) return "time out of range";
  if (!is_within(clock.rate, 0.0, kMaxRate)) return "rate out of range";
  if (clock.state > ClockState::kEnded) return "enumerator out of range";
  return {};
}

}  // namespace swallowtail::data
