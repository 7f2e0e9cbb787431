#pragma once

#include <string>

#include "planner/scenario/detail/section.hpp"
#include "planner/scenario/scenario.hpp"

/// From the raw tree to typed structs, one function for each part of a file. Each logs what is wrong and
/// leaves the struct's default there.
namespace swallowtail::planner::detail {

/// Ranges as on the wire (idl/data/validate.hpp).
inline constexpr double kMaxXy_m = 1e6;
inline constexpr double kMaxSize_m = 1e4;
inline constexpr double kMaxTime_s = 1e7;
inline constexpr double kMaxSpeed_mps = 200.0;
inline constexpr Range kId = from_to(1, 4294967295.0);

void read_frame(Section& top, Scenario& scenario);
void read_bounds(Section& top, Scenario& scenario);
void read_terrain_spec(Section& top, const std::string& folder, Scenario& scenario);
void read_obstacles(Section& top, Scenario& scenario);
/// Reads one obstacle; false when anything is wrong with it. `state_time_s` is when it appears.
bool read_obstacle(Section& section, double state_time_s, Obstacle& out);

void read_vehicle(Section& top, Scenario& scenario);
void read_planning(Section& top, Scenario& scenario);
void read_coverage(Section& top, const std::string& folder, Scenario& scenario);
void read_disturbances(Section& top, Scenario& scenario);
/// After obstacles and coverage. Also follows the events in time: what they name must be there.
void read_events(Section& top, Scenario& scenario);

/// Joins `folder` and a path from the file and logs a file that is not there.
bool resolve_file(Section& section, std::string_view key, const std::string& folder, std::string& file);

}  // namespace swallowtail::planner::detail
