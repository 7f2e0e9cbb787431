#include "planner/cost/path_batch.hpp"

namespace swallowtail::planner {

void PathBatch::resize(std::size_t points) {
  points_.resize(points);
  hops_.resize(points > 0 ? points - 1 : 0);
}

void PathBatch::fill(std::span<const Vec3> polyline) {
  resize(polyline.size());
  for (std::size_t i = 0; i < polyline.size(); ++i) {
    for (int lane = 0; lane < kLanes; ++lane) set(i, lane, polyline[i]);
  }
  measure();
}

void PathBatch::measure() {
  for (std::size_t i = 0; i < hops_.size(); ++i) {
    const LanePoint& a = points_[i];
    const LanePoint& b = points_[i + 1];
    Hop& hop = hops_[i];
    hop.dx = b.x - a.x;
    hop.dy = b.y - a.y;
    hop.dz = b.z - a.z;
    hop.length = (hop.dx * hop.dx + hop.dy * hop.dy + hop.dz * hop.dz).sqrt();
  }
}

}  // namespace swallowtail::planner
