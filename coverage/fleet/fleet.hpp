#pragma once

#include <string>
#include <vector>

#include "coverage/fleet/separation.hpp"
#include "coverage/schedule/plan.hpp"

namespace swallowtail::coverage {

inline constexpr int kMaxAircraft = 32;

struct FleetOptions {
  int aircraft = 2;
  Separation separation;
  /// A plan for the whole task by one aircraft, with the same options; none: it is made.
  const Plan* alone = nullptr;
  /// Where they start, the first ones are used; none: around the task's start.
  std::vector<Vec2> starts_m{};
};

/// What one aircraft and its robot do: a plan of its own sub-cells, whole by itself. Reports of fields and
/// what they sum up to are the whole task's. Mission time is the fleet's: the aircraft waits at its start
/// until plan.take_off_s.
struct Member {
  Task task;  ///< with its own start, robot and ids
  Plan plan;
  double delay_s = 0.0;  ///< waited on the ground to keep its distance
};

struct FleetPlan {
  std::vector<Member> members;
  double makespan_s = 0.0;  ///< until the last landing of all
  double alone_s = 0.0;     ///< one aircraft's
  Separation separation;
  std::string note;  ///< a sentence when fewer aircraft are used than were asked for
};

/// Several aircraft of the task's type, each with its own ground robot, for one task: each sub-cell is flown
/// by one of them; at all times any two teams keep the separation, waiting on the ground where they must;
/// this holds for landed aircraft too (the last landing's place included) and for robots wherever they stand
/// or drive. A robot leaves for its rendezvous in time to arrive when the plan says, and not before it is
/// free. Deterministic as plan_coverage. Errors: those of
/// plan_coverage; (kBadInput) fewer than one aircraft or more than sub-cells or than kMaxAircraft, a
/// separation that is not positive, starts that are too few, too near each other or barred; (kInfeasible) no
/// shares can be flown, or no delays keep the separation.
Result<FleetPlan> plan_fleet(const Task& task, const planner::Terrain& terrain, const PlanOptions& options,
                             const FleetOptions& fleet);

/// The same with as many of the aircraft asked for as take no longer than one alone, which may be one; `note`
/// then says so. Errors as plan_fleet, except that fewer aircraft are tried where more cannot be planned.
Result<FleetPlan> plan_useful_fleet(const Task& task, const planner::Terrain& terrain,
                                    const PlanOptions& options, const FleetOptions& fleet);

}  // namespace swallowtail::coverage
