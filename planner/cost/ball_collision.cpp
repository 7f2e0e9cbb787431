#include "planner/cost/ball_collision.hpp"

#include <vector>

namespace swallowtail::planner {
namespace {

/// Depth of one lane's hop in an obstacle that moves or ends, as it stands at time 0.
double timed_depth_m(const CostScene& scene, const PathBatch& paths, std::size_t hop, int lane,
                     std::size_t i) {
  return scene.field.violation_m(i, paths.at(hop, lane), 0.0, paths.at(hop + 1, lane), 0.0);
}

}  // namespace

void add_ball_collisions(const CostScene& scene, const PathBatch& paths, Lanes& sum) {
  thread_local std::vector<LaneDistance> buffer;
  for (std::size_t hop = 0; hop < paths.hops(); ++hop) {
    const auto near =
        scene.batch.distances(paths.point(hop), paths.point(hop + 1), scene.most_required_m, buffer);
    for (const LaneDistance& distance : near) {
      const Lanes depth = scene.field.required_m(distance.obstacle) - distance.signed_distance_m;
      sum += (depth > 0.0).select(1.0 + depth, 0.0);
    }
    for (const std::size_t i : scene.batch.timed()) {
      for (int lane = 0; lane < kLanes; ++lane) {
        const double depth = timed_depth_m(scene, paths, hop, lane, i);
        sum[lane] += depth > 0.0 ? 1.0 + depth : 0.0;
      }
    }
  }
}

void add_depths(const CostScene& scene, const PathBatch& paths, Lanes& sum_m) {
  for (std::size_t hop = 0; hop < paths.hops(); ++hop) {
    scene.batch.add_violation(paths.point(hop), paths.point(hop + 1), sum_m);
    for (const std::size_t i : scene.batch.timed()) {
      for (int lane = 0; lane < kLanes; ++lane) sum_m[lane] += timed_depth_m(scene, paths, hop, lane, i);
    }
  }
}

}  // namespace swallowtail::planner
