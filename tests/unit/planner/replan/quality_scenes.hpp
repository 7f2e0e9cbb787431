#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "planner/base/rng.hpp"
#include "planner/replan/point_to_point.hpp"
#include "planner/world/world.hpp"

/// Families of random scenes of the kinds that the planner is judged on: which one, says the seed.
namespace swallowtail::planner::quality_scenes {

struct Scene {
  std::shared_ptr<const World> world;
  PlanRequest request;
};

/// A vehicle that is a point, as in document PSO. `climb_max_rad` π/2: no climb limit.
inline VehicleLimits point_vehicle(double climb_max_rad) {
  return {.radius_m = 1e-6,
          .margin_m = 0.0,
          .cruise_speed_mps = 1.0,
          .climb_speed_mps = 1.0,
          .descent_speed_mps = 1.0,
          .turn_max_rad = std::numbers::pi,
          .climb_max_rad = climb_max_rad};
}

inline Vec3 anywhere(Rng& rng, const Vec3& lo, const Vec3& hi) {
  return {rng.uniform(lo.x(), hi.x()), rng.uniform(lo.y(), hi.y()), rng.uniform(lo.z(), hi.z())};
}

/// The box, start and goal of document PSO among `count` spheres of its sizes.
inline Scene spheres(std::uint64_t seed, int count, double climb_max_rad) {
  Rng rng(seed);
  Scene scene;
  scene.request.limits = point_vehicle(climb_max_rad);
  scene.request.start_m = Vec3(1, 1, 1);
  scene.request.goal_m = Vec3(10, 10, 10);
  std::vector<Obstacle> obstacles;
  while (static_cast<int>(obstacles.size()) < count) {
    const Vec3 center = anywhere(rng, Vec3(2, 2, 2), Vec3(10, 10, 10));
    const double radius = rng.uniform(0.9, 2.3);
    if ((center - scene.request.start_m).norm() < radius + 0.1) continue;
    if ((center - scene.request.goal_m).norm() < radius + 0.1) continue;
    const auto id = static_cast<std::uint32_t>(obstacles.size() + 1);
    obstacles.push_back({.id = id, .shape = Sphere{radius}, .position_m = center});
  }
  scene.world = *World::make(Terrain::flat(-1.0), std::move(obstacles), {Vec3::Zero(), Vec3::Constant(11)});
  return scene;
}

/// Five Gaussian hills up to 30 m high on 40 × 40 m, and 20 balls; from corner to corner.
inline Scene hills_and_balls(std::uint64_t seed, double climb_max_rad) {
  Rng rng(seed);
  std::vector<Mountain> mountains;
  for (int i = 0; i < 5; ++i) {
    mountains.push_back({rng.uniform(4, 36), rng.uniform(4, 36), rng.uniform(10, 30), 20.0});
  }
  const Terrain terrain = *mountains_terrain(mountains, Vec2(0, 0), Vec2(40, 40), 0.5);
  Scene scene;
  scene.request.limits = point_vehicle(climb_max_rad);
  const auto above = [&](double x, double y) {
    const double ground = terrain.height_at(x, y);
    return Vec3(x, y, rng.uniform(ground + 0.5, std::max(ground + 1.0, 20.0)));
  };
  scene.request.start_m = above(rng.uniform(0.5, 3), rng.uniform(0.5, 3));
  scene.request.goal_m = above(rng.uniform(37, 39.5), rng.uniform(37, 39.5));
  std::vector<Obstacle> obstacles;
  while (obstacles.size() < 20) {
    const Vec3 center = anywhere(rng, Vec3(2, 2, 2), Vec3(38, 38, 28));
    const double radius = rng.uniform(1.5, 5.0);
    if ((center - scene.request.start_m).norm() < radius + 0.3) continue;
    if ((center - scene.request.goal_m).norm() < radius + 0.3) continue;
    const auto id = static_cast<std::uint32_t>(obstacles.size() + 1);
    obstacles.push_back({.id = id, .shape = Sphere{radius}, .position_m = center});
  }
  scene.world = *World::make(terrain, std::move(obstacles), {Vec3::Zero(), Vec3(40, 40, 30)});
  return scene;
}

inline Obstacle solid_of_any_kind(Rng& rng, const Terrain& terrain, double size_m) {
  Obstacle o;
  const double r = size_m * rng.uniform(0.3, 1.0);
  const double ground = terrain.height_at(o.position_m.x(), o.position_m.y());
  o.position_m.z() = ground;
  switch (rng.below(4)) {
    case 0:
      o.shape = Sphere{r};
      break;
    case 1:
      o.shape = Cylinder{0.5 * r, 6.0 * r};
      break;
    case 2:
      o.shape = Cone{r, 6.0 * r};
      break;
    default:
      o.shape = Box{Vec3(r, 1.5 * r, 6.0 * r), rng.uniform(0.0, 3.0)};
  }
  return o;
}

/// `count` solids on a hilly square of `side_m`, the flight from corner to corner between them.
inline Scene city(std::uint64_t seed, int count, double side_m) {
  Rng rng(seed);
  std::vector<Mountain> mountains;
  for (int i = 0; i < 30; ++i) {
    mountains.push_back({rng.uniform(0, side_m), rng.uniform(0, side_m), rng.uniform(10, 120),
                         std::pow(side_m * rng.uniform(0.03, 0.12), 2)});
  }
  const Terrain terrain = *mountains_terrain(mountains, Vec2(0, 0), Vec2(side_m, side_m), side_m / 400.0);
  Scene scene;
  const auto above = [&](double share) {
    const double at = share * side_m;
    return Vec3(at, at, terrain.height_at(at, at) + 15.0);
  };
  scene.request.start_m = above(0.02);
  scene.request.goal_m = above(0.98);
  const double size = 0.3 * side_m / std::sqrt(static_cast<double>(count));
  std::vector<Obstacle> obstacles;
  while (static_cast<int>(obstacles.size()) < count) {
    Obstacle o = solid_of_any_kind(rng, terrain, size);
    const double x = rng.uniform(0, side_m);
    const double y = rng.uniform(0, side_m);
    o.position_m = Vec3(x, y, terrain.height_at(x, y));
    if (std::holds_alternative<Sphere>(o.shape)) o.position_m.z() += rng.uniform(0, 5.0 * size);
    if (std::holds_alternative<Box>(o.shape)) o.position_m.z() += 1.5 * size;
    const double keep = bounding_radius_m(o.shape) + 4.0;
    if ((o.position_m - scene.request.start_m).norm() < keep) continue;
    if ((o.position_m - scene.request.goal_m).norm() < keep) continue;
    o.id = static_cast<std::uint32_t>(obstacles.size() + 1);
    obstacles.push_back(o);
  }
  scene.world = *World::make(terrain, std::move(obstacles), {Vec3(0, 0, -10), Vec3(side_m, side_m, 400)});
  return scene;
}

}  // namespace swallowtail::planner::quality_scenes
