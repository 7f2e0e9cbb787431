#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "planner/world/world.hpp"

namespace swallowtail::planner {

/// Answer of a clearance query. Distances are from the path's centre line to the surface of the nearest obstacle, metres; 0 or less: they touch or overlap (depth is not measured).
/// The vehicle's radius and all margins are not subtracted, except that `slack_m` is distance − that obstacle's own margin.
struct Clearance {
  double distance_m = std::numeric_limits<double>::infinity();
  double slack_m = std::numeric_limits<double>::infinity();
  std::uint32_t obstacle_id = 0;  ///< 0: nothing within reach
};

/// Exact distances between a point that flies straight and every obstacle of a World, moving ones included: in the obstacle's own frame the flight is a segment again. FCL does the narrow phase.
/// One per thread; it borrows the World.
class ClearanceQuery {
 public:
  explicit ClearanceQuery(std::shared_ptr<const World> world);
  ~ClearanceQuery();
  ClearanceQuery(ClearanceQuery&&) noexcept;
  ClearanceQuery& operator=(ClearanceQuery&&) noexcept;

  /// Of the flight from a at t0_s to b at t1_s (t1_s ≥ t0_s). Obstacles beyond `reach_m` may be left out; one whose valid_until_s is before t0_s is gone, one that ends within the interval counts until then.
  Clearance of_flight(const Vec3& a, double t0_s, const Vec3& b, double t1_s, double reach_m = 50.0) const;

  const World& world() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swallowtail::planner
