#pragma once

#include <vector>

#include "coverage/schedule/task.hpp"
#include "planner/base/result.hpp"

namespace swallowtail::coverage {

/// One task for each aircraft with its own robot: the first begins where the task says, the others around it,
/// all `apart_m` from each other and outside holes and no-fly areas, the robots where they can drive to and
/// from the task's own (together in its place where there is no such spot). Ids count up from the task's.
/// Errors (kInfeasible): there is no room within 100 rings.
Result<std::vector<Task>> tasks_of_fleet(const Task& task, int aircraft, double apart_m);

}  // namespace swallowtail::coverage
