#pragma once

#include <span>
#include <vector>

#include "coverage/schedule/task.hpp"
#include "planner/base/result.hpp"

namespace swallowtail::coverage {

/// One task for each aircraft with its own robot: the first begins where the task says, the others around it,
/// all `apart_m` from each other and outside holes and no-fly areas, the robots where they can drive to and
/// from the task's own (together in its place where there is no such spot). Ids count up from the task's.
/// Errors (kInfeasible): there is no room within 100 rings.
Result<std::vector<Task>> tasks_of_fleet(const Task& task, int aircraft, double apart_m);

/// The same with given starts, of which the first `aircraft` are used; a robot whose aircraft starts beside
/// it starts with it. Errors (kBadInput): too few, nearer than apart_m to each other, barred.
Result<std::vector<Task>> tasks_from_starts(const Task& task, int aircraft, double apart_m,
                                            std::span<const Vec2> starts_m);

}  // namespace swallowtail::coverage
