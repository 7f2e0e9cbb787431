#pragma once

#include "idl/codec/cyclone/common.hpp"

#include "vehicle.h"

namespace swallowtail::codec::cyclone {

data::Refusal to_data(const swallowtail_VehicleState& wire, data::VehicleState& value);
void to_wire(const data::VehicleState& value, swallowtail_VehicleState& wire);
data::Refusal to_data(const swallowtail_BatteryState& wire, data::BatteryState& value);
void to_wire(const data::BatteryState& value, swallowtail_BatteryState& wire);

template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_VehicleState>() {
  return swallowtail_VehicleState_desc;
}
template <>
inline const dds_topic_descriptor_t& descriptor<swallowtail_BatteryState>() {
  return swallowtail_BatteryState_desc;
}

}  // namespace swallowtail::codec::cyclone
