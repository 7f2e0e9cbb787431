#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"
#include "planner/path/path.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::bench {

/// A path to be found. The climb limit is opened (90°) and the turn limit too, for everybody alike: peers
/// know neither, and a path's length is then that of its polyline.
struct PlanCase {
  std::string name;
  std::shared_ptr<const planner::World> world;
  Vec3 start_m = Vec3::Zero();
  Vec3 goal_m = Vec3::Zero();
  planner::VehicleLimits limits;
  int waypoints = 6;  ///< midpoints of whoever needs their number beforehand

  double distance_m() const { return (goal_m - start_m).norm(); }
};

/// Of a scenario file; named by the file's stem. Errors: all that is wrong with the file, or no goal.
Result<PlanCase> load_case(const std::string& path);

/// Names of the cases that `bench plan` runs by itself: the scene files of `folder`/plan in order, then
/// "big_world".
std::vector<std::string> default_cases(const std::string& folder);
/// A name of default_cases, or the path of a scenario file.
Result<PlanCase> case_by_name(const std::string& name, const std::string& folder);

}  // namespace swallowtail::bench
