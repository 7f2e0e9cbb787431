#pragma once

#include <vector>

#include "tools/mission/check/findings.hpp"
#include "tools/mission/check/flight_log.hpp"
#include "tools/mission/check/rules.hpp"

namespace swallowtail::check {

/// The aircraft in flight inside a no-fly area, at any height.
void judge_no_fly(const Rules& rules, const P3& p, double time_s, Findings& findings);

/// The robot inside closed ground, or farther from every road than it may be.
void judge_robot_ground(const FlightLog& log, const Rules& rules, Findings& findings);

}  // namespace swallowtail::check
