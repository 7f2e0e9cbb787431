#include "planner/cost/terrain_collision.hpp"

namespace swallowtail::planner {

void add_terrain_collisions(const CostScene& scene, const PathBatch& paths, Lanes& sum_m) {
  const double clearance_m = scene.field.ground_clearance_m();
  LanePoint from = paths.point(0);
  from.z -= clearance_m;
  for (std::size_t hop = 0; hop < paths.hops(); ++hop) {
    LanePoint to = paths.point(hop + 1);
    to.z -= clearance_m;
    scene.batch.add_length_below_ground(from, to, sum_m);
    from = to;
  }
}

}  // namespace swallowtail::planner
