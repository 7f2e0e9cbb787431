#include "planner/cost/clearance.hpp"

#include <vector>

namespace swallowtail::planner {

void ClearanceShortfall::evaluate(const PathBatch& paths, Lanes& values) const {
  thread_local std::vector<LaneDistance> buffer;
  values.setZero();
  const double reach_m = scene_->most_required_m + danger_distance_m_;
  for (std::size_t hop = 0; hop < paths.hops(); ++hop) {
    for (const LaneDistance& near :
         scene_->batch.distances(paths.point(hop), paths.point(hop + 1), reach_m, buffer)) {
      const double wanted_m = scene_->field.required_m(near.obstacle) + danger_distance_m_;
      values += ((wanted_m - near.signed_distance_m) / danger_distance_m_).max(0.0);
    }
  }
}

}  // namespace swallowtail::planner
