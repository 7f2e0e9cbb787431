#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/mission/check/flight_log.hpp"
#include "tools/mission/check/rules.hpp"

namespace swallowtail::check {

/// One thing that went wrong. `kind` is one of: clearance, terrain, bounds, speed, climb, turn, reserve,
/// charge, dock, uncertified_plan, off_plan, charger_speed, robot_energy, no_fly, closed_ground, off_road,
/// gap, no_data.
struct Finding {
  double time_s = 0.0;
  std::string kind;
  P3 where_m;
  std::string by;      ///< "obstacle 3", "ground", "plan 12", "battery", …
  std::string detail;  ///< value and rule
};

struct FlightReport {
  std::vector<Finding>
      violations;  ///< at most one per kind, culprit and stretch of time, the worst instant of it
  double clearance_min_m = 0.0;  ///< to obstacles and, outside take-off and landing, vertically to the ground
  double energy_min = 0.0;
  double covered_percent = 0.0;
  double flight_s = 0.0;  ///< mission time in the air
  double mission_s = 0.0;
  int recharges = 0;
  int contingencies = 0;
  std::size_t states = 0;
  bool ok() const { return violations.empty(); }
};

/// Flies the mission again from its recording: between recorded states the aircraft is moved along the plan
/// it said it followed, every 20 ms, and held against the rules.
FlightReport check_flight(const FlightLog& log, const Rules& rules);

}  // namespace swallowtail::check
