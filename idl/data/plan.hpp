#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "idl/data/common.hpp"

/// idl/plan.idl; see types.hpp.
namespace swallowtail::data {

enum class LegKind : std::uint8_t { kCover, kReposition };
enum class Transfer : std::uint8_t { kFF, kFFDU, kFDUF, kFDUFDU, kFDTU, kEnd };

struct Leg {
  std::uint32_t sub_cell_id = 0;
  LegKind kind = LegKind::kCover;
  Vec3 entry;
  Vec3 exit;
  double height_m = 0.0;
  Transfer transfer = Transfer::kEnd;
  double energy_before = 0.0;
  double energy_after = 0.0;
  double start_s = 0.0;
  double end_s = 0.0;
  std::uint32_t first_bend = 0;
  std::uint32_t bend_count = 0;
  bool operator==(const Leg&) const = default;
};

struct CoverageBasis {
  std::uint32_t task_revision = 0;
  std::uint32_t terrain_revision = 0;
  double battery_time_s = 0.0;
  double battery_energy = 0.0;
  double vehicle_time_s = 0.0;
  bool operator==(const CoverageBasis&) const = default;
};

struct CoveragePlan {
  std::uint32_t task_id = 0;
  std::uint32_t vehicle_id = 0;
  std::uint32_t revision = 0;
  CoverageBasis basis;
  std::uint32_t legs_done = 0;
  double cost = 0.0;
  double makespan_s = 0.0;
  double field_area_m2 = 0.0;
  bool complete = false;
  std::string reason;
  std::vector<Leg> legs;
  std::vector<Vec3> bends;
  bool operator==(const CoveragePlan&) const = default;
};

enum class StopKind : std::uint8_t { kMeeting, kDepot };

struct Rendezvous {
  std::uint32_t rendezvous_id = 0;
  StopKind kind = StopKind::kMeeting;
  Vec3 site;
  double arrive_by_s = 0.0;
  double depart_s = 0.0;
  double charge_to = 0.0;
  bool carry = false;
  Vec3 carry_to;
  std::uint32_t first_bend = 0;
  std::uint32_t bend_count = 0;
  double speed_mps = 0.0;
  std::uint32_t carry_first_bend = 0;
  std::uint32_t carry_bend_count = 0;
  double carry_speed_mps = 0.0;
  double robot_energy = 0.0;
  double robot_energy_left = 0.0;
  std::uint32_t home_first_bend = 0;
  std::uint32_t home_bend_count = 0;
  double home_speed_mps = 0.0;
  bool operator==(const Rendezvous&) const = default;
};

struct ChargerPlan {
  std::uint32_t charger_id = 0;
  std::uint32_t task_id = 0;
  std::uint32_t vehicle_id = 0;
  std::uint32_t revision = 0;
  double speed_mps = 0.0;
  double charge_s_per_unit = 0.0;
  double taper_from = 1.0;
  double taper_end_rate = 0.1;
  double landing_s = 0.0;
  double take_off_s = 0.0;
  Vec3 start;
  bool has_battery = false;
  RobotBattery battery;
  std::uint32_t home_first_bend = 0;
  std::uint32_t home_bend_count = 0;
  double home_speed_mps = 0.0;
  std::vector<Rendezvous> rendezvous;
  std::vector<Vec3> bends;
  bool operator==(const ChargerPlan&) const = default;
};

enum class PathVerdict : std::uint8_t { kCertified, kContingency, kNoSafePath };
enum class PathPhase : std::uint8_t { kTakeOff, kTransfer, kCover, kHold, kLanding };

struct TimedWaypoint {
  double time_s = 0.0;
  Vec3 position;
  PathPhase phase = PathPhase::kTransfer;
  std::uint32_t leg_index = 0;
  bool operator==(const TimedWaypoint&) const = default;
};

struct PathBasis {
  std::uint32_t coverage_revision = 0;
  std::uint32_t goal_revision = 0;
  std::uint32_t terrain_revision = 0;
  std::uint32_t obstacle_revision = 0;
  double vehicle_time_s = 0.0;
  bool operator==(const PathBasis&) const = default;
};

struct PathPlan {
  std::uint32_t vehicle_id = 0;
  std::uint32_t revision = 0;
  PathBasis basis;
  PathVerdict verdict = PathVerdict::kNoSafePath;
  std::string reason;
  bool lands = false;
  double length_m = 0.0;
  double duration_s = 0.0;
  double clearance_min_m = 0.0;
  double replan_ms = 0.0;
  std::vector<TimedWaypoint> waypoints;
  bool operator==(const PathPlan&) const = default;
};

}  // namespace swallowtail::data
