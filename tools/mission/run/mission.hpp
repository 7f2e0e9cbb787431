#pragma once

#include <atomic>
#include <string>

#include "tools/mission/run/fleet.hpp"
#include "tools/mission/run/summary.hpp"

namespace swallowtail::mission {

struct MissionOptions {
  FleetOptions fleet;
  std::string report_file;  ///< empty: none
  bool quiet = false;       ///< no progress on standard error
};

/// Starts the participants, watches them, stops them, reads the recording and judges it. `stop_requested`
/// ends it early; what was recorded by then is judged all the same. Errors: a participant that does not start
/// or ends by itself, a recording that cannot be read.
Result<Summary> fly_mission(const planner::Scenario& scenario, const MissionOptions& options,
                            const std::atomic<bool>& stop_requested);

}  // namespace swallowtail::mission
