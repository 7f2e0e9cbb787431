#include "tests/support/scenes.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace swallowtail::test {

using planner::Phase;

Vec3 random_point(Rng& rng, const Vec3& lo, const Vec3& hi) {
  const double x = rng.uniform(lo.x(), hi.x());
  const double y = rng.uniform(lo.y(), hi.y());
  return {x, y, rng.uniform(lo.z(), hi.z())};
}

planner::Shape random_shape(Rng& rng, double size_m) {
  const auto size = [&] { return size_m * rng.uniform(0.1, 1.0); };
  switch (rng.below(5)) {
    case 0:
      return planner::Sphere{0.5 * size()};
    case 1:
      return planner::Cylinder{0.5 * size(), size()};
    case 2:
      return planner::Cone{0.5 * size(), size()};
    case 3:
      return planner::Box{Vec3(size(), size(), size()), rng.uniform(-4.0, 4.0)};
    default:
      break;
  }
  planner::ConvexMesh mesh;
  mesh.yaw_rad = rng.uniform(-4.0, 4.0);
  const Vec3 half = 0.5 * Vec3(size(), size(), size());
  const std::size_t count = 4 + rng.below(6);
  for (std::size_t i = 0; i < count; ++i) mesh.vertices_m.push_back(random_point(rng, -half, half));
  return mesh;
}

planner::Obstacle random_obstacle(Rng& rng, std::uint32_t id, const Vec3& lo, const Vec3& hi, double size_m) {
  planner::Obstacle obstacle;
  obstacle.id = id;
  do {
    obstacle.shape = random_shape(rng, size_m);
    obstacle.position_m = random_point(rng, lo, hi);
  } while (!planner::validate(obstacle));
  obstacle.margin_m = rng.below(2) == 0 ? 0.0 : rng.uniform(0.0, 3.0);
  obstacle.state_time_s = rng.uniform(0.0, 20.0);
  if (rng.below(3) == 0)
    obstacle.velocity_mps = random_point(rng, Vec3(-4.0, -4.0, -1.0), Vec3(4.0, 4.0, 1.0));
  if (rng.below(4) == 0) obstacle.valid_until_s = rng.uniform(0.0, 30.0);
  return obstacle;
}

planner::Terrain random_terrain(Rng& rng, const Vec2& lo, int rows, int cols, double cell_size_m,
                                double height_m) {
  planner::TerrainGrid grid{lo, cell_size_m, rows, cols, {}};
  const double wave_x = rng.uniform(0.05, 0.6);
  const double wave_y = rng.uniform(0.05, 0.6);
  const double roughness = rng.uniform(0.0, 0.5);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c) {
      const double hills = 0.5 + 0.25 * std::sin(wave_x * c) + 0.25 * std::cos(wave_y * r);
      grid.elevation_m.push_back(
          static_cast<float>(height_m * ((1.0 - roughness) * hills + roughness * rng.uniform())));
    }
  }
  auto terrain = planner::Terrain::from_grid(std::move(grid));
  if (!terrain) throw std::logic_error(terrain.error().message);
  return *terrain;
}

std::vector<planner::RoutePoint> random_route(Rng& rng, std::size_t points, const Vec3& lo, const Vec3& hi) {
  std::vector<planner::RoutePoint> route;
  for (std::size_t i = 0; i < points; ++i) {
    planner::RoutePoint point;
    point.position_m = random_point(rng, lo, hi);
    if (i > 0) {
      const Vec3& last = route.back().position_m;
      switch (rng.below(8)) {
        case 0:
          point.position_m = last;
          break;  // a stop
        case 1:
          point.position_m.head<2>() = last.head<2>();
          break;  // straight up or down
        case 2:
          point.position_m.z() = last.z();
          break;  // level
        case 3:
          point.position_m = last + 1e-5 * point.position_m;
          break;  // hardly a move
        default:
          break;
      }
    }
    constexpr Phase kPhases[] = {Phase::kTakeOff, Phase::kTransfer, Phase::kCover, Phase::kHold,
                                 Phase::kLanding};
    point.phase = kPhases[rng.below(5)];
    point.leg_index = static_cast<std::uint32_t>(i);
    if (rng.below(4) == 0) point.dwell_s = rng.uniform(0.0, 3.0);
    route.push_back(point);
  }
  return route;
}

std::string as_code(const planner::TimedPath& path) {
  std::string text = "TimedPath{";
  for (const auto& w : path) {
    char line[200];
    std::snprintf(line, sizeof line, "\n  {%.17g, Vec3(%.17g, %.17g, %.17g), Phase(%d), %u},", w.time_s,
                  w.position_m.x(), w.position_m.y(), w.position_m.z(), static_cast<int>(w.phase),
                  w.leg_index);
    text += line;
  }
  return text + "}";
}

}  // namespace swallowtail::test
