#pragma once

#include <memory>
#include <vector>

#include "planner/kernels/batch_field.hpp"
#include "planner/kernels/obstacle_field.hpp"
#include "planner/path/path.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::planner {

/// What the objectives see of a world: made once, immutable. Obstacles stand where they are at mission time
/// 0; one that is gone by then does not count.
struct CostScene {
  CostScene(std::shared_ptr<const World> world_in, const VehicleLimits& limits_in, const Vec3& start,
            const Vec3& goal);
  CostScene(const CostScene&) = delete;
  CostScene& operator=(const CostScene&) = delete;

  struct Ball {
    Vec3 center_m = Vec3::Zero();
    double radius_m = 0.0;
  };
  /// A standing vertical circle around an obstacle, what [NMOPSO F2] and [SPSO] call a threat.
  struct Disc {
    Vec2 center_m = Vec2::Zero();
    double radius_m = 0.0;
  };

  /// Ground at the nearest sample of the raster; that of the surface where there is no raster.
  double nearest_ground_m(double x_m, double y_m) const;

  std::shared_ptr<const World> world;
  VehicleLimits limits;
  Vec3 start_m;
  Vec3 goal_m;
  double distance_m = 0.0;  ///< start to goal
  ObstacleField field;
  BatchField batch;              ///< of `field`
  double most_required_m = 0.0;  ///< greatest distance to keep from any obstacle
  std::vector<Ball> balls;       ///< around every obstacle
  std::vector<Disc> discs;       ///< around every obstacle
  double ground_min_m = 0.0;     ///< lowest and highest ground within the bounds
  double ground_max_m = 0.0;
  double top_m = 0.0;  ///< of the highest ground or obstacle
};

}  // namespace swallowtail::planner
