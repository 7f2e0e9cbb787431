#pragma once

#include <cmath>
#include <string>

#include "idl/data/types.hpp"
#include "planner/base/checks.hpp"

/// The ranges of the data contract, in one place. NaN fails every check.
namespace swallowtail::data::ranges {

inline constexpr double kMaxHorizontal_m = 1e6;
inline constexpr double kMinHeight_m = -1e3;
inline constexpr double kMaxHeight_m = 2e4;
inline constexpr double kMaxTime_s = 1e7;
inline constexpr double kForever_s = 1e9;
inline constexpr double kMaxSpeed_mps = 200.0;
inline constexpr double kMaxSize_m = 1e4;
inline constexpr double kMaxAngle_rad = 6.2832;  // a full turn either way
inline constexpr double kMaxTurn_rad = 3.1416;   // half a turn: no limit
inline constexpr double kMaxClimb_rad = 1.5708;  // straight up: no limit
inline constexpr double kMaxEnergy = 1e9;        // also for times per unit of energy
inline constexpr double kMaxPower = 1e6;
inline constexpr double kMaxRate = 1e4;
inline constexpr double kMaxTotal = 1e15;  // areas, costs and other sums
inline constexpr double kFlat_m = 1e-6;
inline constexpr double kSameTime_s = 1e-6;  // rounding allowed between times that should not fall

inline bool is_horizontal(double v) { return is_within(v, -kMaxHorizontal_m, kMaxHorizontal_m); }
inline bool is_height(double v) { return is_within(v, kMinHeight_m, kMaxHeight_m); }
inline bool is_position(const data::Vec3& v) {
  return is_horizontal(v.x_m) && is_horizontal(v.y_m) && is_height(v.z_m);
}
inline bool is_velocity(const data::Vec3& v) {
  return v.x_m * v.x_m + v.y_m * v.y_m + v.z_m * v.z_m <= kMaxSpeed_mps * kMaxSpeed_mps;
}
inline bool is_speed(double v) { return is_within(v, 0.0, kMaxSpeed_mps); }
inline bool is_positive_speed(double v) { return v > 0.0 && v <= kMaxSpeed_mps; }
inline bool is_time(double v) { return is_within(v, 0.0, kMaxTime_s); }
inline bool is_size(double v) { return v > 0.0 && v <= kMaxSize_m; }
inline bool is_angle(double v) { return is_within(v, -kMaxAngle_rad, kMaxAngle_rad); }
inline bool is_energy(double v) { return is_within(v, 0.0, kMaxEnergy); }
inline bool is_total(double v) { return is_within(v, 0.0, kMaxTotal); }
inline bool is_origin(const GeoOrigin& v) {
  return is_within(v.lat_deg, -90.0, 90.0) && is_within(v.lon_deg, -180.0, 180.0) && is_height(v.elevation_m);
}

/// Of the ground robot's own, see RobotBattery.
inline bool is_robot_battery(const RobotBattery& v) {
  return v.capacity > 0.0 && v.capacity <= kMaxEnergy && is_within(v.reserve, 0.0, v.capacity) &&
         v.reserve < v.capacity && is_within(v.drive_per_s, 0.0, kMaxPower) &&
         is_within(v.per_charged, 0.0, kMaxPower) && is_time(v.refill_s);
}

/// Where charging slows down and what is left of its rate, see BatteryLimits.
inline bool is_taper(double from, double end_rate) {
  return is_within(from, 0.0, 1.0) && is_within(end_rate, 1e-3, 1.0);
}

/// Texts end at a NUL on the wire.
inline bool is_text(const std::string& text, std::size_t bound) {
  return text.size() <= bound && text.find('\0') == std::string::npos;
}

}  // namespace swallowtail::data::ranges
