#include "idl/codec/fastdds/common.hpp"

namespace swallowtail::codec::fast {

data::Vec3 vec3(const swallowtail_wire::Vector3& w) { return {w.x_m(), w.y_m(), w.z_m()}; }

swallowtail_wire::Vector3 vec3(const data::Vec3& d) {
  swallowtail_wire::Vector3 w;
  w.x_m() = d.x_m;
  w.y_m() = d.y_m;
  w.z_m() = d.z_m;
  return w;
}

data::GeoOrigin geo_origin(const swallowtail_wire::GeoOrigin& w) {
  return {w.lat_deg(), w.lon_deg(), w.elevation_m()};
}

swallowtail_wire::GeoOrigin geo_origin(const data::GeoOrigin& d) {
  swallowtail_wire::GeoOrigin w;
  w.lat_deg() = d.lat_deg;
  w.lon_deg() = d.lon_deg;
  w.elevation_m() = d.elevation_m;
  return w;
}

data::VehicleLimits vehicle_limits(const swallowtail_wire::VehicleLimits& w) {
  data::VehicleLimits d;
  d.radius_m = w.radius_m();
  d.margin_m = w.margin_m();
  d.cruise_speed_mps = w.cruise_speed_mps();
  d.climb_speed_mps = w.climb_speed_mps();
  d.descent_speed_mps = w.descent_speed_mps();
  d.turn_max_rad = w.turn_max_rad();
  d.climb_max_rad = w.climb_max_rad();
  return d;
}

swallowtail_wire::VehicleLimits vehicle_limits(const data::VehicleLimits& d) {
  swallowtail_wire::VehicleLimits w;
  w.radius_m() = d.radius_m;
  w.margin_m() = d.margin_m;
  w.cruise_speed_mps() = d.cruise_speed_mps;
  w.climb_speed_mps() = d.climb_speed_mps;
  w.descent_speed_mps() = d.descent_speed_mps;
  w.turn_max_rad() = d.turn_max_rad;
  w.climb_max_rad() = d.climb_max_rad;
  return w;
}

data::RobotBattery robot_battery(const swallowtail_wire::RobotBattery& w) {
  data::RobotBattery d;
  d.capacity = w.capacity();
  d.reserve = w.reserve();
  d.drive_per_s = w.drive_per_s();
  d.per_charged = w.per_charged();
  d.refill_s = w.refill_s();
  return d;
}

swallowtail_wire::RobotBattery robot_battery(const data::RobotBattery& d) {
  swallowtail_wire::RobotBattery w;
  w.capacity() = d.capacity;
  w.reserve() = d.reserve;
  w.drive_per_s() = d.drive_per_s;
  w.per_charged() = d.per_charged;
  w.refill_s() = d.refill_s;
  return w;
}

}  // namespace swallowtail::codec::fast
