#pragma once

#include "coverage/energy/model.hpp"
#include "planner/scenario/scenario.hpp"

namespace swallowtail::coverage {

/// The scenario's energy model. A multirotor's is that of the scenario's mean wind; other models leave wind
/// to the margins.
EnergyModel energy_model_of(const planner::Scenario& scenario);

/// The rates that stand for it where wind and altitude are left aside.
planner::EnergyRates still_air_rates_of(const planner::Scenario& scenario);

}  // namespace swallowtail::coverage
