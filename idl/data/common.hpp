#pragma once

#include <cstdint>

/// Bounds and types that several families of the contract share; see types.hpp.
namespace swallowtail::data {

inline constexpr std::uint32_t kMaxTileCells = 15000;
inline constexpr std::uint32_t kMaxMeshVertices = 256;
inline constexpr std::uint32_t kMaxFields = 64;
inline constexpr std::uint32_t kMaxRings = 512;
inline constexpr std::uint32_t kMaxRingPoints = 8192;
inline constexpr std::uint32_t kMaxAreas = 256;
inline constexpr std::uint32_t kMaxRoads = 2048;
inline constexpr std::uint32_t kMaxTaskPoints = 16384;
inline constexpr std::uint32_t kMaxLegs = 4096;
inline constexpr std::uint32_t kMaxRendezvous = 1024;
inline constexpr std::uint32_t kMaxWaypoints = 2048;
inline constexpr std::uint32_t kMaxBends = 8192;
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

struct RobotBattery {
  double capacity = 0.0;
  double reserve = 0.0;
  double drive_per_s = 0.0;
  double per_charged = 1.0;
  double refill_s = 0.0;
  bool operator==(const RobotBattery&) const = default;
};

}  // namespace swallowtail::data
