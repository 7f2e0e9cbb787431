#pragma once

#include <span>
#include <vector>

#include "coverage/schedule/task.hpp"
#include "planner/base/result.hpp"

namespace swallowtail::coverage {

/// Least distances at the start.
struct StartsApart {
  double aircraft_m = 0.0;
  double robots_m = 0.0;  ///< of a robot from other teams' robots and aircraft
};

/// One task for each aircraft with its own robot: the first begins where the task says, the others around it,
/// outside holes and no-fly areas; a robot that stands beside its aircraft does so wherever this starts, if
/// it can drive to and from the task's own place, else it stands around that. Ids count up from the task's.
/// Errors (kInfeasible): there is no room within 100 rings.
Result<std::vector<Task>> tasks_of_fleet(const Task& task, int aircraft, const StartsApart& apart);

/// The same with given starts, of which the first `aircraft` are used. Errors (kBadInput): too few, nearer to
/// each other than asked, barred.
Result<std::vector<Task>> tasks_from_starts(const Task& task, int aircraft, const StartsApart& apart,
                                            std::span<const Vec2> starts_m);

}  // namespace swallowtail::coverage
