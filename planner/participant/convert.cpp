#include "planner/participant/convert.hpp"

#include <limits>

namespace swallowtail::planner {
namespace {

/// On the wire "for ever" is a large number.
constexpr double kForever_s = 1e8;

Shape to_shape(const data::Obstacle& o) {
  switch (o.shape) {
    case data::ObstacleShape::kSphere:
      return Sphere{o.radius_m};
    case data::ObstacleShape::kCylinder:
      return Cylinder{o.radius_m, o.height_m};
    case data::ObstacleShape::kCone:
      return Cone{o.radius_m, o.height_m};
    case data::ObstacleShape::kBox:
      return Box{to_vec(o.size_m), o.yaw_rad};
    case data::ObstacleShape::kMesh:
      break;
  }
  ConvexMesh mesh;
  mesh.yaw_rad = o.yaw_rad;
  for (const data::Vec3& v : o.vertices) mesh.vertices_m.push_back(to_vec(v));
  return mesh;
}

Phase to_phase(data::PathPhase phase) {
  switch (phase) {
    case data::PathPhase::kTakeOff:
      return Phase::kTakeOff;
    case data::PathPhase::kTransfer:
      return Phase::kTransfer;
    case data::PathPhase::kCover:
      return Phase::kCover;
    case data::PathPhase::kHold:
      return Phase::kHold;
    case data::PathPhase::kLanding:
      return Phase::kLanding;
  }
  return Phase::kHold;
}

data::PathPhase to_data(Phase phase) {
  switch (phase) {
    case Phase::kTakeOff:
      return data::PathPhase::kTakeOff;
    case Phase::kTransfer:
      return data::PathPhase::kTransfer;
    case Phase::kCover:
      return data::PathPhase::kCover;
    case Phase::kHold:
      return data::PathPhase::kHold;
    case Phase::kLanding:
      return data::PathPhase::kLanding;
  }
  return data::PathPhase::kHold;
}

}  // namespace

Vec3 to_vec(const data::Vec3& v) { return {v.x_m, v.y_m, v.z_m}; }
data::Vec3 to_data(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

VehicleLimits to_limits(const data::VehicleLimits& l) {
  return {l.radius_m,          l.margin_m,     l.cruise_speed_mps, l.climb_speed_mps,
          l.descent_speed_mps, l.turn_max_rad, l.climb_max_rad};
}

Obstacle to_obstacle(const data::Obstacle& o) {
  Obstacle obstacle;
  obstacle.id = o.obstacle_id;
  obstacle.shape = to_shape(o);
  obstacle.position_m = to_vec(o.position);
  obstacle.velocity_mps = to_vec(o.velocity_mps);
  obstacle.state_time_s = o.state_time_s;
  obstacle.valid_until_s =
      o.valid_until_s >= kForever_s ? std::numeric_limits<double>::infinity() : o.valid_until_s;
  obstacle.margin_m = o.margin_m;
  return obstacle;
}

TimedPath to_path(const std::vector<data::TimedWaypoint>& waypoints) {
  TimedPath path;
  for (const data::TimedWaypoint& w : waypoints) {
    path.push_back({w.time_s, to_vec(w.position), to_phase(w.phase), w.leg_index});
  }
  return path;
}

std::vector<data::TimedWaypoint> to_data(const TimedPath& path) {
  std::vector<data::TimedWaypoint> waypoints;
  for (const TimedWaypoint& w : path) {
    waypoints.push_back({w.time_s, to_data(w.position_m), to_data(w.phase), w.leg_index});
  }
  return waypoints;
}

data::PathVerdict to_data(Verdict verdict) {
  switch (verdict) {
    case Verdict::kCertified:
      return data::PathVerdict::kCertified;
    case Verdict::kContingency:
      return data::PathVerdict::kContingency;
    case Verdict::kNoSafePath:
      return data::PathVerdict::kNoSafePath;
  }
  return data::PathVerdict::kNoSafePath;
}

}  // namespace swallowtail::planner
