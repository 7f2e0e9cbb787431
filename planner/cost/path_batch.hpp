#pragma once

#include <span>
#include <vector>

#include "planner/base/vec.hpp"
#include "planner/kernels/lanes.hpp"

namespace swallowtail::planner {

/// Eight polylines of the same number of points side by side, start and goal included, as the objectives want
/// them. Memory is taken when `resize` first asks for so many points and kept.
class PathBatch {
 public:
  struct Hop {
    Lanes dx, dy, dz;  ///< m
    Lanes length;      ///< m
  };

  void resize(std::size_t points);
  void set(std::size_t point, int lane, const Vec3& p) {
    points_[point].x[lane] = p.x();
    points_[point].y[lane] = p.y();
    points_[point].z[lane] = p.z();
  }
  /// Makes the hops from the points; to be called after the last `set`.
  void measure();
  /// All lanes hold this polyline.
  void fill(std::span<const Vec3> polyline);

  std::size_t points() const { return points_.size(); }
  std::size_t hops() const { return hops_.size(); }
  const LanePoint& point(std::size_t i) const { return points_[i]; }
  /// From point i to point i + 1.
  const Hop& hop(std::size_t i) const { return hops_[i]; }
  Vec3 at(std::size_t point, int lane) const {
    return {points_[point].x[lane], points_[point].y[lane], points_[point].z[lane]};
  }

 private:
  std::vector<LanePoint> points_;
  std::vector<Hop> hops_;
};

}  // namespace swallowtail::planner
