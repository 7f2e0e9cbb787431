#include "planner/cost/scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace swallowtail::planner {
namespace {

/// Between level ground and the steepest slope of all; the certifier knows better and has the last word.
constexpr double kSlopeShare = 0.4;

double radius_seen_from_above(const Obstacle& obstacle) {
  if (const auto* cylinder = std::get_if<Cylinder>(&obstacle.shape)) return cylinder->radius_m;
  if (const auto* cone = std::get_if<Cone>(&obstacle.shape)) return cone->radius_m;
  if (const auto* sphere = std::get_if<Sphere>(&obstacle.shape)) return sphere->radius_m;
  const Extent box = extent(obstacle.shape);
  return std::hypot(std::max(-box.min_m.x(), box.max_m.x()), std::max(-box.min_m.y(), box.max_m.y()));
}

ObstacleField with_slope_share(std::shared_ptr<const World> world, const VehicleLimits& limits) {
  ObstacleField field(std::move(world), limits);
  field.set_slope_share(kSlopeShare);
  return field;
}

}  // namespace

CostScene::CostScene(std::shared_ptr<const World> world_in, const VehicleLimits& limits_in, const Vec3& start,
                     const Vec3& goal)
    : world(std::move(world_in)),
      limits(limits_in),
      start_m(start),
      goal_m(goal),
      distance_m((goal - start).norm()),
      field(with_slope_share(world, limits)),
      batch(field) {
  const Terrain& terrain = world->terrain();
  const Bounds& bounds = world->bounds();
  ground_min_m = terrain.min_in(bounds.min_m.head<2>(), bounds.max_m.head<2>());
  ground_max_m = terrain.max_in(bounds.min_m.head<2>(), bounds.max_m.head<2>());
  top_m = ground_max_m;
  const std::span<const Obstacle> obstacles = world->obstacles();
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Obstacle& obstacle = obstacles[i];
    if (obstacle.valid_until_s < 0.0) continue;
    balls.push_back({field.ball_center_m(i, 0.0), field.ball_radius_m(i)});
    most_required_m = std::max(most_required_m, field.required_m(i));
    const Vec3 at = obstacle.position_at(0.0);
    discs.push_back({at.head<2>(), radius_seen_from_above(obstacle)});
    top_m = std::max(top_m, at.z() + extent(obstacle.shape).max_m.z());
  }
}

double CostScene::nearest_ground_m(double x_m, double y_m) const {
  const TerrainGrid* grid = world->terrain().grid();
  if (grid == nullptr) return world->terrain().height_at(x_m, y_m);
  const auto index = [grid](double at_m, double origin_m, int count) {
    const double nearest = std::round((at_m - origin_m) / grid->cell_size_m);
    return static_cast<std::size_t>(std::clamp(nearest, 0.0, count - 1.0));
  };
  const std::size_t row = index(y_m, grid->origin_m.y(), grid->rows);
  return grid
      ->elevation_m[row * static_cast<std::size_t>(grid->cols) + index(x_m, grid->origin_m.x(), grid->cols)];
}

}  // namespace swallowtail::planner
