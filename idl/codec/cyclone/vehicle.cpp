#include "idl/codec/cyclone/vehicle.hpp"

namespace swallowtail::codec::cyclone {

data::Refusal to_data(const swallowtail_VehicleState& w, data::VehicleState& d) {
  d.vehicle_id = w.vehicle_id;
  d.time_s = w.time_s;
  d.position = vec3(w.position);
  d.velocity_mps = vec3(w.velocity_mps);
  d.roll_rad = w.roll_rad;
  d.pitch_rad = w.pitch_rad;
  d.yaw_rad = w.yaw_rad;
  if (!get_enum(w.mode, data::VehicleMode::kDocked, d.mode)) return kBadEnumerator;
  d.docked_charger_id = w.docked_charger_id;
  d.path_revision = w.path_revision;
  d.coverage_revision = w.coverage_revision;
  d.leg_index = w.leg_index;
  d.legs_done = w.legs_done;
  return {};
}

void to_wire(const data::VehicleState& d, swallowtail_VehicleState& w) {
  w.vehicle_id = d.vehicle_id;
  w.time_s = d.time_s;
  w.position = vec3(d.position);
  w.velocity_mps = vec3(d.velocity_mps);
  w.roll_rad = d.roll_rad;
  w.pitch_rad = d.pitch_rad;
  w.yaw_rad = d.yaw_rad;
  put_enum(d.mode, w.mode);
  w.docked_charger_id = d.docked_charger_id;
  w.path_revision = d.path_revision;
  w.coverage_revision = d.coverage_revision;
  w.leg_index = d.leg_index;
  w.legs_done = d.legs_done;
}

data::Refusal to_data(const swallowtail_BatteryState& w, data::BatteryState& d) {
  d.vehicle_id = w.vehicle_id;
  d.time_s = w.time_s;
  d.energy = w.energy;
  d.capacity = w.capacity;
  d.power = w.power;
  d.health = w.health;
  return {};
}

void to_wire(const data::BatteryState& d, swallowtail_BatteryState& w) {
  w.vehicle_id = d.vehicle_id;
  w.time_s = d.time_s;
  w.energy = d.energy;
  w.capacity = d.capacity;
  w.power = d.power;
  w.health = d.health;
}

}  // namespace swallowtail::codec::cyclone
