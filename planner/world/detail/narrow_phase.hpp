#pragma once

#include <memory>

#include "planner/world/obstacle.hpp"

namespace swallowtail::planner::detail {

/// How near a straight segment p–q comes to a solid.
struct Approach {
  double distance_m = 0.0;  ///< never above the true distance; 0 where they touch
  double fraction = 0.0;    ///< where along p–q, 0 … 1
};

/// Closed form, less what rounding may have added.
Approach sphere_to_segment(const Sphere& sphere, const Vec3& p_m, const Vec3& q_m);

/// One obstacle's shape, ready for distance queries in the frame of its position. Const calls may run in
/// several threads.
class NarrowShape {
 public:
  explicit NarrowShape(const Shape& shape);
  ~NarrowShape();
  NarrowShape(NarrowShape&&) noexcept;
  NarrowShape& operator=(NarrowShape&&) noexcept;

  /// GJK gives two nearest points; the direction between them is checked by a supporting plane. Where the
  /// plane proves less than GJK claims, the convex distance along the segment is minimised by bisection
  /// instead.
  Approach to_segment(const Vec3& p_m, const Vec3& q_m) const;

  /// The two halves of it, for tests: what GJK alone proves, and what bisection alone proves.
  Approach by_gjk(const Vec3& p_m, const Vec3& q_m) const;
  Approach by_bisection(const Vec3& p_m, const Vec3& q_m) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swallowtail::planner::detail
