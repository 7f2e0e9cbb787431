#pragma once

#include <optional>
#include <span>
#include <vector>

#include "coverage/schedule/plan.hpp"

namespace swallowtail::coverage {

/// Where a robot with a battery of its own is, and what it holds.
struct RobotStart {
  Vec3 at_m = Vec3::Zero();
  double energy = 0.0;
  double free_s = 0.0;  ///< when it may leave
  /// Of the aircraft that is on the ground at the first meeting; without it what the meeting says.
  std::optional<double> aircraft_energy{};
  bool has_aircraft = false;   ///< on board: it does not go to its depot before the first meeting is over
  double charge_factor = 1.0;  ///< charges are taken to be so many times what is planned
};

/// What the trips make of a plan.
struct RobotTrips {
  std::vector<DepotVisit> visits;
  std::vector<Vec3> home_bends_m;  ///< after the last meeting
  double home_s = 0.0;
  double delay_s = 0.0;  ///< of the end
  double wait_s = 0.0;   ///< of the aircraft, in all
  double energy_min = 0.0;
  int recharges = 0;  ///< more than without them
};

/// Lets a robot with a battery of its own (Charger::battery) fetch new energy at its depot, the place where
/// it starts: between which meetings it drives there is chosen so that the aircraft waits least, the order
/// and everything that is flown staying as they are; later times move on by what it waits, and meetings learn
/// what the robot holds. `legs` is the whole plan's, `meetings` are those ahead and not none. Meetings that
/// allow for a trip already cost nothing more by one, so that plans may pass through here again.
/// Errors (kInfeasible): a meeting and the way there and back ask for more than it holds, named with its
/// place; or the aircraft would have to wait on the ground beyond its reserve. Nothing is changed then.
/// Beyond [COV], whose robot has energy without end. Exact for the given order and landings, which are chosen
/// without regard to the robot's battery.
Result<RobotTrips> plan_trips(const Task& task, const FlightModel& model, const RobotStart& start,
                              std::span<Leg> legs, std::span<Rendezvous> meetings);

/// Where that has no answer: each trip as late as can be. A meeting that asks for more than the robot can
/// give at once lasts as long as it takes it to fetch the rest, which is not foreseen here.
RobotTrips plan_late_trips(const Task& task, const FlightModel& model, const RobotStart& start,
                           std::span<Leg> legs, std::span<Rendezvous> meetings);

/// Whether the robot can keep the meetings up to the next stop at its depot, and get there, as planned.
bool lasts(const Task& task, const FlightModel& model, const RobotStart& start,
           std::span<const Rendezvous> meetings);

/// plan_trips for a plan that is not flown yet. Nothing changes where the robot's battery is not limited or
/// nobody meets it.
Status limit_robot(const Task& task, const FlightModel& model, Plan& plan);

}  // namespace swallowtail::coverage
