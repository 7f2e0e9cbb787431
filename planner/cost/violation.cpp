#include "planner/cost/violation.hpp"

#include "planner/cost/ball_collision.hpp"

namespace swallowtail::planner {

void Violation::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  add_depths(*scene_, paths, values);
  for (std::size_t hop = 0; hop < paths.hops(); ++hop) {
    scene_->batch.add_terrain_violation(paths.point(hop), paths.point(hop + 1), values);
  }
  values /= scene_->distance_m;
}

}  // namespace swallowtail::planner
