#include "idl/codec/cyclone/mission.hpp"

namespace swallowtail::codec::cyclone {

namespace {

data::Refusal get_field(const swallowtail_Field& w, data::Field& d) {
  d.field_id = w.field_id;
  d.height_m = w.height_m;
  return {};
}

void put_field(const data::Field& d, swallowtail_Field& w) {
  w.field_id = d.field_id;
  w.height_m = d.height_m;
}

data::Refusal get_ring(const swallowtail_Ring& w, data::Ring& d) {
  d.area_index = w.area_index;
  d.first_point = w.first_point;
  d.point_count = w.point_count;
  d.is_hole = w.is_hole;
  if (!get_enum(w.kind, data::AreaKind::kNoDrive, d.kind)) return kBadEnumerator;
  return {};
}

void put_ring(const data::Ring& d, swallowtail_Ring& w) {
  w.area_index = d.area_index;
  w.first_point = d.first_point;
  w.point_count = d.point_count;
  w.is_hole = d.is_hole;
  put_enum(d.kind, w.kind);
}

data::Refusal get_road(const swallowtail_Road& w, data::Road& d) {
  d.first_point = w.first_point;
  d.point_count = w.point_count;
  return {};
}

void put_road(const data::Road& d, swallowtail_Road& w) {
  w.first_point = d.first_point;
  w.point_count = d.point_count;
}

data::Refusal get_point2(const swallowtail_Point2& w, data::Point2& d) {
  d = {w.x_m, w.y_m};
  return {};
}

void put_point2(const data::Point2& d, swallowtail_Point2& w) {
  w.x_m = d.x_m;
  w.y_m = d.y_m;
}

data::Refusal get_field_rules(const swallowtail_FieldRules& w, data::FieldRules& d) {
  d.overlap = w.overlap;
  d.has_sweep = w.has_sweep;
  d.sweep_rad = w.sweep_rad;
  if (!get_enum(w.headland, data::HeadlandUse::kFly, d.headland)) return kBadEnumerator;
  d.headland_m = w.headland_m;
  d.lines_beyond_borders = w.lines_beyond_borders;
  d.has_ceiling = w.has_ceiling;
  d.ceiling_m = w.ceiling_m;
  return {};
}

void put_field_rules(const data::FieldRules& d, swallowtail_FieldRules& w) {
  w.overlap = d.overlap;
  w.has_sweep = d.has_sweep;
  w.sweep_rad = d.sweep_rad;
  put_enum(d.headland, w.headland);
  w.headland_m = d.headland_m;
  w.lines_beyond_borders = d.lines_beyond_borders;
  w.has_ceiling = d.has_ceiling;
  w.ceiling_m = d.ceiling_m;
}

data::Refusal get_multirotor(const swallowtail_Multirotor& w, data::Multirotor& d) {
  d.mass_kg = w.mass_kg;
  d.payload_kg = w.payload_kg;
  d.rotors = w.rotors;
  d.rotor_radius_m = w.rotor_radius_m;
  d.drag_area_m2 = w.drag_area_m2;
  d.solidity = w.solidity;
  d.blade_drag = w.blade_drag;
  d.tip_speed_mps = w.tip_speed_mps;
  d.induced_factor = w.induced_factor;
  d.efficiency = w.efficiency;
  d.avionics_w = w.avionics_w;
  d.air_density_kgpm3 = w.air_density_kgpm3;
  d.air_speed_max_mps = w.air_speed_max_mps;
  return {};
}

void put_multirotor(const data::Multirotor& d, swallowtail_Multirotor& w) {
  w.mass_kg = d.mass_kg;
  w.payload_kg = d.payload_kg;
  w.rotors = d.rotors;
  w.rotor_radius_m = d.rotor_radius_m;
  w.drag_area_m2 = d.drag_area_m2;
  w.solidity = d.solidity;
  w.blade_drag = d.blade_drag;
  w.tip_speed_mps = d.tip_speed_mps;
  w.induced_factor = d.induced_factor;
  w.efficiency = d.efficiency;
  w.avionics_w = d.avionics_w;
  w.air_density_kgpm3 = d.air_density_kgpm3;
  w.air_speed_max_mps = d.air_speed_max_mps;
}

data::Refusal get_energy_model(const swallowtail_EnergyModel& w, data::EnergyModel& d) {
  d.level_per_s = w.level_per_s;
  d.climb_per_s = w.climb_per_s;
  d.descent_per_s = w.descent_per_s;
  d.hover_per_s = w.hover_per_s;
  d.landed_per_s = w.landed_per_s;
  d.altitude_per_m = w.altitude_per_m;
  d.altitude_from_m = w.altitude_from_m;
  d.is_multirotor = w.is_multirotor;
  if (const auto refusal = get_multirotor(w.multirotor, d.multirotor)) return refusal;
  d.unit_j = w.unit_j;
  d.wind_east_mps = w.wind_east_mps;
  d.wind_north_mps = w.wind_north_mps;
  return {};
}

void put_energy_model(const data::EnergyModel& d, swallowtail_EnergyModel& w) {
  w.level_per_s = d.level_per_s;
  w.climb_per_s = d.climb_per_s;
  w.descent_per_s = d.descent_per_s;
  w.hover_per_s = d.hover_per_s;
  w.landed_per_s = d.landed_per_s;
  w.altitude_per_m = d.altitude_per_m;
  w.altitude_from_m = d.altitude_from_m;
  w.is_multirotor = d.is_multirotor;
  put_multirotor(d.multirotor, w.multirotor);
  w.unit_j = d.unit_j;
  w.wind_east_mps = d.wind_east_mps;
  w.wind_north_mps = d.wind_north_mps;
}

data::Refusal get_battery_limits(const swallowtail_BatteryLimits& w, data::BatteryLimits& d) {
  d.capacity = w.capacity;
  d.reserve = w.reserve;
  d.levels = w.levels;
  d.charge_s_per_unit = w.charge_s_per_unit;
  d.taper_from = w.taper_from;
  d.taper_end_rate = w.taper_end_rate;
  if (const auto refusal = get_energy_model(w.model, d.model)) return refusal;
  return {};
}

void put_battery_limits(const data::BatteryLimits& d, swallowtail_BatteryLimits& w) {
  w.capacity = d.capacity;
  w.reserve = d.reserve;
  w.levels = d.levels;
  w.charge_s_per_unit = d.charge_s_per_unit;
  w.taper_from = d.taper_from;
  w.taper_end_rate = d.taper_end_rate;
  put_energy_model(d.model, w.model);
}

data::Refusal get_ground_limits(const swallowtail_GroundLimits& w, data::GroundLimits& d) {
  if (!get_enum(w.kind, data::GroundKind::kRough, d.kind)) return kBadEnumerator;
  d.off_road_speed_mps = w.off_road_speed_mps;
  d.off_road_max_m = w.off_road_max_m;
  d.slope_max_rad = w.slope_max_rad;
  d.cell_m = w.cell_m;
  if (const auto refusal = get_point2(w.area_min, d.area_min)) return refusal;
  if (const auto refusal = get_point2(w.area_max, d.area_max)) return refusal;
  return {};
}

void put_ground_limits(const data::GroundLimits& d, swallowtail_GroundLimits& w) {
  put_enum(d.kind, w.kind);
  w.off_road_speed_mps = d.off_road_speed_mps;
  w.off_road_max_m = d.off_road_max_m;
  w.slope_max_rad = d.slope_max_rad;
  w.cell_m = d.cell_m;
  put_point2(d.area_min, w.area_min);
  put_point2(d.area_max, w.area_max);
}

data::Refusal get_charger_limits(const swallowtail_ChargerLimits& w, data::ChargerLimits& d) {
  d.charger_id = w.charger_id;
  d.speed_mps = w.speed_mps;
  d.take_off_s = w.take_off_s;
  d.landing_s = w.landing_s;
  d.start = vec3(w.start);
  if (const auto refusal = get_ground_limits(w.ground, d.ground)) return refusal;
  d.has_battery = w.has_battery;
  d.battery = robot_battery(w.battery);
  return {};
}

void put_charger_limits(const data::ChargerLimits& d, swallowtail_ChargerLimits& w) {
  w.charger_id = d.charger_id;
  w.speed_mps = d.speed_mps;
  w.take_off_s = d.take_off_s;
  w.landing_s = d.landing_s;
  w.start = vec3(d.start);
  put_ground_limits(d.ground, w.ground);
  w.has_battery = d.has_battery;
  w.battery = robot_battery(d.battery);
}

}  // namespace

data::Refusal to_data(const swallowtail_CoverageTask& w, data::CoverageTask& d) {
  d.task_id = w.task_id;
  d.revision = w.revision;
  d.vehicle_id = w.vehicle_id;
  d.origin = geo_origin(w.origin);
  if (const auto refusal = get_sequence(w.fields, data::kMaxFields, d.fields, get_field)) return refusal;
  if (const auto refusal = get_sequence(w.rings, data::kMaxRings, d.rings, get_ring)) return refusal;
  if (const auto refusal = get_sequence(w.roads, data::kMaxRoads, d.roads, get_road)) return refusal;
  if (const auto refusal = get_sequence(w.points, data::kMaxTaskPoints, d.points, get_point2)) return refusal;
  if (const auto refusal = get_field_rules(w.rules, d.rules)) return refusal;
  d.sensor_width_m = w.sensor_width_m;
  d.height_tolerance_m = w.height_tolerance_m;
  d.height_band_m = w.height_band_m;
  d.neighbours = w.neighbours;
  d.vehicle = vehicle_limits(w.vehicle);
  if (const auto refusal = get_battery_limits(w.battery, d.battery)) return refusal;
  if (const auto refusal = get_charger_limits(w.charger, d.charger)) return refusal;
  d.start = vec3(w.start);
  d.seed = w.seed;
  d.has_terrain = w.has_terrain;
  return {};
}

void to_wire(const data::CoverageTask& d, swallowtail_CoverageTask& w) {
  w.task_id = d.task_id;
  w.revision = d.revision;
  w.vehicle_id = d.vehicle_id;
  w.origin = geo_origin(d.origin);
  put_sequence(d.fields, w.fields, put_field);
  put_sequence(d.rings, w.rings, put_ring);
  put_sequence(d.roads, w.roads, put_road);
  put_sequence(d.points, w.points, put_point2);
  put_field_rules(d.rules, w.rules);
  w.sensor_width_m = d.sensor_width_m;
  w.height_tolerance_m = d.height_tolerance_m;
  w.height_band_m = d.height_band_m;
  w.neighbours = d.neighbours;
  w.vehicle = vehicle_limits(d.vehicle);
  put_battery_limits(d.battery, w.battery);
  put_charger_limits(d.charger, w.charger);
  w.start = vec3(d.start);
  w.seed = d.seed;
  w.has_terrain = d.has_terrain;
}

data::Refusal to_data(const swallowtail_Goal& w, data::Goal& d) {
  d.vehicle_id = w.vehicle_id;
  d.revision = w.revision;
  d.origin = geo_origin(w.origin);
  d.start = vec3(w.start);
  d.position = vec3(w.position);
  d.vehicle = vehicle_limits(w.vehicle);
  d.bounds_min = vec3(w.bounds_min);
  d.bounds_max = vec3(w.bounds_max);
  d.seed = w.seed;
  d.has_terrain = w.has_terrain;
  return {};
}

void to_wire(const data::Goal& d, swallowtail_Goal& w) {
  w.vehicle_id = d.vehicle_id;
  w.revision = d.revision;
  w.origin = geo_origin(d.origin);
  w.start = vec3(d.start);
  w.position = vec3(d.position);
  w.vehicle = vehicle_limits(d.vehicle);
  w.bounds_min = vec3(d.bounds_min);
  w.bounds_max = vec3(d.bounds_max);
  w.seed = d.seed;
  w.has_terrain = d.has_terrain;
}

data::Refusal to_data(const swallowtail_MissionClock& w, data::MissionClock& d) {
  d.time_s = w.time_s;
  d.rate = w.rate;
  if (!get_enum(w.state, data::ClockState::kEnded, d.state)) return kBadEnumerator;
  return {};
}

void to_wire(const data::MissionClock& d, swallowtail_MissionClock& w) {
  w.time_s = d.time_s;
  w.rate = d.rate;
  put_enum(d.state, w.state);
}

}  // namespace swallowtail::codec::cyclone
