#include "planner/cost/altitude_band.hpp"

#include <cmath>

namespace swallowtail::planner {

void AltitudeBand::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  if (paths.points() < 3) return;
  const double middle_m = 0.5 * (min_m_ + max_m_);
  const double half_m = 0.5 * (max_m_ - min_m_);
  for (std::size_t i = 1; i + 1 < paths.points(); ++i) {
    const LanePoint& p = paths.point(i);
    for (int lane = 0; lane < kLanes; ++lane) {
      const double ground_m = scene_->world->terrain().height_at(p.x[lane], p.y[lane]);
      const double off = std::abs(p.z[lane] - ground_m - middle_m) / half_m;
      values[lane] += off <= 1.0 ? off : 1.0 + kBeyondLimit * (off - 1.0);
    }
  }
  values /= static_cast<double>(paths.points() - 2);
}

}  // namespace swallowtail::planner
