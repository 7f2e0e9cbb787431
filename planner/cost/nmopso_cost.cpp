#include "planner/cost/nmopso_cost.hpp"

#include <numbers>

#include "planner/cost/smoothness.hpp"

namespace swallowtail::planner {

void NmopsoLength::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  for (std::size_t i = 0; i < paths.hops(); ++i) values += paths.hop(i).length;
  const LanePoint& a = paths.point(0);
  const LanePoint& b = paths.point(paths.points() - 1);
  const Lanes straight = ((b.x - a.x).square() + (b.y - a.y).square() + (b.z - a.z).square()).sqrt();
  values = (values > 0.0).select((1.0 - straight / values).max(0.0), 0.0);
}

void level_distances(const LanePoint& from, const PathBatch::Hop& hop, const Vec2& point_m,
                     Lanes& distance_m) {
  const Lanes px = point_m.x() - from.x;
  const Lanes py = point_m.y() - from.y;
  const Lanes length2 = hop.dx * hop.dx + hop.dy * hop.dy;
  const Lanes t = (length2 > 0.0).select(((px * hop.dx + py * hop.dy) / length2).max(0.0).min(1.0), 0.0);
  distance_m = ((px - t * hop.dx).square() + (py - t * hop.dy).square()).sqrt();
}

void NmopsoThreat::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  if (scene_->discs.empty()) return;
  Lanes distance_m;
  for (std::size_t i = 0; i < paths.hops(); ++i) {
    for (const CostScene::Disc& disc : scene_->discs) {
      level_distances(paths.point(i), paths.hop(i), disc.center_m, distance_m);
      const Lanes near =
          1.0 - (distance_m - scene_->limits.clearance_m() - disc.radius_m) / danger_distance_m_;
      values += (near <= 1.0).select(near.max(0.0), 1.0 + kBeyondLimit * (near - 1.0));
    }
  }
  values /= static_cast<double>(paths.hops() * scene_->discs.size());
}

void NmopsoTurn::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  if (paths.hops() < 2) return;
  for (std::size_t i = 1; i < paths.hops(); ++i) {
    for (int lane = 0; lane < kLanes; ++lane) {
      values[lane] += turn_rad(paths.hop(i - 1), paths.hop(i), lane);
    }
  }
  values /= std::numbers::pi * static_cast<double>(paths.hops() - 1);
}

}  // namespace swallowtail::planner
