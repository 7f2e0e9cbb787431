#include "coverage/energy/model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kStill_mps = 1e-3;

double multirotor_power(const EnergyModel& model, const Vec3& velocity_mps) {
  const Vec3 air(velocity_mps.x() - model.wind_mps.x(), velocity_mps.y() - model.wind_mps.y(),
                 velocity_mps.z());
  return power_w(*model.multirotor, air) / model.unit_j;
}

double plain_power(const EnergyModel& model, const Vec3& velocity_mps) {
  if (model.multirotor) return multirotor_power(model, velocity_mps);
  const double level = velocity_mps.head<2>().norm();
  const double vertical = std::abs(velocity_mps.z());
  if (level + vertical < kStill_mps) return model.hover_per_s;
  const double vertical_rate = velocity_mps.z() > 0.0 ? model.climb_per_s : model.descent_per_s;
  if (vertical == 0.0) return model.level_per_s;
  return (model.level_per_s * level + vertical_rate * vertical) / (level + vertical);
}

std::string text(double value) {
  std::string out = std::to_string(value);
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

}  // namespace

Status validate(const EnergyModel& model, const planner::VehicleLimits& limits) {
  if (!is_positive(model.level_per_s) || !is_positive(model.climb_per_s) ||
      !is_non_negative(model.descent_per_s) || !is_non_negative(model.hover_per_s) ||
      !is_non_negative(model.landed_per_s)) {
    return bad_input(
        "The energy model's rates must be finite, positive for level flight and climb, and not negative "
        "elsewhere.");
  }
  if (!is_non_negative(model.altitude_per_m) || !is_finite(model.altitude_from_m))
    return bad_input(
        "The energy model's altitude factor must not be negative, and begin at a finite altitude.");
  if (!is_finite(model.wind_mps)) return bad_input("The energy model's wind must be finite.");
  if (!model.multirotor) return {};
  if (!is_positive(model.unit_j)) return bad_input("The unit of energy must be a positive number of joules.");
  if (const Status status = validate(*model.multirotor); !status) return status;
  const double against =
      std::max({limits.cruise_speed_mps, limits.climb_speed_mps, limits.descent_speed_mps}) +
      model.wind_mps.norm();
  if (against > model.multirotor->air_speed_max_mps + 1e-9) {
    return bad_input("The multirotor would have to fly at " + text(against) +
                     " m/s through the air, against the wind; it does not fly faster than " +
                     text(model.multirotor->air_speed_max_mps) + " m/s.");
  }
  return {};
}

double altitude_factor(const EnergyModel& model, double altitude_m) {
  return 1.0 + model.altitude_per_m * std::max(0.0, altitude_m - model.altitude_from_m);
}

double mean_altitude_factor(const EnergyModel& model, double from_m, double to_m) {
  const double low = std::min(from_m, to_m) - model.altitude_from_m;
  const double high = std::max(from_m, to_m) - model.altitude_from_m;
  if (model.altitude_per_m == 0.0 || high <= 0.0) return 1.0;
  if (low >= 0.0) return 1.0 + model.altitude_per_m * (low + high) / 2.0;
  return 1.0 + model.altitude_per_m * high * high / (2.0 * (high - low));
}

Vec2 level_heading(const Vec3& velocity_mps) {
  const double both = velocity_mps.head<2>().norm() + std::abs(velocity_mps.z());
  return both < kStill_mps ? Vec2(Vec2::Zero()) : Vec2(velocity_mps.head<2>() / both);
}

double base_power(const EnergyModel& model, const Vec3& velocity_mps) {
  const Correction& found = model.correction;
  const Vec2 heading = level_heading(velocity_mps);
  return plain_power(model, velocity_mps) *
         (found.all + found.along.dot(heading) + found.upright * (1.0 - heading.norm()));
}

double greatest_level_power(const EnergyModel& model, double speed_mps) {
  const double correction = model.correction.all + model.correction.along.norm();
  if (!model.multirotor) return correction * model.level_per_s;
  // Over the speed through the air the power falls, then rises: the greatest is at one end of its range.
  const double wind = model.wind_mps.norm();
  const Vec2 along = wind > 0.0 ? Vec2(model.wind_mps / wind) : Vec2(Vec2::UnitX());
  const Vec3 with(along.x() * speed_mps, along.y() * speed_mps, 0.0);
  return correction * std::max(multirotor_power(model, with), multirotor_power(model, -with));
}

EnergyModel still_air_rates(const EnergyModel& model, const planner::VehicleLimits& limits) {
  EnergyModel out;
  out.landed_per_s = model.landed_per_s;
  EnergyModel still = model;
  still.wind_mps = Vec2::Zero();
  still.correction = {};
  out.level_per_s = base_power(still, Vec3(limits.cruise_speed_mps, 0.0, 0.0));
  out.climb_per_s = base_power(still, Vec3(0.0, 0.0, limits.climb_speed_mps));
  out.descent_per_s = base_power(still, Vec3(0.0, 0.0, -limits.descent_speed_mps));
  out.hover_per_s = base_power(still, Vec3::Zero());
  return out;
}

}  // namespace swallowtail::coverage
