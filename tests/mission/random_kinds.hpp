#pragma once

#include <string>

#include "planner/base/rng.hpp"
#include "tests/mission/random_mission.hpp"

namespace swallowtail::mission {

/// What else a task may ask for: hills, heights by class, rates of flight, a charging curve, overlap,
/// direction, headland, and ground that the robot may not drive on or roads that it keeps to.
void draw_kinds(Rng& rng, RandomMission& mission, const std::string& folder);

/// The greatest that flying takes of the model, units per second.
double greatest_rate(const planner::Scenario& scenario);

}  // namespace swallowtail::mission
