#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "idl/data/common.hpp"
#include "idl/data/mission.hpp"
#include "idl/data/plan.hpp"

/// The data contract as plain values: what the IDL says, without any vendor. Meaning, frames and units of
/// each field stand in idl/*.idl and are not repeated here. The codecs (idl/codec) turn wire samples into
/// these and back; `validate` (validate.hpp) is what every sample passes on the way in.
namespace swallowtail::data {

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

enum class ChargerActivity : std::uint8_t {
  kIdle,
  kDriving,
  kWaiting,
  kCharging,
  kCarrying,
  kReady,
  kDelayed,
  kRefilling
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
  double energy = 0.0;
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
