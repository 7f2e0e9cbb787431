#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "coverage/energy/charging.hpp"
#include "coverage/energy/model.hpp"
#include "coverage/ground/ground_travel.hpp"
#include "planner/base/checks.hpp"
#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::coverage {

struct Battery {
  double capacity = 500.0;
  double reserve = 25.0;           ///< never to be used, on the ground neither
  int levels = 10;                 ///< k: steps of the graph [COV 3]; the schedule itself is continuous
  double charge_s_per_unit = 2.0;  ///< r
  double taper_from = 1.0;         ///< see ChargingCurve; 1: charging is linear
  double taper_end_rate = 0.1;
  EnergyModel model;

  ChargingCurve charging() const { return {charge_s_per_unit, capacity, taper_from, taper_end_rate}; }
};

/// The ground robot's own, full when it starts and whenever it leaves its depot, which is where it starts.
struct RobotBattery {
  double capacity = std::numeric_limits<double>::infinity();  ///< units; infinite: not limited
  double drive_per_s = 0.0;                                   ///< units for each second that it drives
  double per_charged = 1.0;  ///< units for each that the aircraft is charged with
  double refill_s = 0.0;     ///< at the depot
  double reserve = 0.0;      ///< that it keeps
};

/// The ground robot.
struct Charger {
  std::uint32_t id = 1;
  double speed_mps = 1.6;
  double take_off_s = 5.0;  ///< handling time on the robot, besides the flight itself
  double landing_s = 5.0;
  Vec3 start_m = Vec3::Zero();
  std::shared_ptr<const GroundTravel> travel{};  ///< none: straight over open ground at its speed
  RobotBattery battery{};
};

/// Seconds from one place to another; infinite when the robot cannot get there.
inline double drive_s(const Charger& charger, const Vec2& from, const Vec2& to) {
  return charger.travel ? charger.travel->drive_s(from, to) : (to - from).norm() / charger.speed_mps;
}
inline double drive_s(const Charger& charger, const Vec3& from, const Vec3& to) {
  return drive_s(charger, Vec2(from.head<2>()), Vec2(to.head<2>()));
}

/// The energy model is judged by itself: it needs the vehicle.
inline Status validate(const Battery& battery) {
  if (!is_positive(battery.capacity)) return bad_input("The battery's capacity must be positive.");
  if (!is_non_negative(battery.reserve) || battery.reserve >= battery.capacity)
    return bad_input("The battery's reserve must be at least 0 and below its capacity.");
  if (battery.levels < 1 || battery.levels > 1000)
    return bad_input("The battery must have 1 to 1000 levels.");
  if (!is_non_negative(battery.charge_s_per_unit))
    return bad_input("The charging time per unit must not be negative.");
  if (!is_within(battery.taper_from, 0.0, 1.0))
    return bad_input("The share of the capacity where charging slows down must be 0 to 1.");
  if (!is_within(battery.taper_end_rate, 1e-3, 1.0))
    return bad_input("The share of the charging rate left when full must be 0.001 to 1.");
  return {};
}

inline Status validate(const Charger& charger) {
  if (!is_positive(charger.speed_mps)) return bad_input("The charger's speed must be positive.");
  if (!is_non_negative(charger.take_off_s) || !is_non_negative(charger.landing_s))
    return bad_input("The charger's handling times must not be negative.");
  if (!is_finite(charger.start_m)) return bad_input("The charger's start must be finite.");
  const RobotBattery& battery = charger.battery;
  if (!(battery.capacity > 0.0)) return bad_input("The charger's own battery must hold more than nothing.");
  if (!is_non_negative(battery.drive_per_s) || !is_non_negative(battery.per_charged) ||
      !is_non_negative(battery.refill_s))
    return bad_input("What the charger's own battery gives and the time to refill it must not be negative.");
  if (!is_non_negative(battery.reserve) || battery.reserve >= battery.capacity)
    return bad_input("The reserve of the charger's own battery must be at least 0 and below its capacity.");
  return {};
}

}  // namespace swallowtail::coverage
