#pragma once

#include <cstdint>

#include "coverage/energy/model.hpp"
#include "planner/base/checks.hpp"
#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::coverage {

struct Battery {
  double capacity = 500.0;
  double reserve = 25.0;           ///< never to be used, on the ground neither
  int levels = 10;                 ///< k: steps of the graph [COV 3]; the schedule itself is continuous
  double charge_s_per_unit = 2.0;  ///< r
  EnergyModel model;
};

/// The ground robot.
struct Charger {
  std::uint32_t id = 1;
  double speed_mps = 1.6;
  double take_off_s = 5.0;  ///< handling time on the robot, besides the flight itself
  double landing_s = 5.0;
  Vec3 start_m = Vec3::Zero();
};

/// The energy model is judged by itself: it needs the vehicle.
inline Status validate(const Battery& battery) {
  if (!is_positive(battery.capacity)) return bad_input("The battery's capacity must be positive.");
  if (!is_non_negative(battery.reserve) || battery.reserve >= battery.capacity)
    return bad_input("The battery's reserve must be at least 0 and below its capacity.");
  if (battery.levels < 1 || battery.levels > 1000)
    return bad_input("The battery must have 1 to 1000 levels.");
  if (!is_non_negative(battery.charge_s_per_unit))
    return bad_input("The charging time per unit must not be negative.");
  return {};
}

inline Status validate(const Charger& charger) {
  if (!is_positive(charger.speed_mps)) return bad_input("The charger's speed must be positive.");
  if (!is_non_negative(charger.take_off_s) || !is_non_negative(charger.landing_s))
    return bad_input("The charger's handling times must not be negative.");
  if (!is_finite(charger.start_m)) return bad_input("The charger's start must be finite.");
  return {};
}

}  // namespace swallowtail::coverage
