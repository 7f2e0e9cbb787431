#pragma once

#include <string>

#include "planner/base/result.hpp"
#include "tools/mission/check/flight_log.hpp"

namespace swallowtail::mission {

/// The samples of one vehicle (and of every charger) in a recording, in the order of their mission time.
/// Errors: as recording::load_recording.
Result<check::FlightLog> load_flight_log(const std::string& recording_file, std::uint32_t vehicle_id);

}  // namespace swallowtail::mission
