#pragma once

#include <optional>

#include "coverage/energy/multirotor.hpp"
#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"
#include "planner/path/path.hpp"

namespace swallowtail::coverage {

/// By what flying was found to take more than the model says: level flight takes (all + along · heading)
/// times as much, flight straight up or down and hovering (all + upright) times.
struct Correction {
  double all = 1.0;
  Vec2 along = Vec2::Zero();
  double upright = 0.0;
};

/// What flying takes, in the battery's unit. The default is the document's: one unit per unit of flying time,
/// nothing on the ground [COV 3].
struct EnergyModel {
  double level_per_s = 1.0;
  double climb_per_s = 1.0;
  double descent_per_s = 1.0;
  double hover_per_s = 1.0;
  double landed_per_s = 0.0;
  /// All consumption aloft grows by this share for each metre above `altitude_from_m` (in the frame's z: a
  /// field's ground, or the sea), where the air is thinner.
  double altitude_per_m = 0.0;
  double altitude_from_m = 0.0;
  std::optional<Multirotor> multirotor{};  ///< when set, aloft instead of the four rates
  double unit_j = 3600.0;                  ///< joules in a unit, for the multirotor: by default it is a Wh
  Vec2 wind_mps = Vec2::Zero();  ///< where it blows to; the multirotor flies at its speed over ground
                                 ///< all the same, and its power is that of the speed through the air
  Correction correction{};       ///< learnt in flight
};

/// Errors name the value and the rule: rates positive in level flight and climb, none negative; a multirotor
/// that cannot hold the vehicle's speeds against the wind.
Status validate(const EnergyModel& model, const planner::VehicleLimits& limits);

/// 1 up to altitude_from_m, more above.
double altitude_factor(const EnergyModel& model, double altitude_m);
/// Its mean on the way from one altitude to another, exact.
double mean_altitude_factor(const EnergyModel& model, double from_m, double to_m);

/// East and north of where a flight goes, as far as it is level: of length 1 when it is, 0 when it goes
/// straight up or down or hovers, and between in the shares of the two speeds.
Vec2 level_heading(const Vec3& velocity_mps);
/// Units per second aloft at a velocity over ground, where the altitude factor is 1. Rates of a flight that
/// is neither level nor vertical are mixed in the shares of the two speeds.
double base_power(const EnergyModel& model, const Vec3& velocity_mps);
/// The greatest of all level directions.
double greatest_level_power(const EnergyModel& model, double speed_mps);

/// The four rates that the model has for a vehicle in still air at the altitude where the factor is 1.
EnergyModel still_air_rates(const EnergyModel& model, const planner::VehicleLimits& limits);

}  // namespace swallowtail::coverage
