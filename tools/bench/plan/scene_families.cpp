#include "tools/bench/plan/scene_families.hpp"

#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "planner/base/rng.hpp"

namespace swallowtail::bench {
namespace {

using planner::Obstacle;

constexpr std::string_view kPointVehicle =
    "vehicle: {radius_m: 1.0e-6, margin_m: 0, cruise_speed_mps: 1, climb_speed_mps: 1, descent_speed_mps: 1, "
    "turn_max_deg: 180, climb_max_deg: 89}\n";

double segment_distance_m(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + t * (b - a) - p).norm();
}

/// Two decimals, as the file will say it.
double cm(double value) { return std::round(100.0 * value) / 100.0; }

struct Ball {
  Vec3 center_m;
  double radius_m;
};

/// Balls that leave both ends free, the first of which lies across the straight line.
std::vector<Ball> balls(Rng& rng, int count, const Vec3& start, const Vec3& goal, const Vec3& box,
                        double least_m, double most_m) {
  std::vector<Ball> out;
  while (static_cast<int>(out.size()) < count) {
    const Ball ball{
        {cm(rng.uniform(0.0, box.x())), cm(rng.uniform(0.0, box.y())), cm(rng.uniform(0.0, box.z()))},
        cm(rng.uniform(least_m, most_m))};
    const double keep_m = ball.radius_m + 0.05 * (goal - start).norm();
    if ((ball.center_m - start).norm() < keep_m || (ball.center_m - goal).norm() < keep_m) continue;
    if (out.empty() && segment_distance_m(ball.center_m, start, goal) > 0.5 * ball.radius_m) continue;
    out.push_back(ball);
  }
  return out;
}

/// Rolling ground of five sizes of waves; about ±25 m.
planner::TerrainGrid rough_ground(Rng& rng, int samples) {
  planner::TerrainGrid grid{{0.0, 0.0}, 1.0, samples, samples, {}};
  struct Wave {
    double kx, ky, phase, height_m;
  };
  std::vector<Wave> waves;
  for (int octave = 0; octave < 5; ++octave) {
    for (int i = 0; i < 3; ++i) {
      const double length_m = 1000.0 / std::pow(2.0, octave) * rng.uniform(0.7, 1.3);
      const double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
      const double k = 2.0 * std::numbers::pi / length_m;
      waves.push_back({k * std::cos(angle), k * std::sin(angle), rng.uniform(0.0, 2.0 * std::numbers::pi),
                       10.0 / std::pow(2.0, octave)});
    }
  }
  grid.elevation_m.reserve(static_cast<std::size_t>(samples) * static_cast<std::size_t>(samples));
  for (int r = 0; r < samples; ++r) {
    for (int c = 0; c < samples; ++c) {
      double z = 0.0;
      for (const Wave& w : waves) z += w.height_m * std::sin(w.kx * c + w.ky * r + w.phase);
      grid.elevation_m.push_back(static_cast<float>(z));
    }
  }
  return grid;
}

planner::Shape solid(Rng& rng) {
  const double size_m = rng.uniform(4.0, 14.0);
  switch (rng.below(4)) {
    case 0:
      return planner::Sphere{size_m};
    case 1:
      return planner::Cylinder{0.6 * size_m, rng.uniform(30.0, 120.0)};
    case 2:
      return planner::Cone{size_m, rng.uniform(30.0, 120.0)};
    default:
      return planner::Box{Vec3(size_m, rng.uniform(4.0, 14.0), rng.uniform(30.0, 120.0)),
                          rng.uniform(0.0, std::numbers::pi)};
  }
}

}  // namespace

std::string hills_and_balls_yaml(std::uint64_t seed) {
  Rng rng(seed);
  const Vec3 start(1, 1, 5);
  const Vec3 goal(39, 39, 5);
  std::string yaml = fmt::format(
      "# Generated: bench family hills_and_balls, seed {0}. The vehicle is a point.\nswallowtail: 1\nname: "
      "hills and "
      "balls {0}\nbounds_m: {{min: [0, 0, 0], max: [40, 40, 30]}}\nterrain:\n  kind: mountains\n  "
      "cell_size_m: "
      "0.25\n  mountains:\n",
      seed);
  for (int i = 0; i < 5;) {
    const double x = cm(rng.uniform(4.0, 36.0));
    const double y = cm(rng.uniform(4.0, 36.0));
    if (std::hypot(x - 1, y - 1) < 10.0 || std::hypot(x - 39, y - 39) < 10.0) continue;
    yaml += fmt::format("    - {{x_m: {}, y_m: {}, height_m: {}, spread_m2: {}}}\n", x, y,
                        cm(rng.uniform(8.0, 20.0)), cm(rng.uniform(15.0, 40.0)));
    ++i;
  }
  yaml += "obstacles:\n";
  int id = 0;
  for (const Ball& b : balls(rng, 20, start, goal, {40, 40, 20}, 2.0, 4.5)) {
    yaml += fmt::format("  - {{id: {}, shape: sphere, center_m: [{}, {}, {}], radius_m: {}}}\n", ++id,
                        b.center_m.x(), b.center_m.y(), b.center_m.z(), b.radius_m);
  }
  return yaml + std::string(kPointVehicle) +
         "start_m: [1, 1, 5]\ngoal_m: [39, 39, 5]\nplanning: {algorithm: boa, waypoints: 6}\n";
}

