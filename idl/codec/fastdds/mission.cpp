#include "idl/codec/fastdds/mission.hpp"

namespace swallowtail::codec::fast {

namespace {

data::Refusal get_field(const swallowtail_wire::Field& w, data::Field& d) {
  d.field_id = w.field_id();
  d.height_m = w.height_m();
  return {};
}

void put_field(const data::Field& d, swallowtail_wire::Field& w) {
  w.field_id() = d.field_id;
  w.height_m() = d.height_m;
}

data::Refusal get_ring(const swallowtail_wire::Ring& w, data::Ring& d) {
  d.field_index = w.field_index();
  d.first_point = w.first_point();
  d.point_count = w.point_count();
  d.is_hole = w.is_hole();
  return {};
}

void put_ring(const data::Ring& d, swallowtail_wire::Ring& w) {
  w.field_index() = d.field_index;
  w.first_point() = d.first_point;
  w.point_count() = d.point_count;
  w.is_hole() = d.is_hole;
}

data::Refusal get_energy_model(const swallowtail_wire::EnergyModel& w, data::EnergyModel& d) {
  d.level_per_s = w.level_per_s();
  d.climb_per_s = w.climb_per_s();
  d.descent_per_s = w.descent_per_s();
  d.hover_per_s = w.hover_per_s();
  d.landed_per_s = w.landed_per_s();
  return {};
}

void put_energy_model(const data::EnergyModel& d, swallowtail_wire::EnergyModel& w) {
  w.level_per_s() = d.level_per_s;
  w.climb_per_s() = d.climb_per_s;
  w.descent_per_s() = d.descent_per_s;
  w.hover_per_s() = d.hover_per_s;
  w.landed_per_s() = d.landed_per_s;
}

data::Refusal get_battery_limits(const swallowtail_wire::BatteryLimits& w, data::BatteryLimits& d) {
  d.capacity = w.capacity();
  d.reserve = w.reserve();
  d.levels = w.levels();
  d.charge_s_per_unit = w.charge_s_per_unit();
  if (const auto refusal = get_energy_model(w.model(), d.model)) return refusal;
  return {};
}

void put_battery_limits(const data::BatteryLimits& d, swallowtail_wire::BatteryLimits& w) {
  w.capacity() = d.capacity;
  w.reserve() = d.reserve;
  w.levels() = d.levels;
  w.charge_s_per_unit() = d.charge_s_per_unit;
  put_energy_model(d.model, w.model());
}

data::Refusal get_charger_limits(const swallowtail_wire::ChargerLimits& w, data::ChargerLimits& d) {
  d.charger_id = w.charger_id();
  d.speed_mps = w.speed_mps();
  d.take_off_s = w.take_off_s();
  d.landing_s = w.landing_s();
  d.start = vec3(w.start());
  return {};
}

void put_charger_limits(const data::ChargerLimits& d, swallowtail_wire::ChargerLimits& w) {
  w.charger_id() = d.charger_id;
  w.speed_mps() = d.speed_mps;
  w.take_off_s() = d.take_off_s;
  w.landing_s() = d.landing_s;
  w.start() = vec3(d.start);
}

data::Refusal get_point2(const swallowtail_wire::Point2& w, data::Point2& d) {
  d = {w.x_m(), w.y_m()};
  return {};
}

void put_point2(const data::Point2& d, swallowtail_wire::Point2& w) {
  w.x_m() = d.x_m;
  w.y_m() = d.y_m;
}

}  // namespace

data::Refusal to_data(const swallowtail_wire::CoverageTask& w, data::CoverageTask& d) {
  d.task_id = w.task_id();
  d.revision = w.revision();
  d.vehicle_id = w.vehicle_id();
  d.origin = geo_origin(w.origin());
  if (const auto refusal = get_sequence(w.fields(), data::kMaxFields, d.fields, get_field)) return refusal;
  if (const auto refusal = get_sequence(w.rings(), data::kMaxRings, d.rings, get_ring)) return refusal;
  if (const auto refusal = get_sequence(w.points(), data::kMaxRingPoints, d.points, get_point2))
    return refusal;
  d.sensor_width_m = w.sensor_width_m();
  d.height_tolerance_m = w.height_tolerance_m();
  d.height_band_m = w.height_band_m();
  d.neighbours = w.neighbours();
  d.vehicle = vehicle_limits(w.vehicle());
  if (const auto refusal = get_battery_limits(w.battery(), d.battery)) return refusal;
  if (const auto refusal = get_charger_limits(w.charger(), d.charger)) return refusal;
  d.start = vec3(w.start());
  d.seed = w.seed();
  d.has_terrain = w.has_terrain();
  return {};
}

void to_wire(const data::CoverageTask& d, swallowtail_wire::CoverageTask& w) {
  w.task_id() = d.task_id;
  w.revision() = d.revision;
  w.vehicle_id() = d.vehicle_id;
  w.origin() = geo_origin(d.origin);
  put_sequence(d.fields, w.fields(), put_field);
  put_sequence(d.rings, w.rings(), put_ring);
  put_sequence(d.points, w.points(), put_point2);
  w.sensor_width_m() = d.sensor_width_m;
  w.height_tolerance_m() = d.height_tolerance_m;
  w.height_band_m() = d.height_band_m;
  w.neighbours() = d.neighbours;
  w.vehicle() = vehicle_limits(d.vehicle);
  put_battery_limits(d.battery, w.battery());
  put_charger_limits(d.charger, w.charger());
  w.start() = vec3(d.start);
  w.seed() = d.seed;
  w.has_terrain() = d.has_terrain;
}

data::Refusal to_data(const swallowtail_wire::Goal& w, data::Goal& d) {
  d.vehicle_id = w.vehicle_id();
  d.revision = w.revision();
  d.origin = geo_origin(w.origin());
  d.start = vec3(w.start());
  d.position = vec3(w.position());
  d.arrive_by_s = w.arrive_by_s();
  d.vehicle = vehicle_limits(w.vehicle());
  d.bounds_min = vec3(w.bounds_min());
  d.bounds_max = vec3(w.bounds_max());
  d.seed = w.seed();
  d.has_terrain = w.has_terrain();
  return {};
}

void to_wire(const data::Goal& d, swallowtail_wire::Goal& w) {
  w.vehicle_id() = d.vehicle_id;
  w.revision() = d.revision;
  w.origin() = geo_origin(d.origin);
  w.start() = vec3(d.start);
  w.position() = vec3(d.position);
  w.arrive_by_s() = d.arrive_by_s;
  w.vehicle() = vehicle_limits(d.vehicle);
  w.bounds_min() = vec3(d.bounds_min);
  w.bounds_max() = vec3(d.bounds_max);
  w.seed() = d.seed;
  w.has_terrain() = d.has_terrain;
}

data::Refusal to_data(const swallowtail_wire::MissionClock& w, data::MissionClock& d) {
  d.time_s = w.time_s();
  d.rate = w.rate();
  if (!get_enum(w.state(), data::ClockState::kEnded, d.state)) return kBadEnumerator;
  return {};
}

void to_wire(const data::MissionClock& d, swallowtail_wire::MissionClock& w) {
  w.time_s() = d.time_s;
  w.rate() = d.rate;
  put_enum(d.state, w.state());
}

}  // namespace swallowtail::codec::fast
