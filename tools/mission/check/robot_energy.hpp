#pragma once

#include "tools/mission/check/findings.hpp"
#include "tools/mission/check/flight_log.hpp"
#include "tools/mission/check/rules.hpp"

namespace swallowtail::check {

/// The robot's own battery, where it has one: never below its reserve but for losses that the scenario tells
/// of, never above its capacity; it rises at the depot only, and falls by what driving and charging take, no
/// less and no more.
void judge_robot_energy(const FlightLog& log, const Rules& rules, Findings& findings);

}  // namespace swallowtail::check
