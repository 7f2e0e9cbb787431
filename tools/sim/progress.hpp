#pragma once

#include <string>
#include <string_view>

#include "idl/data/types.hpp"
#include "tools/sim/simulation.hpp"

namespace swallowtail::sim {

/// What a line says besides the simulation itself.
struct Surroundings {
  data::ClockState state = data::ClockState::kWaiting;
  data::ChargerActivity charger_activity = data::ChargerActivity::kIdle;
};

std::string_view name(data::VehicleMode mode);
std::string_view name(data::ChargerActivity activity);
std::string_view name(data::ClockState state);
std::string_view name(data::PathVerdict verdict);

/// One JSON object on one line, for `--progress`. Times are mission seconds.
std::string progress_line(const Simulation& simulation, const Surroundings& surroundings);

/// The last line: the same, with `final`, `status` ("completed" or why not), and the mission's figures.
std::string summary_line(const Simulation& simulation, const Surroundings& surroundings);

}  // namespace swallowtail::sim
