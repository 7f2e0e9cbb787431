#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "charger/charging/charging.hpp"

namespace swallowtail::charger {

/// The other side of a Charging: a vehicle that lands where it is told to, is charged at the robot's rate and
/// reports with a delay of one step.
struct Partner {
  Vec3 position_m = Vec3::Zero();
  VehicleActivity activity = VehicleActivity::kOnGround;
  bool on_board = false;
  std::uint32_t legs_done = 0;
  double energy = 50.0;
  double capacity = 100.0;

  void fly_off() {
    activity = VehicleActivity::kFlying;
    on_board = false;
  }
  void land_at(const Vec3& site_m) {
    position_m = site_m;
    activity = VehicleActivity::kOnGround;
  }
};

/// Steps a Charging and its Partner through mission time.
struct Meet {
  static constexpr double kStep_s = 0.1;

  explicit Meet(Orders orders, std::vector<Delay> delays = {})
      : charging(Charging::make(std::move(orders), std::move(delays)).value()) {}

  Inputs inputs() const {
    return {.vehicle = VehicleView{.position_m = partner.position_m,
                                   .activity = partner.activity,
                                   .docked_here = partner.on_board,
                                   .legs_done = partner.legs_done},
            .battery = BatteryView{.time_s = time_s, .energy = partner.energy, .capacity = partner.capacity}};
  }

  const State& step(double duration_s = kStep_s) {
    const Inputs seen = inputs();
    const State before = charging.state();
    if (before.has_vehicle && partner.activity == VehicleActivity::kOnGround) {
      partner.on_board = true;
      partner.position_m = before.position_m;
      partner.energy = std::min(partner.capacity, partner.energy + before.charge_rate * duration_s);
    }
    time_s += duration_s;
    return charging.step(time_s, seen);
  }

  /// Steps until the activity is reached; false after `limit_s`.
  bool reaches(Activity activity, double limit_s = 5000.0) {
    const double end_s = time_s + limit_s;
    while (charging.state().activity != activity && time_s < end_s) step();
    return charging.state().activity == activity;
  }

  void run(double duration_s) {
    const double end_s = time_s + duration_s;
    while (time_s < end_s) step();
  }

  Charging charging;
  Partner partner;
  double time_s = 0.0;
};

inline Orders two_meetings() {
  Orders orders;
  orders.revision = 1;
  orders.speed_mps = 2.0;
  orders.charge_s_per_unit = 2.0;
  orders.landing_s = 5.0;
  orders.take_off_s = 3.0;
  orders.meetings = {
      Meeting{.id = 1, .site_m = Vec3(40, 0, 0), .charge_to = 80.0, .carry_to_m = {}},
      Meeting{.id = 4, .site_m = Vec3(40, 60, 0), .charge_to = 100.0, .carry_to_m = Vec3(0, 60, 0)}};
  return orders;
}

}  // namespace swallowtail::charger
