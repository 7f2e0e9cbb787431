#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "planner/base/rng.hpp"
#include "planner/path/path.hpp"
#include "planner/world/world.hpp"

/// Seeded worlds and routes, and a judge that shares no code with the planner: it samples a path densely and
/// measures distances to solids point by point.
namespace swallowtail::planner::random_worlds {

struct Scene {
  std::shared_ptr<const World> world;
  std::vector<RoutePoint> route;
  Vec3 start;
};

struct SceneOptions {
  int strips = 20;
  double strip_length_m = 120.0;
  double spacing_m = 10.0;
  double height_m = 30.0;
  int points_per_strip = 4;  ///< besides the entry
  int standing = 10;
  int moving = 0;
};

/// Take-off, strips up and down, landing.
inline std::vector<RoutePoint> strips(const SceneOptions& options) {
  std::vector<RoutePoint> route;
  route.push_back({Vec3(0, 0, options.height_m), Phase::kTakeOff, 0, 0.0});
  for (int i = 0; i < options.strips; ++i) {
    const auto leg = static_cast<std::uint32_t>(i);
    const double x = i * options.spacing_m;
    const bool up = i % 2 == 0;
    const double from = up ? 0.0 : options.strip_length_m;
    const double to = options.strip_length_m - from;
    route.push_back({Vec3(x, from, options.height_m), Phase::kTransfer, leg, 0.0});
    for (int k = 1; k <= options.points_per_strip; ++k) {
      const double y = from + (to - from) * k / options.points_per_strip;
      route.push_back({Vec3(x, y, options.height_m), Phase::kCover, leg, 0.0});
    }
  }
  Vec3 ground = route.back().position_m;
  ground.z() = 0.0;
  route.push_back({ground, Phase::kLanding, route.back().leg_index, 0.0});
  return route;
}

inline Obstacle random_obstacle(Rng& rng, std::uint32_t id, const SceneOptions& options, bool moves) {
  Obstacle o;
  o.id = id;
  const double width = options.strips * options.spacing_m;
  o.position_m = Vec3(rng.uniform(5.0, width), rng.uniform(8.0, options.strip_length_m - 8.0), 0.0);
  switch (rng.below(4)) {
    case 0:
      o.shape = Sphere{rng.uniform(2.0, 8.0)};
      o.position_m.z() = options.height_m + rng.uniform(-4.0, 4.0);
      break;
    case 1:
      o.shape = Cylinder{rng.uniform(1.0, 6.0), rng.uniform(20.0, 60.0)};
      break;
    case 2:
      o.shape = Cone{rng.uniform(3.0, 12.0), rng.uniform(30.0, 60.0)};
      break;
    default:
      o.shape = Box{Vec3(rng.uniform(3, 12), rng.uniform(3, 12), rng.uniform(10, 30)), rng.uniform(0, 3.0)};
      o.position_m.z() = options.height_m;
  }
  if (moves) {
    o.velocity_mps = Vec3(rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-0.2, 0.2));
    o.state_time_s = rng.uniform(0.0, 150.0);
  }
  return o;
}

inline double horizontal_gap(const Vec3& p, const Vec3& q) {
  return std::hypot(p.x() - q.x(), p.y() - q.y());
}

inline Scene make_scene(std::uint64_t seed, const SceneOptions& options) {
  Rng rng(seed);
  Scene scene;
  scene.route = strips(options);
  scene.start = Vec3(0, 0, 0);
  std::vector<Obstacle> obstacles;
  std::uint32_t id = 1;
  const Vec3 goal = scene.route.back().position_m;
  while (static_cast<int>(obstacles.size()) < options.standing + options.moving) {
    const bool moves = static_cast<int>(obstacles.size()) >= options.standing;
    Obstacle o = random_obstacle(rng, id, options, moves);
    // The columns above take-off and landing stay free of what stands.
    const double keep = bounding_radius_m(o.shape) + 4.0;
    if (!moves &&
        (horizontal_gap(o.position_m, scene.start) < keep || horizontal_gap(o.position_m, goal) < keep))
      continue;
    o.id = id++;
    obstacles.push_back(o);
  }
  Bounds bounds;
  bounds.min_m = Vec3(-200, -200, -1);
  bounds.max_m = Vec3(options.strips * options.spacing_m + 200, options.strip_length_m + 200, 150);
  Result<std::shared_ptr<const World>> world = World::make(Terrain::flat(0.0), obstacles, bounds);
  scene.world = world.ok() ? *world : nullptr;
  return scene;
}

