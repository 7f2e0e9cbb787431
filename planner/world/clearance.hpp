#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "planner/world/world.hpp"

namespace swallowtail::planner {

/// Answer of a clearance query. Distances are from the path's centre line to an obstacle's surface, metres;
/// 0: they touch or overlap (depth is not measured). The vehicle's radius and margin are not subtracted.
///
/// | field         | of which obstacle       | meaning | | ------------- | ----------------------- |
/// ---------------------------------------------------------------------------- | | `distance_m`  | the
/// nearest             | least distance; infinite: nothing within reach                               | |
/// `slack_m`     | the one with least slack | least (distance − that obstacle's own margin + its relief):
/// what a vehicle has to live on | | `obstacle_id` | the one with least slack | 0 where nothing is within
/// reach | | `time_s` | the one with least slack | when it is nearest |
///
/// Quality: a lower bound, below the true distance by less than 1e-6·(1 + distance); never above it.
struct Clearance {
  double distance_m = std::numeric_limits<double>::infinity();
  double slack_m = std::numeric_limits<double>::infinity();
  std::uint32_t obstacle_id = 0;
  double time_s = 0.0;
};

/// Distances between a point that flies straight and every obstacle of a World, moving ones included: in the
/// obstacle's own frame the flight is a segment again. Nothing is sampled. Standing obstacles wait in a tree
/// of boxes, moving ones in a list that is asked with their relative flight. Spheres are measured in closed
/// form; for all else FCL's GJK does the narrow phase; its answer is trusted for the direction only, the
/// distance is that of the supporting plane across that direction, which cannot exceed the true one. One
/// query per thread (it makes FCL's shapes when first asked for them); it shares the World.
class ClearanceQuery {
 public:
  explicit ClearanceQuery(std::shared_ptr<const World> world);
  ~ClearanceQuery();
  ClearanceQuery(ClearanceQuery&&) noexcept;
  ClearanceQuery& operator=(ClearanceQuery&&) noexcept;

  /// Of the flight from a at t0_s to b at t1_s (t1_s ≥ t0_s); a number that is not finite gives distance 0
  /// and the least slack there is. Obstacles whose slack is beyond `reach_m` may be left out; one whose
  /// valid_until_s is before t0_s is gone, one that ends within the interval counts until then.
  Clearance of_flight(const Vec3& a, double t0_s, const Vec3& b, double t1_s, double reach_m = 50.0) const;

  const World& world() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace swallowtail::planner
