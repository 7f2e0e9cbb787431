#pragma once

#include <cstddef>
#include <vector>

#include "coverage/energy/flight.hpp"
#include "coverage/schedule/plan.hpp"

namespace swallowtail::coverage {

/// Straight at an even speed, or standing: from_m and to_m are then one place. Mission seconds.
struct TimedPiece {
  Vec3 from_m = Vec3::Zero();
  Vec3 to_m = Vec3::Zero();
  double start_s = 0.0;
  double end_s = 0.0;
  bool is_landed = false;
};

/// Waiting on the ground, then flying until the next landing.
struct Stretch {
  /// Where aircraft or robot stand while it waits; both ends of a way on which it is carried.
  std::vector<Vec3> stands_m;
  double stands_from_s = 0.0;
  double take_off_s = 0.0;
  std::vector<TimedPiece> pieces;
};

/// Where a team of aircraft and robot is at all times, the robot's drives left out. Stretch i + 1 begins with
/// rendezvous i.
struct Trace {
  std::vector<Stretch> stretches;
  std::vector<std::size_t> stretch_of_leg;
  Vec3 end_m = Vec3::Zero();  ///< where it stays
  double end_s = 0.0;
};

/// A plan's flights, corner by corner with the stops to turn, as FlightModel predicts them. `model` is the
/// one that the plan was made with. At least one leg.
Trace trace_of(const Plan& plan, const Vec3& start_m, const FlightModel& model);

}  // namespace swallowtail::coverage
