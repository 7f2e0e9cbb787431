#pragma once

#include "coverage/schedule/plan.hpp"

namespace swallowtail::coverage {

/// Lets a robot with a battery of its own (Charger::battery) fetch new energy at its depot, the place where
/// it starts: between which rendezvous it drives there is chosen so that the aircraft waits least, the order
/// and everything that is flown staying as they are; later times move on by what it waits. After the last
/// rendezvous the robot drives home. Nothing changes where its battery is not limited or nobody meets it.
/// Errors (kInfeasible): a rendezvous and the way there and back ask for more than it holds, named with its
/// place; or the aircraft would have to wait on the ground beyond its reserve.
/// Beyond [COV], whose robot has energy without end. Exact for the given order and landings, which are chosen
/// without regard to the robot's battery.
Status limit_robot(const Task& task, const FlightModel& model, Plan& plan);

}  // namespace swallowtail::coverage
