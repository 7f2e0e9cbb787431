#include "tools/sim/battery.hpp"

#include <algorithm>
#include <cmath>

#include "coverage/task/energy_of.hpp"

namespace swallowtail::sim {
namespace {

constexpr double kGustTime_s = 5.0;
constexpr double kDriftTime_s = 30.0;
constexpr double kLeastWindShare = -0.5;
constexpr double kMostDrift = 3.0;

coverage::ChargingCurve charging_of(const planner::Scenario& scenario, double capacity) {
  const planner::BatterySpec spec = scenario.coverage ? scenario.coverage->battery : planner::BatterySpec{};
  return {spec.charge_s_per_unit, capacity, spec.taper_from, spec.taper_end_rate};
}

}  // namespace

Battery::Battery(const planner::Scenario& scenario, double capacity, std::uint64_t seed, double consumption)
    : model_(coverage::energy_model_of(scenario)),
      wind_(scenario.wind),
      noise_(scenario.battery_noise),
      consumption_(consumption),
      cruise_speed_mps_(scenario.vehicle.limits.cruise_speed_mps),
      capacity_(capacity),
      charging_(charging_of(scenario, capacity)),
      rng_(seed),
      energy_(capacity),
      least_energy_(capacity) {
  drift_ = std::clamp(rng_.normal(), -kMostDrift, kMostDrift);
}

Vec3 Battery::wind_mps() const {
  const double speed_mps = std::max(0.0, wind_.speed_mps + wind_.gust_mps * gust_);
  return {speed_mps * std::sin(wind_.direction_rad), speed_mps * std::cos(wind_.direction_rad), 0.0};
}

double Battery::model_power(const Load& load) {
  if (load.on_ground) return model_.landed_per_s;
  model_.wind_mps = wind_mps().head<2>();
  return coverage::base_power(model_, load.velocity_mps) * coverage::altitude_factor(model_, load.altitude_m);
}

double Battery::wind_share(const Load& load) const {
  if (load.on_ground || model_.multirotor) return 0.0;
  const double air_mps = (load.velocity_mps - wind_mps()).norm();
  return std::max(kLeastWindShare, (air_mps - load.velocity_mps.norm()) / cruise_speed_mps_);
}

void Battery::wander(double duration_s) {
  const auto pull = [this, duration_s](double& value, double time_s) {
    const double kept = std::exp(-duration_s / time_s);
    value = kept * value + std::sqrt(1.0 - kept * kept) * rng_.normal();
  };
  double gust = 2.0 * gust_;  // gusts reach their greatest deviation at two standard deviations
  pull(gust, kGustTime_s);
  gust_ = std::clamp(0.5 * gust, -1.0, 1.0);
  pull(drift_, kDriftTime_s);
  drift_ = std::clamp(drift_, -kMostDrift, kMostDrift);
}

void Battery::advance(const Load& load, double duration_s) {
  if (!(duration_s > 0.0)) return;
  wander(duration_s);
  const double noise = load.on_ground ? 0.0 : noise_ * drift_;
  const double before = energy_;
  const double drawn = consumption_ * model_power(load) * std::max(0.0, 1.0 + wind_share(load) + noise);
  const double charged =
      charging_.is_linear() ? load.charge_rate : std::min(load.charge_rate, charging_.rate(energy_));
  energy_ = std::clamp(energy_ + (charged - drawn) * duration_s, 0.0, capacity_);
  power_ = (before - energy_) / duration_s;
  least_energy_ = std::min(least_energy_, energy_);
}

void Battery::replace(double capacity, double energy) {
  capacity_ = capacity;
  charging_.full = capacity;
  energy_ = energy;
  least_energy_ = std::min(least_energy_, energy_);
}

void Battery::lose(double energy) {
  energy_ = std::max(0.0, energy_ - std::max(0.0, energy));
  least_energy_ = std::min(least_energy_, energy_);
}

}  // namespace swallowtail::sim
