#pragma once

#include "coverage/maintain/plan_keeper.hpp"
#include "coverage/schedule/task.hpp"
#include "idl/data/types.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::coverage {

/// From and to the wire's values; the samples have passed data::validate. The task's: see task_of.hpp.
AircraftView to_view(const data::VehicleState& state);
BatteryView to_view(const data::BatteryState& state);
RobotView to_view(const data::ChargerState& state);
PathView to_view(const data::PathPlan& plan);

struct WirePlans {
  data::CoveragePlan coverage;
  data::ChargerPlan charger;
};
/// Both plans of one revision; `robot_m` is where the robot is now.
WirePlans to_wire(const PlanKeeper& keeper, const planner::Terrain& terrain, const Vec3& robot_m,
                  std::uint32_t terrain_revision);

/// A plan as found on the wire, to go on from. Rendezvous are made anew from the legs' transfers.
LivePlan from_wire(const data::CoveragePlan& plan, const Task& task, const planner::Terrain& terrain);

}  // namespace swallowtail::coverage