/// Distance of a point to a solid at that time; 0 inside.
inline double distance(const Obstacle& o, const Vec3& point, double time_s) {
  const Vec3 p = point - (o.position_m + o.velocity_mps * (time_s - o.state_time_s));
  const double r = std::hypot(p.x(), p.y());
  if (const auto* s = std::get_if<Sphere>(&o.shape)) return std::max(0.0, p.norm() - s->radius_m);
  if (const auto* c = std::get_if<Cylinder>(&o.shape)) {
    const double dz = std::max({0.0, -p.z(), p.z() - c->height_m});
    return std::hypot(std::max(0.0, r - c->radius_m), dz);
  }
  if (const auto* c = std::get_if<Cone>(&o.shape)) {
    // The nearest of many points of the profile: no formula shared with anyone.
    if (p.z() >= 0.0 && p.z() <= c->height_m && r <= c->radius_m * (1.0 - p.z() / c->height_m)) return 0.0;
    double best = 1e9;
    for (int k = 0; k <= 200; ++k) {
      const double s = k / 200.0;
      best = std::min(best, Vec2(r - c->radius_m * (1.0 - s), p.z() - c->height_m * s).norm());
      best = std::min(best, Vec2(r - c->radius_m * s, p.z()).norm());
    }
    return best;
  }
  if (const auto* b = std::get_if<Box>(&o.shape)) {
    const Vec3 q(std::cos(b->yaw_rad) * p.x() + std::sin(b->yaw_rad) * p.y(),
                 -std::sin(b->yaw_rad) * p.x() + std::cos(b->yaw_rad) * p.y(), p.z());
    const Vec3 outside = (q.cwiseAbs() - 0.5 * b->size_m).cwiseMax(0.0);
    return outside.norm();
  }
  return 1e9;
}

/// "" if the path keeps its distance wherever it is looked at; else what it breaks.
inline std::string dense_check(const TimedPath& path, const World& world, const VehicleLimits& limits) {
  const double clearance = limits.radius_m + limits.margin_m;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double duration = path[i].time_s - path[i - 1].time_s;
    if (!(duration >= 0.0)) return "time goes back at " + std::to_string(i);
    const Vec3 move = path[i].position_m - path[i - 1].position_m;
    const double level = std::hypot(move.x(), move.y());
    if (level > 1e-5 && move.norm() > limits.cruise_speed_mps * duration * 1.00001)
      return "too fast at " + std::to_string(i);
    const auto steps = static_cast<int>(std::ceil(std::max(duration / 0.1, move.norm() / 0.3))) + 1;
    const bool near_ground = path[i].phase == Phase::kTakeOff || path[i].phase == Phase::kLanding;
    for (int k = 0; k <= steps; ++k) {
      const double s = static_cast<double>(k) / steps;
      const Vec3 p = path[i - 1].position_m + s * move;
      const double t = path[i - 1].time_s + s * duration;
      if (!near_ground && p.z() - world.terrain().height_at(p.x(), p.y()) < clearance - 1e-6)
        return "too low at " + std::to_string(i);
      for (const Obstacle& o : world.obstacles()) {
        if (t > o.valid_until_s) continue;
        if (distance(o, p, t) < clearance + o.margin_m - 1e-3) {
          return "obstacle " + std::to_string(o.id) + " too near at " + std::to_string(t) + " s";
        }
      }
    }
  }
  return "";
}

}  // namespace swallowtail::planner::random_worlds
