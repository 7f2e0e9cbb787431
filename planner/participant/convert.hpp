#pragma once

#include <vector>

#include "idl/data/types.hpp"
#include "planner/base/vec.hpp"
#include "planner/path/path.hpp"
#include "planner/replan/replanner.hpp"
#include "planner/world/obstacle.hpp"

namespace swallowtail::planner {

/// From and to the wire's values; the samples have passed data::validate.
Vec3 to_vec(const data::Vec3& v);
data::Vec3 to_data(const Vec3& v);
VehicleLimits to_limits(const data::VehicleLimits& limits);
Obstacle to_obstacle(const data::Obstacle& obstacle);
TimedPath to_path(const std::vector<data::TimedWaypoint>& waypoints);
std::vector<data::TimedWaypoint> to_data(const TimedPath& path);
data::PathVerdict to_data(Verdict verdict);

}  // namespace swallowtail::planner
