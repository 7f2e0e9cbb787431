#include "tools/bench/micro/scenes.hpp"

#include <cmath>

namespace swallowtail::microbench {

using planner::Obstacle;
using planner::World;

namespace {

Vec3 random_point(Rng& rng, const Vec3& lo, const Vec3& hi) {
  const double x = rng.uniform(lo.x(), hi.x());
  const double y = rng.uniform(lo.y(), hi.y());
  return {x, y, rng.uniform(lo.z(), hi.z())};
}

}  // namespace

planner::VehicleLimits small_aircraft() {
  planner::VehicleLimits limits;
  limits.radius_m = 0.01;
  limits.margin_m = 0.0;
  limits.climb_max_rad = 1.5;
  return limits;
}

std::vector<Obstacle> random_balls(Rng& rng, int count, const Vec3& lo, const Vec3& hi, double radius_m) {
  std::vector<Obstacle> balls;
  for (int i = 0; i < count; ++i) {
    Obstacle ball;
    ball.id = static_cast<std::uint32_t>(i + 1);
    ball.shape = planner::Sphere{radius_m * rng.uniform(0.5, 1.0)};
    ball.position_m = random_point(rng, lo, hi);
    balls.push_back(ball);
  }
  return balls;
}

std::vector<Obstacle> random_shapes(Rng& rng, int count, const Vec3& lo, const Vec3& hi, double size_m) {
  std::vector<Obstacle> obstacles = random_balls(rng, count, lo, hi, 0.5 * size_m);
  for (Obstacle& obstacle : obstacles) {
    const double size = size_m * rng.uniform(0.3, 1.0);
    switch (rng.below(4)) {
      case 0:
        obstacle.shape = planner::Cylinder{0.5 * size, size};
        break;
      case 1:
        obstacle.shape = planner::Cone{0.5 * size, size};
        break;
      case 2:
        obstacle.shape = planner::Box{Vec3(size, 0.5 * size, 0.7 * size), rng.uniform(0.0, 3.0)};
        break;
      default:
        break;
    }
  }
  return obstacles;
}

std::shared_ptr<const World> ball_world(int count) {
  Rng rng(11);
  auto balls = random_balls(rng, count, Vec3::Constant(2.0), Vec3::Constant(9.0), 2.0);
  return *World::make(planner::Terrain::flat(-1.0), balls, planner::Bounds{});
}

std::shared_ptr<const World> mountain_world(double cell_size_m) {
  Rng rng(12);
  std::vector<planner::Mountain> mountains;
  for (int i = 0; i < 5; ++i) {
    mountains.push_back(
        {rng.uniform(5.0, 35.0), rng.uniform(5.0, 35.0), rng.uniform(8.0, 20.0), rng.uniform(15.0, 40.0)});
  }
  const auto terrain =
      *planner::mountains_terrain(mountains, Vec2::Zero(), Vec2::Constant(40.0), cell_size_m);
  auto balls = random_balls(rng, 20, Vec3(4.0, 4.0, 4.0), Vec3(36.0, 36.0, 26.0), 3.0);
  return *World::make(terrain, balls, planner::Bounds{});
}

planner::TerrainGrid hill_grid(int samples, double cell_size_m) {
  planner::TerrainGrid grid{Vec2::Zero(), cell_size_m, samples, samples, {}};
  Rng rng(13);
  for (int r = 0; r < samples; ++r) {
    for (int c = 0; c < samples; ++c) {
      const double hills = 60.0 + 40.0 * std::sin(0.011 * c) + 40.0 * std::cos(0.017 * r + 0.005 * c);
      grid.elevation_m.push_back(static_cast<float>(hills + rng.uniform(0.0, 2.0)));
    }
  }
  return grid;
}

std::vector<Obstacle> obstacles_on_hills(int count, double side_m) {
  Rng rng(14);
  return random_shapes(rng, count, Vec3(0.0, 0.0, 0.0), Vec3(side_m, side_m, 200.0), 40.0);
}

Eigen::MatrixXd random_candidates(int waypoints, int count, const Vec3& lo, const Vec3& hi) {
  Rng rng(15);
  Eigen::MatrixXd x(3 * waypoints, count);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < waypoints; ++k) x.col(i).segment<3>(3 * k) = random_point(rng, lo, hi);
  }
  return x;
}

Eigen::MatrixXd candidates_about_line(int waypoints, int count, const Vec3& from, const Vec3& to,
                                      double spread_m) {
  Eigen::MatrixXd x =
      random_candidates(waypoints, count, Vec3::Constant(-spread_m), Vec3::Constant(spread_m));
  for (int k = 0; k < waypoints; ++k) {
    const Vec3 on_line = from + (to - from) * ((k + 1.0) / (waypoints + 1.0));
    x.middleRows<3>(3 * k).colwise() += on_line;
  }
  return x;
}

}  // namespace swallowtail::microbench
