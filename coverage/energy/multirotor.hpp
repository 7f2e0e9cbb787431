#pragma once

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::coverage {

/// A multirotor as far as its power goes. The defaults are a quadrotor of 3 kg for surveys.
struct Multirotor {
  double mass_kg = 3.0;  ///< ready to fly, without payload
  double payload_kg = 0.0;
  int rotors = 4;
  double rotor_radius_m = 0.2;
  double drag_area_m2 = 0.04;    ///< drag coefficient × frontal area of body and payload
  double solidity = 0.1;         ///< blade area over disc area
  double blade_drag = 0.012;     ///< mean profile drag coefficient of the blades
  double tip_speed_mps = 80.0;   ///< of the blades
  double induced_factor = 1.15;  ///< induced power over the ideal
  double efficiency = 0.75;      ///< shaft power over electric power
  double avionics_w = 10.0;      ///< drawn besides, aloft
  double air_density_kgpm3 = 1.225;
  double air_speed_max_mps = 20.0;  ///< it does not fly faster through the air
};
/// Errors name the parameter and its rule.
Status validate(const Multirotor& craft);

/// Electric power, W, in steady flight at a velocity through the air: induced, profile and parasite power and
/// that of climbing. The induced velocity is Glauert's in forward flight [LEISHMAN 2.14], found for the
/// thrust that carries weight and drag together [STOLAROFF]; the profile power grows with the advance ratio
/// [LEISHMAN 5.4]. Departs from them in descent, where momentum theory does not hold: the potential energy is
/// taken to be lost and the discs to work as in level flight, which is more than a slow descent takes.
double power_w(const Multirotor& craft, const Vec3& air_velocity_mps);

/// Speed of the air through the discs that momentum theory gives for hovering.
double hover_induced_velocity_mps(const Multirotor& craft);

}  // namespace swallowtail::coverage
