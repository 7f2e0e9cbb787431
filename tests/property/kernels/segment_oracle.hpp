#pragma once

#include "planner/base/vec.hpp"
#include "planner/world/obstacle.hpp"

namespace swallowtail::test {

/// Signed distance from x, relative to the obstacle's position, to a sphere, cylinder, cone or box: outside
/// the oracle's, inside the depth under the nearest face, negative.
double signed_point_distance_m(const planner::Shape& shape, const Vec3& x);

/// The least of it over the straight segment p–q, by ternary search with no use of slopes: the distance to a
/// convex solid is convex along a line.
double signed_segment_distance_m(const planner::Shape& shape, const Vec3& p, const Vec3& q);

}  // namespace swallowtail::test
