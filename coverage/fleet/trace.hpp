#pragma once

#include <cstddef>
#include <vector>

#include "coverage/energy/flight.hpp"
#include "coverage/schedule/plan.hpp"
#include "coverage/schedule/task.hpp"

namespace swallowtail::coverage {

/// Straight at an even speed, or standing: from_m and to_m are then one place. Mission seconds.
struct TimedPiece {
  Vec3 from_m = Vec3::Zero();
  Vec3 to_m = Vec3::Zero();
  double start_s = 0.0;
  double end_s = 0.0;
  bool is_landed = false;
};

/// The robot from the take-off on: it stands, drives, and stands where it has driven.
struct Drive {
  Vec3 from_m = Vec3::Zero();
  double free_s = 0.0;
  std::vector<TimedPiece> pieces;  ///< standing at its depot in between included; empty: it is there
  double until_s = 0.0;            ///< the next landing, infinite: for good

  double slack_s() const { return pieces.empty() ? 0.0 : until_s - pieces.back().end_s; }
  TimedPiece stand_before() const;
  TimedPiece stand_after() const;  ///< not where it is there before
};

/// Waiting on the ground, then flying until the next landing.
struct Stretch {
  /// Where aircraft or robot stand while it waits; both ends of a way on which it is carried.
  std::vector<Vec3> stands_m;
  double stands_from_s = 0.0;
  double take_off_s = 0.0;
  std::vector<TimedPiece> pieces;  ///< the robot's while it carries the aircraft to where it waits included
  Drive drive;
};

/// Where a team of aircraft and robot is at all times. Stretch i + 1 begins with rendezvous i.
struct Trace {
  std::vector<Stretch> stretches;
  std::vector<std::size_t> stretch_of_leg;
  Vec3 end_m = Vec3::Zero();  ///< where the aircraft stays
  double end_s = 0.0;
};

TimedPiece standing(const Vec3& at_m, double from_s, double to_s);

/// Everything that a team takes up, in the order of the stretches; the last stands for good.
std::vector<TimedPiece> pieces_of(const Trace& trace);

/// A plan's flights, corner by corner with the stops to turn, as FlightModel predicts them, and its robot's
/// drives: it leaves in time to arrive when the plan says. `model` is the one that the plan was made with. At
/// least one leg.
Trace trace_of(const Plan& plan, const Task& task, const FlightModel& model);

}  // namespace swallowtail::coverage
