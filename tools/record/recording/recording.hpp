#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "idl/data/types.hpp"
#include "planner/base/result.hpp"
#include "qos/bus.hpp"

/// What a recorder wrote, as plain values: the reading side of tools/record.
namespace swallowtail::recording {

/// A sample with the wall-clock times of its reception and of its writing.
template <class T>
struct Timed {
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  T value;
};

/// The end of an instance: disposed by its writer, or left without one.
struct Ending {
  std::string topic;
  InstanceKey key{};
  bool is_disposed = true;  ///< false: no writer was left
};

/// Every list is in order of reception. A sample that the participants would have refused is not in it but
/// counted.
struct Recording {
  std::vector<Timed<data::TerrainTile>> terrain_tiles;
  std::vector<Timed<data::Obstacle>> obstacles;
  std::vector<Timed<data::VehicleState>> vehicle_states;
  std::vector<Timed<data::BatteryState>> battery_states;
  std::vector<Timed<data::CoverageTask>> coverage_tasks;
  std::vector<Timed<data::Goal>> goals;
  std::vector<Timed<data::MissionClock>> mission_clocks;
  std::vector<Timed<data::CoveragePlan>> coverage_plans;
  std::vector<Timed<data::ChargerPlan>> charger_plans;
  std::vector<Timed<data::PathPlan>> path_plans;
  std::vector<Timed<data::ChargerState>> charger_states;
  std::vector<Timed<data::ParticipantStatus>> participant_statuses;
  std::vector<Timed<Ending>> endings;

  std::map<std::string, std::uint64_t> refused;  ///< by "topic: reason"
  std::map<std::string, std::uint64_t> unknown;  ///< messages by topic that the contract does not have
  bool is_complete = true;                       ///< false: the recorder did not finish the file
  std::vector<std::string> problems;             ///< what was wrong with the file
};

/// Reads a whole recording. A file cut short gives what is in it; fails where it is no recording or damaged
/// within.
Result<Recording> load_recording(const std::filesystem::path& path);

}  // namespace swallowtail::recording
