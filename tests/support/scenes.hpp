#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "planner/base/rng.hpp"
#include "planner/path/path.hpp"
#include "planner/world/world.hpp"

/// Random worlds and paths for tests; all from a passed Rng.
namespace swallowtail::test {

Vec3 random_point(Rng& rng, const Vec3& lo, const Vec3& hi);
/// Sphere, cylinder, cone, box or a mesh of 4 … 9 vertices, about size_m large.
planner::Shape random_shape(Rng& rng, double size_m);
/// One in three moves, one in four ends.
planner::Obstacle random_obstacle(Rng& rng, std::uint32_t id, const Vec3& lo, const Vec3& hi, double size_m);
/// Rough ground: hills and noise on a raster whose south-west sample is at `lo`.
planner::Terrain random_terrain(Rng& rng, const Vec2& lo, int rows, int cols, double cell_size_m,
                                double height_m);
std::vector<planner::RoutePoint> random_route(Rng& rng, std::size_t points, const Vec3& lo, const Vec3& hi);

/// The path as source text, to paste into a test.
std::string as_code(const planner::TimedPath& path);

}  // namespace swallowtail::test
