#pragma once

#include <vector>

#include "planner/base/vec.hpp"
#include "planner/world/obstacle.hpp"

namespace swallowtail::planner::detail {

/// A shape reduced to what convex queries need, in its own frame (yaw taken out, position at the origin).
class Solid {
 public:
  explicit Solid(const Shape& shape);

  double yaw_rad() const { return yaw_rad_; }
  /// Greatest n·y over the solid's points y.
  double support(const Vec3& n) const;
  /// The point of the solid nearest to x.
  Vec3 project(const Vec3& x) const;

 private:
  enum class Kind { kSphere, kCylinder, kCone, kBox, kMesh };

  Vec3 project_on_mesh(const Vec3& x) const;

  Kind kind_ = Kind::kSphere;
  double radius_m_ = 0.0;
  double height_m_ = 0.0;
  Vec3 half_m_ = Vec3::Zero();
  std::vector<Vec3> vertices_m_;
  double yaw_rad_ = 0.0;
};

/// The point of the convex hull of `points` nearest to the origin (Gilbert's algorithm with Wolfe's minor
/// cycle over at most four corners).
Vec3 nearest_to_origin(const std::vector<Vec3>& points);

}  // namespace swallowtail::planner::detail
