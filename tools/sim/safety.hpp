#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coverage/field/polygon.hpp"
#include "planner/path/path.hpp"
#include "planner/world/clearance.hpp"
#include "tools/sim/aircraft.hpp"

namespace swallowtail::sim {

/// Watches the true flight against the true world, every step, continuously within the step.
/// - violation: nearer to an obstacle than radius + margin + its own margin, or less than radius + margin
/// above the ground outside take-off and landing;
/// - violation too: in the air inside a no-fly area;
/// - collision: nearer to an obstacle than the radius, or below the ground.
/// One episode counts once, however long it lasts. On the ground nothing counts.
class Safety {
 public:
  Safety(const planner::VehicleLimits& limits, std::shared_ptr<const planner::World> world,
         std::vector<coverage::Polygon> no_fly = {});

  void change_world(std::shared_ptr<const planner::World> world);
  /// The flight from one state to the next.
  void observe(const Motion& from, const Motion& to);

  std::uint64_t violations() const { return violations_; }
  std::uint64_t collisions() const { return collisions_; }
  /// Distance to the nearest obstacle or the ground below in the last step; 0 on the ground.
  double clearance_m() const { return clearance_m_; }
  /// Least distance to an obstacle, or to the ground outside take-off and landing, in flight; infinite before
  /// any.
  double least_clearance_m() const { return least_clearance_m_; }
  /// What the first violation was, for people; empty without one.
  const std::string& first_violation() const { return first_violation_; }

 private:
  const planner::VehicleLimits limits_;
  void watch_no_fly(const Motion& to);

  std::optional<planner::ClearanceQuery> query_;
  const std::vector<coverage::Polygon> no_fly_;
  bool was_within_ = false;
  std::uint64_t violations_ = 0;
  std::uint64_t collisions_ = 0;
  bool was_violated_ = false;
  bool was_collided_ = false;
  double clearance_m_ = 0.0;
  double least_clearance_m_ = std::numeric_limits<double>::infinity();
  std::string first_violation_;
};

}  // namespace swallowtail::sim
