#pragma once

#include "planner/cost/path_batch.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// Ci of each path [BOA Eq. 12, 13]: with o_r a ball's radius and the distance to keep and d_ptl the exact
/// distance of its centre to the segment, each pair of segment and ball with d_ptl < o_r adds 1 + (o_r −
/// d_ptl), metres. (Printed: no division by the segment's length alone, the infinite line, and the distance
/// to the centre as what is added, by which a head-on hit costs least.) Other shapes count by their signed
/// distance.
void add_ball_collisions(const CostScene& scene, const PathBatch& paths, Lanes& sum);

/// Depths alone, without the count: Σ max(0, o_r − d_ptl), metres.
void add_depths(const CostScene& scene, const PathBatch& paths, Lanes& sum_m);

}  // namespace swallowtail::planner
