#pragma once

#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "tools/mission/check/rules.hpp"

namespace swallowtail::check {

/// What the scenario holds a mission to: limits, ground, every obstacle over time, fields, battery. Errors:
/// terrain or fields that cannot be read.
Result<Rules> rules_of(const planner::Scenario& scenario);

}  // namespace swallowtail::check
