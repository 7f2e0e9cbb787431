#pragma once

#include <string>

#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "tools/mission/check/flight_log.hpp"

namespace swallowtail::mission {

/// The samples of the scenario's vehicle (and of every charger) in a recording, in the order of their mission
/// time. Left out is what the participants refuse: samples that are not valid, energy above the task's
/// capacity.
/// Errors: as recording::load_recording.
Result<check::FlightLog> load_flight_log(const std::string& recording_file,
                                         const planner::Scenario& scenario);

}  // namespace swallowtail::mission
