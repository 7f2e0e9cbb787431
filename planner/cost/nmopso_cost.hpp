#pragma once

#include <memory>

#include "planner/cost/objective.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// What the source makes infinite grows here by this much per unit of excess, so that a search of the
/// weighted sum finds its way back.
inline constexpr double kBeyondLimit = 10.0;

/// F1 = 1 − ‖P_1 P_n‖ / Σ ‖P_j P_{j+1}‖ [NMOPSO F1]; the shortest segment is seen to by the repair instead.
class NmopsoLength final : public Objective {
 public:
  const char* name() const override { return "F1"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;
};

/// F2 = mean over segments and threats of 0 | 1 − (d_k − D − R_k)/S | infinite [NMOPSO F2]: d_k the level
/// distance of the segment from the threat's axis, D the vehicle's clearance, S the danger distance. Every
/// obstacle counts as an upright cylinder without end. Departs: inside, 1 + kBeyondLimit · depth/S.
class NmopsoThreat final : public Objective {
 public:
  NmopsoThreat(std::shared_ptr<const CostScene> scene, double danger_distance_m)
      : scene_(std::move(scene)), danger_distance_m_(danger_distance_m) {}
  const char* name() const override { return "F2"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  std::shared_ptr<const CostScene> scene_;
  double danger_distance_m_;
};

/// F4 = mean |η| / π, η the angle between consecutive segments [NMOPSO F4].
class NmopsoTurn final : public Objective {
 public:
  const char* name() const override { return "F4"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;
};

/// Level distances of a hop from a point.
void level_distances(const LanePoint& from, const PathBatch::Hop& hop, const Vec2& point_m,
                     Lanes& distance_m);

}  // namespace swallowtail::planner
