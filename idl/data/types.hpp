#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// The data contract as plain values: what the IDL says, without any vendor. Meaning, frames and units of
/// each field stand in idl/*.idl and are not repeated here. The codecs (idl/codec) turn wire samples into
/// these and back; `validate` (validate.hpp) is what every sample passes on the way in.
namespace swallowtail::data {

inline constexpr std::uint32_t kMaxTileCells = 15000;
inline constexpr std::uint32_t kMaxMeshVertices = 256;
inline constexpr std::uint32_t kMaxFields = 64;
inline constexpr std::uint32_t kMaxRings = 512;
inline constexpr std::uint32_t kMaxRingPoints = 8192;
inline constexpr std::uint32_t kMaxLegs = 4096;
inline constexpr std::uint32_t kMaxRendezvous = 1024;
inline constexpr std::uint32_t kMaxWaypoints = 2048;
inline constexpr std::uint32_t kMaxRejections = 64;

enum ParticipantId : std::uint32_t {
  kPlannerId = 1,
  kCoverageId = 2,
  kChargerId = 3,
  kSimulatorId = 4,
  kRecorderId = 5,
  kReplayerId = 6,
  kStandbyPlannerId = 7,
};

struct Vec3 {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  bool operator==(const Vec3&) const = default;
};

struct Point2 {
  double x_m = 0.0;
  double y_m = 0.0;
  bool operator==(const Point2&) const = default;
};

struct GeoOrigin {
  double lat_deg = 0.0;
  double lon_deg = 0.0;
  double elevation_m = 0.0;
  bool operator==(const GeoOrigin&) const = default;
};

struct VehicleLimits {
  double radius_m = 0.5;
  double margin_m = 2.0;
  double cruise_speed_mps = 8.0;
  double climb_speed_mps = 3.0;
  double descent_speed_mps = 3.0;
  double turn_max_rad = 1.0471975511965976;
  double climb_max_rad = 0.7853981633974483;
  bool operator==(const VehicleLimits&) const = default;
};

struct TerrainTile {
  std::uint32_t map_id = 1;
  std::uint32_t row = 0;
  std::uint32_t col = 0;
  std::uint32_t revision = 1;
  GeoOrigin origin;
  double origin_x_m = 0.0;
  double origin_y_m = 0.0;
  double cell_size_m = 1.0;
  std::uint32_t map_rows = 0;
  std::uint32_t map_cols = 0;
  std::uint32_t first_row = 0;
  std::uint32_t first_col = 0;
  std::uint32_t tile_rows = 0;
  std::uint32_t tile_cols = 0;
  std::vector<float> elevation_m;
  bool operator==(const TerrainTile&) const = default;
};

enum class ObstacleShape : std::uint8_t { kSphere, kCylinder, kCone, kBox, kMesh };

struct Obstacle {
  std::uint32_t obstacle_id = 0;
  std::uint32_t revision = 1;
  ObstacleShape shape = ObstacleShape::kSphere;
  Vec3 position;
  Vec3 velocity_mps;
  double state_time_s = 0.0;
  double valid_until_s = 1e9;
  double radius_m = 0.0;
  double height_m = 0.0;
  Vec3 size_m;
  double yaw_rad = 0.0;
  double margin_m = 0.0;
  std::vector<Vec3> vertices;
  bool operator==(const Obstacle&) const = default;
};

enum class VehicleMode : std::uint8_t {
  kLanded,
  kTakingOff,
  kTransfer,
  kCovering,
  kHolding,
  kLanding,
  kDocked
};

struct VehicleState {
  std::uint32_t vehicle_id = 0;
  double time_s = 0.0;
  Vec3 position;
  Vec3 velocity_mps;
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
  VehicleMode mode = VehicleMode::kLanded;
  std::uint32_t docked_charger_id = 0;
  std::uint32_t path_revision = 0;
  std::uint32_t coverage_revision = 0;
  std::uint32_t leg_index = 0;
  std::uint32_t legs_done = 0;
  bool operator==(const VehicleState&) const = default;
};

struct BatteryState {
  std::uint32_t vehicle_id = 0;
  double time_s = 0.0;
  double energy = 0.0;
  double capacity = 0.0;
  double power = 0.0;
  double health = 1.0;
  bool operator==(const BatteryState&) const = default;
};

struct Field {
  std::uint32_t field_id = 0;
  double height_m = 0.0;
  bool operator==(const Field&) const = default;
};

struct Ring {
  std::uint32_t field_index = 0;
  std::uint32_t first_point = 0;
  std::uint32_t point_count = 0;
  bool is_hole = false;
  bool operator==(const Ring&) const = default;
};

struct EnergyModel {
  double level_per_s = 1.0;
  double climb_per_s = 1.0;
  double descent_per_s = 1.0;
  double hover_per_s = 1.0;
  double landed_per_s = 0.0;
  bool operator==(const EnergyModel&) const = default;
};

struct BatteryLimits {
  double capacity = 500.0;
  double reserve = 25.0;
  std::uint32_t levels = 10;
  double charge_s_per_unit = 2.0;
  EnergyModel model;
  bool operator==(const BatteryLimits&) const = default;
};

struct ChargerLimits {
  std::uint32_t charger_id = 1;
  double speed_mps = 1.6;
  double take_off_s = 5.0;
  double landing_s = 5.0;
  Vec3 start;
  bool operator==(const ChargerLimits&) const = default;
};

struct CoverageTask {
  std::uint32_t task_id = 1;
  std::uint32_t revision = 1;
  std::uint32_t vehicle_id = 1;
  GeoOrigin origin;
  std::vector<Field> fields;
  std::vector<Ring> rings;
  std::vector<Point2> points;
  double sensor_width_m = 10.0;
  double height_tolerance_m = 2.0;
  double height_band_m = 0.0;
  std::uint32_t neighbours = 5;
  VehicleLimits vehicle;
  BatteryLimits battery;
  ChargerLimits charger;
  Vec3 start;
  std::uint64_t seed = 1;
  bool has_terrain = false;
  bool operator==(const CoverageTask&) const = default;
};

struct Goal {
  std::uint32_t vehicle_id = 1;
  std::uint32_t revision = 1;
  GeoOrigin origin;
  Vec3 start;
  Vec3 position;
  double arrive_by_s = 0.0;
  VehicleLimits vehicle;
  Vec3 bounds_min;
  Vec3 bounds_max;
  std::uint64_t seed = 1;
  bool has_terrain = false;
  bool operator==(const Goal&) const = default;
};

enum class ClockState : std::uint8_t { kWaiting, kRunning, kEnded };

struct MissionClock {
  double time_s = 0.0;
  double rate = 1.0;
  ClockState state = ClockState::kWaiting;
  bool operator==(const MissionClock&) const = default;
};

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
  bool operator==(const CoveragePlan&) const = default;
};

