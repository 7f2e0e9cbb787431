#pragma once

#include <cstdint>

#include "charger/charging/charging.hpp"
#include "idl/data/types.hpp"

namespace swallowtail::charger {

/// From and to the wire's values; the samples have passed data::validate.
Orders to_orders(const data::ChargerPlan& plan);
VehicleView to_view(const data::VehicleState& state, std::uint32_t charger_id);
BatteryView to_view(const data::BatteryState& state);
data::ChargerState to_data(const State& state, std::uint32_t charger_id, std::uint32_t vehicle_id);

}  // namespace swallowtail::charger
