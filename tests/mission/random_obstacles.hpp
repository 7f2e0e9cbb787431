#pragma once

#include "planner/base/rng.hpp"
#include "tests/mission/random_mission.hpp"

namespace swallowtail::mission {

/// Sometimes, obstacles that come in from afar, stop or turn on or beside the strips, and vanish; a few stay
/// for good. Their margins do for their turns: what stands at one place is known to move before it does only
/// as long as a change takes to reach the aircraft.
void draw_obstacles(Rng& rng, RandomMission& mission);

}  // namespace swallowtail::mission
