#pragma once

#include <cmath>
#include <numbers>

#include "coverage/schedule/task.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::coverage::test {

/// A star-shaped field around a centre, concave as a rule, sometimes with a hole.
inline Polygon random_polygon(Rng& rng, const Vec2& centre, double radius_m) {
  Polygon out;
  const int corners = 4 + static_cast<int>(rng.below(9));
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.6 * rng.uniform()) / corners;
    const double r = radius_m * rng.uniform(0.5, 1.0);
    out.outline.emplace_back(centre.x() + r * std::cos(angle), centre.y() + r * std::sin(angle));
  }
  if (rng.uniform() < 0.5) {
    Ring hole;
    const int sides = 3 + static_cast<int>(rng.below(5));
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      hole.emplace_back(centre.x() + 0.2 * radius_m * std::cos(angle),
                        centre.y() + 0.2 * radius_m * std::sin(angle));
    }
    out.holes.push_back(hole);
  }
  return out;
}

/// One or two fields of different heights, a battery that does for a few strips, and a robot of ordinary
/// speed.
inline Task random_task(Rng& rng) {
  Task task;
  const int fields = 1 + static_cast<int>(rng.below(2));
  for (int f = 0; f < fields; ++f) {
    const Vec2 centre(250.0 * f + rng.uniform(-20.0, 20.0), rng.uniform(-50.0, 50.0));
    task.fields.push_back({static_cast<std::uint32_t>(f + 1), "random",
                           random_polygon(rng, centre, rng.uniform(40.0, 110.0)), rng.uniform(5.0, 40.0)});
  }
  task.sensor_width_m = rng.uniform(8.0, 20.0);
  task.battery.capacity = rng.uniform(120.0, 400.0);
  task.battery.reserve = rng.uniform(5.0, 30.0);
  task.battery.charge_s_per_unit = rng.uniform(0.2, 3.0);
  task.charger.speed_mps = rng.uniform(0.8, 3.0);
  task.charger.start_m = Vec3(-120.0, -120.0, 0.0);
  task.start_m = Vec3(rng.uniform(-120.0, 0.0), -100.0, 0.0);
  return task;
}

}  // namespace swallowtail::coverage::test
