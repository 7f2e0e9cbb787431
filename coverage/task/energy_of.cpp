#include "coverage/task/energy_of.hpp"

#include <cmath>

namespace swallowtail::coverage {

EnergyModel energy_model_of(const planner::Scenario& scenario) {
  const planner::EnergyRates& rates = scenario.vehicle.energy;
  EnergyModel out{rates.level_per_s, rates.climb_per_s, rates.descent_per_s, rates.hover_per_s,
                  rates.landed_per_s};
  out.altitude_per_m = rates.altitude_per_m;
  out.altitude_from_m = rates.altitude_from_m;
  if (!scenario.vehicle.multirotor) return out;
  const planner::MultirotorSpec& spec = *scenario.vehicle.multirotor;
  out.multirotor = Multirotor{.mass_kg = spec.mass_kg,
                              .payload_kg = spec.payload_kg,
                              .rotors = spec.rotors,
                              .rotor_radius_m = spec.rotor_radius_m,
                              .drag_area_m2 = spec.drag_area_m2,
                              .solidity = spec.solidity,
                              .blade_drag = spec.blade_drag,
                              .tip_speed_mps = spec.tip_speed_mps,
                              .induced_factor = spec.induced_factor,
                              .efficiency = spec.efficiency,
                              .avionics_w = spec.avionics_w,
                              .air_density_kgpm3 = spec.air_density_kgpm3,
                              .air_speed_max_mps = spec.air_speed_max_mps};
  out.unit_j = spec.unit_j;
  const planner::WindSpec& wind = scenario.wind;
  out.wind_mps = wind.speed_mps * Vec2(std::sin(wind.direction_rad), std::cos(wind.direction_rad));
  return out;
}

planner::EnergyRates still_air_rates_of(const planner::Scenario& scenario) {
  const EnergyModel rates = still_air_rates(energy_model_of(scenario), scenario.vehicle.limits);
  return {.level_per_s = rates.level_per_s,
          .climb_per_s = rates.climb_per_s,
          .descent_per_s = rates.descent_per_s,
          .hover_per_s = rates.hover_per_s,
          .landed_per_s = rates.landed_per_s};
}

}  // namespace swallowtail::coverage
