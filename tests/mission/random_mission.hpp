#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "charger/charging/charging.hpp"
#include "coverage/field/polygon.hpp"
#include "idl/data/types.hpp"
#include "planner/scenario/scenario.hpp"

namespace swallowtail::mission {

/// Mission time in which the robot neither moves its state forth nor hears anything.
struct Silence {
  double from_s = 0.0;
  double to_s = 0.0;
};

/// A task and what goes wrong with it.
struct RandomMission {
  std::uint64_t seed = 0;
  planner::Scenario scenario;
  std::vector<coverage::Polygon> fields;
  std::vector<coverage::Polygon> no_fly;
  double rate = 10.0;           ///< mission seconds per wall second
  double consumption = 1.0;     ///< of the battery, against the model
  double capacity_share = 1.0;  ///< what it holds, of what the task says
  std::vector<charger::Delay> delays;
  std::vector<charger::Loss> losses;  ///< of the robot's own battery
  std::vector<Silence> silences;
  std::function<bool(const Vec2&)> is_closed;  ///< to the robot; none: nowhere
  std::optional<double> robot_dies_s;          ///< it neither drives nor, perhaps, speaks from then on
  int obstacles = 0;                           ///< that stop or turn on or beside the strips
  bool obstacle_stays = false;                 ///< one of them, for good
  double obstacle_acceleration_mps2 = 0.0;     ///< see planner::PlannerOptions
  std::string faults;                          ///< in words
};

/// The first instant of a flight with less than the reserve.
struct Breach {
  double time_s = 0.0;
  double energy = 0.0;
  /// There was a loss that left less than the reserve and what going straight down takes: since the take-off,
  /// or on the ground too short before it to be known.
  bool unavoidable = false;
};

struct MissionEnd {
  nlohmann::json summary;   ///< the simulator's
  data::CoveragePlan plan;  ///< the newest on the wire
  std::string health;       ///< what coverage says of itself
  std::vector<Breach> breaches;
  std::vector<std::string> reasons;       ///< of all revisions, in order
  std::vector<std::string> robot_faults;  ///< in its own energy, and in where it drives
  std::vector<std::string> failures;      ///< of participants that would have ended
  int refills = 0;
};

bool within(const coverage::Ring& ring, const Vec2& p);

void write_polygons(const std::vector<coverage::Polygon>& areas, const std::string& file);

/// The same seed gives the same mission. Its field file is written to `folder`.
RandomMission random_mission(std::uint64_t seed, const std::string& folder);

/// Flies it with simulator, charger, coverage and planner in this process, on one manual clock.
MissionEnd fly(const RandomMission& mission);

/// What of the fields, less the no-fly areas, the legs that count as done cover, 0 … 100: cells of half a
/// metre whose centre lies within half a sensor's width of such a leg. Shares no code with the simulator's
/// raster.
double claimed_percent(const RandomMission& mission, const data::CoveragePlan& plan, std::size_t legs_done);

}  // namespace swallowtail::mission
