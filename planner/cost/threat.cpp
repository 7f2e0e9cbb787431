#include "planner/cost/threat.hpp"

namespace swallowtail::planner {

void Threat::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  for (std::size_t i = 1; i + 1 < paths.points(); ++i) {
    const LanePoint& p = paths.point(i);
    for (const CostScene::Ball& ball : scene_->balls) {
      const Lanes x = p.x - ball.center_m.x();
      const Lanes y = p.y - ball.center_m.y();
      const Lanes z = p.z - ball.center_m.z();
      values += (1.0 - (x * x + y * y + z * z).sqrt() / ball.radius_m).max(0.0);
    }
  }
}

}  // namespace swallowtail::planner
