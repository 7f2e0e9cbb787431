#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/base/vec.hpp"
#include "planner/world/obstacle.hpp"

namespace swallowtail::planner::detail {

enum class SolidKind : std::uint8_t { kSphere, kCylinder, kCone, kBox, kMesh };

/// A mesh is replaced by the half-spaces of this many directions; an upright prism by those of its own faces,
/// of its edges, and of bevels between.
inline constexpr std::size_t kMeshDirections = 62;
/// Spread evenly over the sphere (Fibonacci lattice) after the six axes.
const std::array<Vec3, kMeshDirections>& mesh_directions();

/// An obstacle as the kernels want it: plain numbers. Shapes stand as in obstacle.hpp, turned back by the
/// yaw.
struct FieldSolid {
  Vec3 position_m = Vec3::Zero();  ///< at mission time 0
  Vec3 velocity_mps = Vec3::Zero();
  double valid_until_s = 0.0;
  double required_m = 0.0;  ///< distance to keep
  Vec3 ball_offset_m = Vec3::Zero();
  double ball_radius_m = 0.0;  ///< of a ball about position + offset that holds the solid
  Vec3 half_extent_m = Vec3::Zero();
  double radius_m = 0.0;
  double height_m = 0.0;
  double slant_m = 0.0;  ///< √(radius² + height²)
  Vec3 half_m = Vec3::Zero();
  double cos_yaw = 1.0;
  double sin_yaw = 0.0;
  std::size_t first_support = 0;  ///< of half_spaces, with their directions after them where it has its own
  std::size_t half_spaces = 0;
  bool has_directions = false;
  std::uint32_t id = 0;
  SolidKind kind = SolidKind::kSphere;
};

bool stands_for_ever(const Obstacle& obstacle);

/// A ball that holds the shape, relative to its position.
struct Ball {
  Vec3 offset_m;
  double radius_m;
};
Ball ball_of(const Shape& shape);

/// The obstacle with its ball and the distance to keep from it. Appends to `supports` for a mesh.
FieldSolid field_solid(const Obstacle& obstacle, const Ball& ball, double required_m,
                       std::vector<double>& supports);

}  // namespace swallowtail::planner::detail