struct Rendezvous {
  std::uint32_t rendezvous_id = 0;
  Vec3 site;
  double arrive_by_s = 0.0;
  double depart_s = 0.0;
  double charge_to = 0.0;
  bool carry = false;
  Vec3 carry_to;
  bool operator==(const Rendezvous&) const = default;
};

struct ChargerPlan {
  std::uint32_t charger_id = 0;
  std::uint32_t task_id = 0;
  std::uint32_t vehicle_id = 0;
  std::uint32_t revision = 0;
  double speed_mps = 0.0;
  double charge_s_per_unit = 0.0;
  double landing_s = 0.0;
  double take_off_s = 0.0;
  Vec3 start;
  std::vector<Rendezvous> rendezvous;
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

enum class ChargerActivity : std::uint8_t {
  kIdle,
  kDriving,
  kWaiting,
  kCharging,
  kCarrying,
  kReady,
  kDelayed
};

struct ChargerState {
  std::uint32_t charger_id = 0;
  double time_s = 0.0;
  Vec3 position;
  double speed_mps = 0.0;
  std::uint32_t docked_vehicle_id = 0;
  double charge_rate = 0.0;
  double energy_delivered = 0.0;
  ChargerActivity activity = ChargerActivity::kIdle;
  std::uint32_t rendezvous_id = 0;
  std::uint32_t rendezvous_done = 0;
  std::uint32_t plan_revision = 0;
  bool operator==(const ChargerState&) const = default;
};

enum class Health : std::uint8_t { kStarting, kReady, kDegraded, kFailed };

struct Rejection {
  std::string topic;
  std::string reason;
  std::uint64_t count = 0;
  bool operator==(const Rejection&) const = default;
};

struct ParticipantStatus {
  std::uint32_t participant_id = 0;
  std::string name;
  Health health = Health::kStarting;
  std::uint64_t accepted = 0;
  std::vector<Rejection> rejected;
  std::uint64_t missed_deadlines = 0;
  std::uint64_t incompatible_qos = 0;
  std::uint64_t replans = 0;
  double latency_p50_ms = 0.0;
  double latency_p99_ms = 0.0;
  double latency_max_ms = 0.0;
  std::string message;
  bool operator==(const ParticipantStatus&) const = default;
};

}  // namespace swallowtail::data
