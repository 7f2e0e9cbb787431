#pragma once

#include <vector>

#include "planner/scenario/scenario.hpp"

namespace swallowtail::planner {

/// What one event does to the obstacles: adds, removes, or restates one at the event's time with its new
/// velocity. Other events do nothing.
void apply(const Event& event, std::vector<Obstacle>& obstacles);

/// The obstacles after all events up to and including `time_s`. One whose valid_until_s has passed is still
/// listed.
std::vector<Obstacle> obstacles_at(const Scenario& scenario, double time_s);

}  // namespace swallowtail::planner
