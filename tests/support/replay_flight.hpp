#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "coverage/schedule/task.hpp"
#include "planner/base/vec.hpp"

/// An aircraft that flies step by step and empties its battery on the way. Takes data from the Task and no
/// code of what it judges.
namespace swallowtail::test_support {

using GroundAt = std::function<double(double x_m, double y_m)>;
/// Told where the aircraft is at the end of every step, and before the first.
using Watch = std::function<void(double time_s, const Vec3& at_m)>;

/// Units per second of a velocity over ground at an altitude, from the task's energy model, worked out anew.
double power_of(const coverage::Task& task, const Vec3& velocity_mps, double altitude_m);

class ReplayFlight {
 public:
  ReplayFlight(const coverage::Task& task, double step_s);

  void stand_at(const Vec3& site_m, double time_s, double energy);
  /// Straight on; level at cruise speed or, above or below the same place, vertical at climb or descent
  /// speed. A stop of a second between level and vertical flight and where the turn limit would be broken.
  void fly_to(const Vec3& place_m);
  void land(double ground_m);

  double time_s = 0.0;
  double energy = 0.0;
  Vec3 at_m = Vec3::Zero();
  double least_energy = 0.0;  ///< at any instant aloft so far
  Watch watch{};
  double flown_m = 0.0;
  double flown_s = 0.0;

 private:
  void spend(double duration_s, const Vec3& velocity_mps);
  void hover();

  const coverage::Task& task_;
  double step_s_;
  std::optional<Vec3> before_;  ///< direction of the last piece; none: on the ground
};

/// Altitude of a flight between two places that goes straight from corner to corner: the higher of its ends,
/// or what keeps the vehicle's clearance and a metre above the ground on the way, if it leads anywhere.
double altitude_over(const std::vector<Vec3>& way, double ends_m, const coverage::Task& task,
                     const GroundAt& ground);

}  // namespace swallowtail::test_support