std::string mixed_shapes_yaml(std::uint64_t seed) {
  Rng rng(seed);
  const Vec3 start(3, 3, 10);
  const Vec3 goal(97, 97, 10);
  std::string yaml = fmt::format(
      "# Generated: bench family mixed_shapes, seed {0}. The vehicle is a point.\nswallowtail: 1\nname: "
      "mixed "
      "shapes {0}\nbounds_m: {{min: [0, 0, 0], max: [100, 100, 40]}}\nterrain: {{kind: flat, elevation_m: "
      "-1}}\n"
      "obstacles:\n",
      seed);
  int id = 0;
  for (const Ball& b : balls(rng, 24, start, goal, {100, 100, 30}, 5.0, 10.0)) {
    const double x = b.center_m.x();
    const double y = b.center_m.y();
    const double height_m = cm(rng.uniform(15.0, 38.0));
    const double radius_m = b.radius_m;
    switch (++id % 4) {
      case 0:
        yaml += fmt::format("  - {{id: {}, shape: cone, base_m: [{}, {}, 0], radius_m: {}, height_m: {}}}\n",
                            id, x, y, radius_m, height_m);
        break;
      case 1:
        yaml += fmt::format("  - {{id: {}, shape: sphere, center_m: [{}, {}, {}], radius_m: {}}}\n", id, x, y,
                            b.center_m.z(), radius_m);
        break;
      case 2:
        yaml +=
            fmt::format("  - {{id: {}, shape: cylinder, base_m: [{}, {}, 0], radius_m: {}, height_m: {}}}\n",
                        id, x, y, cm(0.6 * radius_m), height_m);
        break;
      default:
        yaml += fmt::format(
            "  - {{id: {}, shape: box, center_m: [{}, {}, {}], size_m: [{}, {}, {}], yaw_deg: {}}}\n", id, x,
            y, cm(0.5 * height_m), radius_m, cm(rng.uniform(5.0, 10.0)), height_m,
            cm(rng.uniform(0.0, 90.0)));
    }
  }
  return yaml + std::string(kPointVehicle) +
         "start_m: [3, 3, 10]\ngoal_m: [97, 97, 10]\nplanning: {algorithm: boa, waypoints: 6}\n";
}

Result<PlanCase> big_world(std::uint64_t seed) {
  constexpr int kSamples = 2000;
  constexpr std::uint32_t kObstacles = 10'000;
  constexpr double kEndsFree_m = 40.0;
  Rng rng(seed);
  auto terrain = planner::Terrain::from_grid(rough_ground(rng, kSamples));
  if (!terrain) return terrain.error();
  PlanCase out;
  out.name = "big_world";
  out.start_m = Vec3(60, 60, terrain->height_at(60, 60) + 30.0);
  out.goal_m = Vec3(1940, 1940, terrain->height_at(1940, 1940) + 30.0);
  std::vector<Obstacle> obstacles;
  while (obstacles.size() < kObstacles) {
    Obstacle o;
    o.id = static_cast<std::uint32_t>(obstacles.size()) + 1;
    o.shape = solid(rng);
    const double x = rng.uniform(0.0, kSamples - 1.0);
    const double y = rng.uniform(0.0, kSamples - 1.0);
    const bool flies = std::holds_alternative<planner::Sphere>(o.shape);
    o.position_m = Vec3(x, y, terrain->height_at(x, y) + (flies ? rng.uniform(10.0, 90.0) : -2.0));
    const Vec2 at(x, y);
    if ((at - out.start_m.head<2>()).norm() < kEndsFree_m || (at - out.goal_m.head<2>()).norm() < kEndsFree_m)
      continue;
    obstacles.push_back(std::move(o));
  }
  auto world =
      planner::World::make(*terrain, std::move(obstacles), {Vec3(0, 0, -100), Vec3(1999, 1999, 200)});
  if (!world) return world.error();
  out.world = *world;
  out.limits.radius_m = 1e-6;
  out.limits.margin_m = 0.0;
  out.limits.climb_max_rad = std::numbers::pi / 2.0;
  out.limits.turn_max_rad = std::numbers::pi;
  out.waypoints = 12;
  return out;
}

}  // namespace swallowtail::bench
