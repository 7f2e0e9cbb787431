#include "charger/motion/drive.hpp"

#include <algorithm>

#include "planner/base/checks.hpp"

namespace swallowtail::charger {

double Drive::distance_to_m(const Vec3& target_m) const {
  return (target_m.head<2>() - position_m_.head<2>()).norm();
}

void Drive::advance(const Vec3& target_m, double speed_mps, double duration_s) {
  speed_mps_ = 0.0;
  if (!is_finite(target_m) || !is_positive(speed_mps) || !is_positive(duration_s)) return;
  const double distance_m = distance_to_m(target_m);
  const double driven_m = std::min(distance_m, speed_mps * duration_s);
  if (driven_m >= distance_m) {
    position_m_ = target_m;
  } else {
    position_m_ += (target_m - position_m_) * (driven_m / distance_m);
  }
  speed_mps_ = driven_m / duration_s;
}

}  // namespace swallowtail::charger
