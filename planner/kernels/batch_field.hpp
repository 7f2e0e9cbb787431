#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "planner/kernels/detail/ground_view.hpp"
#include "planner/kernels/lanes.hpp"
#include "planner/kernels/obstacle_field.hpp"

namespace swallowtail::planner {

/// How near each lane's hop comes to one obstacle; negative: so deep inside.
struct LaneDistance {
  std::size_t obstacle = 0;  ///< index in the ObstacleField
  Lanes signed_distance_m;
};

/// What an ObstacleField says, for kLanes hops a → b at once: one straight hop in each lane. Looks at the
/// obstacles that stand for ever; those that move or end stay with the field's own queries (`timed`). No
/// query takes memory, and every machine gives the same bits: lanes are reckoned one by one in the same
/// order, whatever the width of the registers.
///
/// Distances agree with the true ones to 1e-9 of (hop length + obstacle size), for meshes with those of the
/// field's half-spaces. Const calls may run in several threads. A coordinate that is not finite gives a
/// result that is not a number or 0: the caller sees to it.
class BatchField {
 public:
  /// Borrows the field, which must not change its place or its slope share while this lives.
  explicit BatchField(const ObstacleField& field);

  const ObstacleField& field() const { return *field_; }
  /// Indexes (in the field) of the obstacles that are left out here: they move, or end.
  std::span<const std::size_t> timed() const { return timed_; }

  /// Adds the length of each hop.
  static void add_length(const LanePoint& a, const LanePoint& b, Lanes& sum_m);
  /// Adds, for every obstacle, the depth by which the hop breaks the distance to it
  /// (ObstacleField::violation_m), in the order of the field's indexes.
  void add_violation(const LanePoint& a, const LanePoint& b, Lanes& sum_m) const;
  /// Signed distances to the obstacles that some lane comes nearer to than `cap_m` (those beyond may be among
  /// them), in the order of the field's indexes. The answer lies in `buffer`, which grows to the number of
  /// obstacles once.
  std::span<const LaneDistance> distances(const LanePoint& a, const LanePoint& b, double cap_m,
                                          std::vector<LaneDistance>& buffer) const;
  /// Level distance of each hop from the vertical through the obstacle's position [NMOPSO F2].
  Lanes axis_distance_m(std::size_t obstacle, const LanePoint& a, const LanePoint& b) const;

  /// Adds the depth by which the hop breaks the height above ground (ObstacleField::terrain_violation_m).
  void add_terrain_violation(const LanePoint& a, const LanePoint& b, Lanes& sum_m) const;
  /// Adds the length of the hop that lies at or below the ground, exact [BOA Eq. 14].
  void add_length_below_ground(const LanePoint& a, const LanePoint& b, Lanes& sum_m) const;

 private:
  const ObstacleField* field_;
  std::optional<detail::GroundView> ground_;  ///< none over a plane
  std::vector<std::size_t> timed_;
};

}  // namespace swallowtail::planner
