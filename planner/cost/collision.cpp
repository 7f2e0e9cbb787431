#include "planner/cost/collision.hpp"

#include <cmath>

#include "planner/cost/ball_collision.hpp"
#include "planner/cost/terrain_collision.hpp"

namespace swallowtail::planner {

void Collision::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  add_ball_collisions(*scene_, paths, values);
  add_terrain_collisions(*scene_, paths, values);
  if (power_ == 2.0) {
    values *= values;
  } else {
    for (double& value : values) value = std::pow(value, power_);
  }
}

}  // namespace swallowtail::planner
