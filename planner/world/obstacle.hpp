#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::planner {

struct Sphere {
  double radius_m = 0.0;
};
/// Axis up, `position` at the centre of the base.
struct Cylinder {
  double radius_m = 0.0;
  double height_m = 0.0;
};
/// Axis up, `position` at the centre of the base, apex above it.
struct Cone {
  double radius_m = 0.0;
  double height_m = 0.0;
};
/// Full edge lengths, `position` at the centre, turned by yaw_rad about up.
struct Box {
  Vec3 size_m = Vec3::Zero();
  double yaw_rad = 0.0;
};
/// Convex hull of the vertices, relative to `position`, turned by yaw_rad about up.
struct ConvexMesh {
  std::vector<Vec3> vertices_m;
  double yaw_rad = 0.0;
};

using Shape = std::variant<Sphere, Cylinder, Cone, Box, ConvexMesh>;

/// A solid that may move in a straight line: at mission time t it stands at position + velocity·(t −
/// state_time_s), from state_time_s back and on, until valid_until_s.
struct Obstacle {
  std::uint32_t id = 0;
  Shape shape;
  Vec3 position_m = Vec3::Zero();
  Vec3 velocity_mps = Vec3::Zero();
  double state_time_s = 0.0;
  double valid_until_s = std::numeric_limits<double>::infinity();
  double margin_m = 0.0;  ///< kept besides the vehicle's own margin
  double relief_m = 0.0;  ///< of the vehicle's radius and margin that need not be kept: no-fly areas may be
                          ///< flown along

  Vec3 position_at(double time_s) const { return position_m + velocity_mps * (time_s - state_time_s); }
  /// Kept besides the vehicle's radius and margin; below 0 where there is relief.
  double extra_m() const { return margin_m - relief_m; }
  bool moves() const { return velocity_mps != Vec3::Zero(); }
};

/// Errors name the obstacle, the value and the rule: every number finite (valid_until_s may be infinite),
/// sizes in (0, 1e5] m, margin and relief 0 … 1e5 m, speed ≤ 200 m/s, a mesh of 4 … kMaxVertices vertices
/// that do not lie in one plane.
Status validate(const Obstacle& obstacle);
inline constexpr std::size_t kMaxVertices = 1024;

/// Radius of the smallest sphere around `position` that holds the shape.
double bounding_radius_m(const Shape& shape);

/// The axis-aligned box that holds the shape (yaw applied), relative to `position`.
struct Extent {
  Vec3 min_m = Vec3::Zero();
  Vec3 max_m = Vec3::Zero();
};
Extent extent(const Shape& shape);

}  // namespace swallowtail::planner
