#pragma once

#include "planner/base/rng.hpp"
#include "tests/property/coverage/replay_task.hpp"

namespace swallowtail::coverage::test {

/// Ground, fields and no-fly areas as few tasks have them: cliffs, slivers, fields that share a border or lie
/// in each other's holes, untidy outlines, no-fly areas of any shape.
void add_rare_ground(Rng& rng, ReplayTask& out);

/// Rules, starts, aircraft, batteries and robots as few tasks have them. After the ground.
void add_rare_wishes(Rng& rng, ReplayTask& out);

}  // namespace swallowtail::coverage::test
