#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "planner/base/rng.hpp"
#include "planner/path/path.hpp"
#include "planner/world/world.hpp"

/// Random scenes of the sizes that the bars of the planner are set for; the same seed gives the same scene.
namespace swallowtail::microbench {

/// An aircraft of hardly any size, as the scenes of document PSO have it.
planner::VehicleLimits small_aircraft();

std::vector<planner::Obstacle> random_balls(Rng& rng, int count, const Vec3& lo, const Vec3& hi,
                                            double radius_m);
/// All four round and square shapes.
std::vector<planner::Obstacle> random_shapes(Rng& rng, int count, const Vec3& lo, const Vec3& hi,
                                             double size_m);

/// Balls in the box [0, 11]³ over flat ground.
std::shared_ptr<const planner::World> ball_world(int count);
/// 40 × 40 × 30 with five mountains on a raster and 20 balls above.
std::shared_ptr<const planner::World> mountain_world(double cell_size_m);
/// Hills on samples × samples and obstacles all over them.
planner::TerrainGrid hill_grid(int samples, double cell_size_m);
std::vector<planner::Obstacle> obstacles_on_hills(int count, double side_m);

/// Candidates of k waypoints each, one a column (3k × n).
Eigen::MatrixXd random_candidates(int waypoints, int count, const Vec3& lo, const Vec3& hi);
/// The same about the straight line, by up to spread_m to each side.
Eigen::MatrixXd candidates_about_line(int waypoints, int count, const Vec3& from, const Vec3& to,
                                      double spread_m);

}  // namespace swallowtail::microbench
