#pragma once

#include "idl/codec/fastdds/common.hpp"

#define swallowtail swallowtail_wire
#include "vehicle.h"
#undef swallowtail

namespace swallowtail::codec::fast {

data::Refusal to_data(const swallowtail_wire::VehicleState& wire, data::VehicleState& value);
void to_wire(const data::VehicleState& value, swallowtail_wire::VehicleState& wire);
data::Refusal to_data(const swallowtail_wire::BatteryState& wire, data::BatteryState& value);
void to_wire(const data::BatteryState& value, swallowtail_wire::BatteryState& wire);

}  // namespace swallowtail::codec::fast
