#include "tools/cli/energy.hpp"

#include <cmath>

namespace swallowtail::cli {

namespace {

double power_of(const coverage::EnergyModel& model, const Vec3& move, double duration_s) {
  if (model.multirotor) return coverage::base_power(model, move / duration_s);
  if (move.isZero()) return model.hover_per_s;
  if (std::abs(move.z()) <= move.head<2>().norm()) return model.level_per_s;
  return move.z() > 0.0 ? model.climb_per_s : model.descent_per_s;
}

}  // namespace

double energy_of(const planner::TimedPath& path, const coverage::EnergyModel& model) {
  double energy = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3& from = path[i - 1].position_m;
    const Vec3& to = path[i].position_m;
    const double duration_s = path[i].time_s - path[i - 1].time_s;
    if (!(duration_s > 0.0)) continue;
    energy += power_of(model, to - from, duration_s) *
              coverage::mean_altitude_factor(model, from.z(), to.z()) * duration_s;
  }
  return energy;
}

}  // namespace swallowtail::cli
