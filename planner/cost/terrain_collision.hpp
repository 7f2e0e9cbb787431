#pragma once

#include "planner/cost/path_batch.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// Co of each path [BOA Eq. 8, 14]: the length that lies at or below the ground raised by the height to keep
/// above it, metres. Exact on the surface, where the document samples.
void add_terrain_collisions(const CostScene& scene, const PathBatch& paths, Lanes& sum_m);

}  // namespace swallowtail::planner
