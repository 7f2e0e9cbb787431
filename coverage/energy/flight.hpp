#pragma once

#include <optional>
#include <vector>

#include "coverage/energy/battery.hpp"
#include "coverage/field/ways.hpp"
#include "planner/base/vec.hpp"
#include "planner/path/path.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::coverage {

/// What a stretch of flight takes. They add up.
struct FlightCost {
  double time_s = 0.0;
  double energy = 0.0;
  double length_m = 0.0;

  FlightCost& operator+=(const FlightCost& other) {
    time_s += other.time_s;
    energy += other.energy;
    length_m += other.length_m;
    return *this;
  }
  friend FlightCost operator+(FlightCost a, const FlightCost& b) { return a += b; }
  friend FlightCost operator-(FlightCost a, const FlightCost& b) {
    a += FlightCost{-b.time_s, -b.energy, -b.length_m};
    return a;
  }
};

/// What flying takes where there is no way: no battery holds it. Not to be added up with what is taken off
/// again.
inline constexpr FlightCost kBarred{1e9, 1e12, 0.0};

/// Predicts flights the way the planner flies them (planner::time_route): level at cruise speed, vertical
/// climbs first and descents last, a stop of planner::kStopToTurn_s where a vertical part begins or ends in
/// the air and where the turn limit would be broken. Transfers climb over the ground between their ends where
/// it stands higher than they are, and go round what `ways` leaves aside; where there is no way, they take
/// what no battery holds. Borrows the terrain and the ways.
class FlightModel {
 public:
  FlightModel(const planner::VehicleLimits& limits, const EnergyModel& energy,
              const planner::Terrain& terrain, const Ways* ways = nullptr);

  /// Level and straight, at the altitude of both.
  FlightCost level(const Vec3& from, const Vec3& to) const;
  /// Straight up or down from one altitude to another.
  FlightCost vertical(double from_m, double to_m) const;
  /// Units per second aloft at a velocity over ground.
  double power(const Vec3& velocity_mps, double altitude_m) const {
    return base_power(energy_, velocity_mps) * altitude_factor(energy_, altitude_m);
  }
  /// To turn, at an altitude.
  FlightCost stop(double altitude_m) const;

  /// From the ground below `at` up to it, standing there ready to go any way.
  FlightCost take_off(const Vec3& at) const;
  /// From `at` down to the ground, the stop before included.
  FlightCost landing(const Vec3& at) const;

  /// Directions (of any length) flown before and after a transfer; none: it stands still there.
  struct Ends {
    std::optional<Vec3> before;
    std::optional<Vec3> after;
  };
  /// In the air from one place to another, stops included.
  FlightCost transfer(const Vec3& from, const Vec3& to, const Ends& ends) const;
  /// From the ground below `from` to `to` in the air.
  FlightCost take_off_to(const Vec3& from, const Vec3& to, const std::optional<Vec3>& after) const;
  /// In the air from `from` to the ground below `to`.
  FlightCost transfer_and_land(const Vec3& from, const std::optional<Vec3>& before, const Vec3& to) const;

  /// Whether there is no way in the air from one place to another.
  bool is_barred(const Vec3& from, const Vec3& to) const;
  /// The places a transfer leads through where it is not barred, at its altitude, both ends' included: from
  /// there it climbs or descends to `from` and `to`. Between places above each other it rises above neither.
  std::vector<Vec3> way(const Vec3& from, const Vec3& to) const;

  /// The site on the ground below a place.
  Vec3 ground(const Vec3& at) const;
  const planner::Terrain& terrain() const { return *terrain_; }
  const planner::VehicleLimits& limits() const { return limits_; }
  const EnergyModel& energy_model() const { return energy_; }

 private:
  double transfer_altitude(const Vec3& from, const Vec3& to) const { return way(from, to).front().z(); }
  /// Stop or not between two directions.
  FlightCost turn(const Vec3& before, const Vec3& after, double altitude_m) const;
  double level_power(const Vec3& along) const;
  FlightCost level_part(const std::vector<Vec3>& way, const Ends& ends) const;

  planner::VehicleLimits limits_;
  EnergyModel energy_;
  bool in_wind_;  ///< so that level flight's power depends on its direction
  double level_per_s_;
  double climb_per_s_;
  double descent_per_s_;
  double hover_per_s_;
  const planner::Terrain* terrain_;
  const Ways* ways_;
};

}  // namespace swallowtail::coverage
