#pragma once

#include <functional>
#include <string>

#include "idl/data/types.hpp"

namespace swallowtail::testing {

/// What to do with each sample of a recording: change it, or return false to leave it out. Those without a
/// function are copied byte by byte.
struct Changes {
  std::function<bool(data::VehicleState&)> state{};
  std::function<bool(data::BatteryState&)> battery{};
  std::function<bool(data::PathPlan&)> plan{};
};

/// Copies a recording with changes; returns how many samples were changed or left out. Throws
/// std::runtime_error where a file cannot be read or written.
int copy_changed(const std::string& from, const std::string& to, const Changes& changes);

}  // namespace swallowtail::testing
