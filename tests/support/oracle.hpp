#pragma once

#include <limits>

#include "planner/path/path.hpp"
#include "planner/world/world.hpp"

/// A slow second opinion on timed paths. It looks at many samples of the path instead of at the whole of it,
/// and shares no code with the world, path and certifier that it judges: own interpolation, own distances,
/// own terrain. It reads their plain data only.
namespace swallowtail::test {

using planner::Obstacle;
using planner::Shape;
using planner::TimedPath;
using planner::VehicleLimits;
using planner::World;

/// Distance from x, relative to the obstacle's position, to the shape; 0 inside.
double point_distance_m(const Shape& shape, const Vec3& x);

/// Elevation of the ground by the definition in terrain.hpp.
double ground_m(const World& world, double x_m, double y_m);

/// By how much each rule is broken at worst; negative: kept by so much. What it finds broken is broken; what
/// it finds kept may be broken between samples by up to the resolution.
struct Opinion {
  double bounds_excess_m = -std::numeric_limits<double>::infinity();
  double obstacle_excess_m = -std::numeric_limits<double>::infinity();
  double obstacle_resolution_m = 0.0;
  double terrain_excess_m =
      -std::numeric_limits<double>::infinity();  ///< clearance − distance in space to the sampled surface
  double terrain_height_m =
      std::numeric_limits<double>::infinity();  ///< least height above ground where the rule holds
  double below_ground_m = -std::numeric_limits<double>::infinity();  ///< depth of take-off and landing
  double turn_excess_rad = -std::numeric_limits<double>::infinity();
  double climb_excess_rad = -std::numeric_limits<double>::infinity();
  double speed_excess = -std::numeric_limits<double>::infinity();  ///< relative to the limit
};

struct OracleSteps {
  double path_m = 0.1;    ///< along the path, and of any obstacle's motion
  double ground_m = 0.5;  ///< between samples of the surface
};

/// The path must be well formed.
Opinion inspect(const TimedPath& path, const World& world, const VehicleLimits& limits,
                const OracleSteps& steps = {});

}  // namespace swallowtail::test
