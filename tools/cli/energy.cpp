#include "tools/cli/energy.hpp"

#include <cmath>

namespace swallowtail::cli {

double energy_of(const planner::TimedPath& path, const planner::EnergyRates& rates) {
  double energy = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3 move = path[i].position_m - path[i - 1].position_m;
    const double level_m = move.head<2>().norm();
    double rate = rates.level_per_s;
    if (move.isZero()) {
      rate = rates.hover_per_s;
    } else if (std::abs(move.z()) > level_m) {
      rate = move.z() > 0.0 ? rates.climb_per_s : rates.descent_per_s;
    }
    energy += rate * (path[i].time_s - path[i - 1].time_s);
  }
  return energy;
}

}  // namespace swallowtail::cli
