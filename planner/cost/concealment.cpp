#include "planner/cost/concealment.hpp"

#include <limits>

namespace swallowtail::planner {

void Concealment::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  const double highest_m = scene_->top_m - scene_->ground_min_m;
  for (std::size_t i = 1; i + 1 < paths.points(); ++i) {
    const LanePoint& p = paths.point(i);
    Lanes nearest_m = Lanes::Constant(std::numeric_limits<double>::infinity());
    for (const CostScene::Ball& ball : scene_->balls) {
      const Lanes x = p.x - ball.center_m.x();
      const Lanes y = p.y - ball.center_m.y();
      const Lanes z = p.z - ball.center_m.z();
      nearest_m = nearest_m.min((x * x + y * y + z * z).sqrt() - ball.radius_m);
    }
    Lanes s = ((safe_distance_m_ - nearest_m) / safe_distance_m_).max(0.0);
    if (highest_m > 0.0) s += ((p.z - scene_->top_m) / highest_m).max(0.0);
    values += s * (0.5 / scene_->distance_m) * (paths.hop(i - 1).length + paths.hop(i).length);
  }
}

}  // namespace swallowtail::planner
