#pragma once

#include <vector>

#include "idl/data/types.hpp"

namespace swallowtail::check {

/// What the checker reads of a recording: samples of the judged vehicle and charger, each kind in the order
/// of its mission time or revision.
struct FlightLog {
  std::vector<data::VehicleState> states;
  std::vector<data::BatteryState> batteries;
  std::vector<data::PathPlan> plans;
  std::vector<data::CoveragePlan> coverage_plans;
  std::vector<data::ChargerState> chargers;
};

}  // namespace swallowtail::check
