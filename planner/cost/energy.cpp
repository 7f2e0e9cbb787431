#include "planner/cost/energy.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/base/checks.hpp"
#include "planner/cost/smoothness.hpp"

namespace swallowtail::planner {

Status validate(const EnergyModel& model, const VehicleLimits& limits) {
  for (const double rate : {model.level_per_s, model.climb_per_s, model.descent_per_s, model.hover_per_s}) {
    if (!is_non_negative(rate)) {
      return bad_input("An energy rate is " + std::to_string(rate) +
                       " per second; it must be finite and at least 0.");
    }
  }
  if (!is_finite(model.wind_mps) || model.wind_mps.norm() >= limits.cruise_speed_mps) {
    return bad_input("The wind is " + std::to_string(model.wind_mps.norm()) +
                     " m/s; it must be finite and below the cruise speed of " +
                     std::to_string(limits.cruise_speed_mps) + " m/s.");
  }
  return {};
}

double Energy::of_segment(double dx, double dy, double dz) const {
  const double level_m = std::sqrt(dx * dx + dy * dy);
  double level_s = 0.0;
  if (level_m > 0.0) {
    const double along = (dx * model_.wind_mps.x() + dy * model_.wind_mps.y()) / level_m;
    const double across2 = model_.wind_mps.squaredNorm() - along * along;
    const double v = limits_.cruise_speed_mps;
    level_s = level_m / (along + std::sqrt(std::max(0.0, v * v - across2)));
  }
  const bool up = dz > 0.0;
  const double vertical_s = up ? dz / limits_.climb_speed_mps : -dz / limits_.descent_speed_mps;
  const double rest_s = std::max(0.0, level_s - vertical_s);
  return vertical_s * (up ? model_.climb_per_s : model_.descent_per_s) + rest_s * model_.level_per_s;
}

void Energy::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  for (std::size_t i = 0; i < paths.hops(); ++i) {
    const PathBatch::Hop& hop = paths.hop(i);
    for (int lane = 0; lane < kLanes; ++lane) {
      values[lane] += of_segment(hop.dx[lane], hop.dy[lane], hop.dz[lane]);
      if (i > 0 && turn_rad(paths.hop(i - 1), hop, lane) > limits_.turn_max_rad) {
        values[lane] += kStopToTurn_s * model_.hover_per_s;
      }
    }
  }
}

}  // namespace swallowtail::planner
