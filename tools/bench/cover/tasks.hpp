#pragma once

#include <cstdint>

#include "coverage/schedule/plan.hpp"
#include "coverage/schedule/task.hpp"
#include "planner/base/clock.hpp"

namespace swallowtail::bench {

/// One field, begun on the ground at its first corner, where the robot stands as well; strips of 10 m.
coverage::Task task_of(const coverage::Field& field);

/// Skewed fields of 5 to 60 strips each in columns, at 2 to 6 heights, most with a hole, with `strips`
/// together; slanted borders and holes make about half as many sub-cells again. Battery 300 to 800 units.
coverage::Task banded_task(int strips, std::uint64_t seed);

struct Planned {
  Result<coverage::Plan> plan;
  double cpu_ms = 0.0;
};
/// On flat ground, with the defaults of `swallowtail cover`, CPU time measured.
Planned plan_timed(const coverage::Task& task, std::uint64_t seed);

}  // namespace swallowtail::bench
