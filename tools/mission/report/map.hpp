#pragma once

#include <string>

#include "tools/mission/check/flight_log.hpp"
#include "tools/mission/check/rules.hpp"

namespace swallowtail::report {

/// The mission seen from above, north up: ground, fields, obstacles with the way they moved, planned strips,
/// flown path by phase, rendezvous and the robot's way.
std::string draw_map(const check::Rules& rules, const check::FlightLog& log, const std::string& title);

}  // namespace swallowtail::report
