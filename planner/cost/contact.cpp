#include "planner/cost/contact.hpp"

#include "planner/cost/ball_collision.hpp"
#include "planner/cost/terrain_collision.hpp"

namespace swallowtail::planner {

void Contact::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  add_depths(*scene_, paths, values);
  add_terrain_collisions(*scene_, paths, values);
  values = (values > 0.0).select(1.0 + values / scene_->distance_m, 0.0);
}

}  // namespace swallowtail::planner
