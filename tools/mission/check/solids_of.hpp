#pragma once

#include <vector>

#include "planner/scenario/scenario.hpp"
#include "tools/mission/check/rules.hpp"

namespace swallowtail::check {

/// Every stretch of straight motion of every obstacle of a scenario, events included.
std::vector<Solid> solids_of(const planner::Scenario& scenario);

}  // namespace swallowtail::check
