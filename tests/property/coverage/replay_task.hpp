#pragma once

#include <cstdint>

#include "coverage/schedule/plan.hpp"
#include "planner/world/terrain.hpp"
#include "tests/support/replay_oracle.hpp"

namespace swallowtail::coverage::test {

struct ReplayTask {
  Task task;
  planner::Terrain terrain = planner::Terrain::flat(0.0);
  PlanOptions options;
  test_support::ReplayRoads robot;
};

/// Everything that a task can vary in, small enough to be planned in milliseconds.
ReplayTask random_replay_task(std::uint64_t seed);

/// What the replay holds the plan of such a task to. Borrows the task's terrain.
test_support::ReplayQuestion question_of(const ReplayTask& random);

}  // namespace swallowtail::coverage::test
