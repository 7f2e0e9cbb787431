#pragma once

#include <memory>
#include <vector>

#include "planner/base/stop.hpp"
#include "planner/base/vec.hpp"
#include "planner/path/path.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::planner {

/// The way to a goal as a whole, found once: what the replanner repairs stretch by stretch in flight.
class GoalWay {
 public:
  /// Searches from a position at a mission time; what was found before stays where nothing certified is
  /// found and the goal is the same.
  void search(const std::shared_ptr<const World>& world, const VehicleLimits& limits, const Vec3& from_m,
              double time_s, const Vec3& goal_m, std::uint64_t seed, const StopCondition& stop);

  bool leads_to(const Vec3& goal_m) const { return !points_.empty() && points_.back() == goal_m; }

  /// Its corners that lie ahead of a position near it, the goal not included.
  std::vector<Vec3> corners_ahead(const Vec3& position_m) const;

 private:
  std::vector<Vec3> points_;  ///< start and goal included; empty: none
};

}  // namespace swallowtail::planner
