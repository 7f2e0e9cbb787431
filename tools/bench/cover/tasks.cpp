#include "tools/bench/cover/tasks.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/base/rng.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::bench {
namespace {

constexpr double kSensorWidth_m = 10.0;
constexpr int kStripsForHole = 8;

struct Place {
  Vec2 corner_m = Vec2::Zero();
  double length_m = 0.0;
  double width_m = 0.0;
  double skew_m = 0.0;
};

coverage::Polygon skewed(const Place& place, double hole_share) {
  const auto at = [&](double x_m, double y_m) { return Vec2(place.corner_m + Vec2(x_m, y_m)); };
  coverage::Polygon out;
  out.outline = {at(0.0, 0.0), at(place.length_m, 0.0), at(place.length_m + place.skew_m, place.width_m),
                 at(place.skew_m, place.width_m)};
  if (hole_share <= 0.0) return out;
  const double x_m = place.length_m / 2.0;
  const double y_m = place.width_m / 2.0;
  const double half_m = std::min(place.length_m, place.width_m) * hole_share;
  out.holes.push_back({at(x_m - half_m, y_m - half_m), at(x_m - half_m, y_m + half_m),
                       at(x_m + half_m, y_m + half_m), at(x_m + half_m, y_m - half_m)});
  return out;
}

}  // namespace

coverage::Task task_of(const coverage::Field& field) {
  coverage::Task task;
  task.fields = {field};
  task.sensor_width_m = kSensorWidth_m;
  const coverage::Ring& outline = field.polygon.outline;
  const Vec2 corner_m = outline.empty() ? Vec2(Vec2::Zero()) : outline.front();
  task.start_m = Vec3(corner_m.x(), corner_m.y(), 0.0);
  task.charger.start_m = task.start_m;
  return task;
}

coverage::Task banded_task(int strips, std::uint64_t seed) {
  Rng rng(seed);
  coverage::Task task;
  task.sensor_width_m = kSensorWidth_m;
  task.start_m = task.charger.start_m = Vec3(-20.0, -20.0, 0.0);
  task.battery.capacity = rng.uniform(300.0, 800.0);
  const double length_m = rng.uniform(200.0, 600.0);
  std::vector<double> heights_m(2 + rng.below(5));
  for (double& height_m : heights_m) height_m = rng.uniform(5.0, 50.0);
  const int most = std::clamp(strips / (8 + static_cast<int>(rng.below(8))), 5, 60);
  Vec2 corner_m = Vec2::Zero();
  for (int made = 0; made < strips;) {
    const int drawn = most / 2 + static_cast<int>(rng.below(static_cast<std::uint64_t>(most)));
    const int here = std::clamp(drawn, 1, strips - made);
    const Place place{corner_m, length_m, here * kSensorWidth_m, rng.uniform(-0.3, 0.3) * length_m};
    const double hole_share = here >= kStripsForHole ? rng.uniform(0.05, 0.2) : 0.0;
    const auto id = static_cast<std::uint32_t>(task.fields.size() + 1);
    task.fields.push_back({id, "band " + std::to_string(id), skewed(place, hole_share),
                           heights_m[rng.below(heights_m.size())]});
    made += here;
    corner_m.y() += place.width_m + rng.uniform(5.0, 60.0);
    if (corner_m.y() > 4.0 * kSensorWidth_m * std::sqrt(strips))
      corner_m = Vec2(corner_m.x() + 2.0 * length_m, 0.0);
  }
  return task;
}

Planned plan_timed(const coverage::Task& task, std::uint64_t seed) {
  const ThreadCpuClock clock;
  coverage::PlanOptions options;
  options.seed = seed;
  options.clock = &clock;
  const double began_s = clock.now_s();
  Planned out{coverage::plan_coverage(task, planner::Terrain::flat(0.0), options), 0.0};
  out.cpu_ms = 1e3 * (clock.now_s() - began_s);
  return out;
}

}  // namespace swallowtail::bench
