#pragma once

#include <cstdint>

#include "coverage/energy/charging.hpp"
#include "coverage/energy/model.hpp"
#include "planner/base/rng.hpp"
#include "planner/base/vec.hpp"
#include "planner/scenario/scenario.hpp"

namespace swallowtail::sim {

/// What the aircraft does, as far as its battery minds.
struct Load {
  bool on_ground = true;
  Vec3 velocity_mps = Vec3::Zero();  ///< over ground
  double charge_rate = 0.0;          ///< units per second from the plug
  double altitude_m = 0.0;           ///< the frame's z
};

/// The battery's true state. Power is that of the scenario's energy model (coverage/energy/model.hpp) × (1 +
/// wind + noise) × consumption:
/// - wind: a multirotor's power is that of its speed through the air, and this is 0; with rates it is (|air
/// speed| − |ground speed|) / cruise speed, at least −0.5; the wind's speed deviates by gusts;
/// - noise: a slow wander of standard deviation `battery_noise`.
/// It takes no more from the plug than the scenario's charging curve allows with what it holds.
/// Gusts and noise are first-order autoregressive, drawn once per step whatever the aircraft does, so that a
/// seed gives one weather.
class Battery {
 public:
  /// `consumption`: what is drawn in truth against what the model says; 1 for a true model.
  Battery(const planner::Scenario& scenario, double capacity, std::uint64_t seed, double consumption = 1.0);

  void advance(const Load& load, double duration_s);
  /// Energy that is gone at once.
  void lose(double energy);
  /// Another of its kind, in the same weather.
  void replace(double capacity, double energy);

  double energy() const { return energy_; }
  double capacity() const { return capacity_; }
  /// Units per second over the last step, positive when discharging.
  double power() const { return power_; }
  double least_energy() const { return least_energy_; }
  bool empty() const { return energy_ <= 0.0; }
  Vec3 wind_mps() const;

 private:
  double model_power(const Load& load);
  double wind_share(const Load& load) const;
  void wander(double duration_s);

  coverage::EnergyModel model_;  ///< its wind is the one that blows
  const planner::WindSpec wind_;
  const double noise_;
  const double consumption_;
  const double cruise_speed_mps_;
  double capacity_;
  coverage::ChargingCurve charging_;
  Rng rng_;
  double gust_ = 0.0;   ///< −1 … 1
  double drift_ = 0.0;  ///< standard normal
  double energy_;
  double least_energy_;
  double power_ = 0.0;
};

}  // namespace swallowtail::sim
