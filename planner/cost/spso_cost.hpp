#pragma once

#include <memory>

#include "planner/cost/objective.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// The cost of SPSO's public code [SPSO], 5·length + 1·threat + 10·altitude + 1·smoothness, term by term,
/// with its own sampling: the ground is looked at below the waypoints only, at the nearest raster sample. Its
/// lengths are grid cells across and metres up; a scene of the public code (scenario/public_scene.hpp) has
/// cells of one metre. Departs where the source is infinite (a threat touched, a waypoint below ground):
/// kSpsoInfeasible and more, so that a search finds its way out; more than any path that touches nothing
/// costs.
inline constexpr double kSpsoInfeasible = 1e5;

/// J2: Σ over threats and segments of how far the segment is within the danger zone, level: with R the
/// threat's radius, D the vehicle's clearance and S = 10·D, 0 beyond R + D + S, else R + D + S − distance.
/// Every obstacle counts as an upright cylinder without end.
class SpsoThreat final : public Objective {
 public:
  explicit SpsoThreat(std::shared_ptr<const CostScene> scene) : scene_(std::move(scene)) {}
  const char* name() const override { return "threat"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  std::shared_ptr<const CostScene> scene_;
};

/// J3: Σ over waypoints of |height above ground − middle of the band|.
class SpsoAltitude final : public Objective {
 public:
  SpsoAltitude(std::shared_ptr<const CostScene> scene, double middle_m)
      : scene_(std::move(scene)), middle_m_(middle_m) {}
  const char* name() const override { return "altitude"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  std::shared_ptr<const CostScene> scene_;
  double middle_m_;
};

/// J4: Σ over corners of the level turn and of the change of climb angle, degrees, where they are above 45. A
/// segment without level extent takes its direction from the nearest one that has some: before it for the
/// first of a corner, after it for the second.
class SpsoSmoothness final : public Objective {
 public:
  const char* name() const override { return "smoothness"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;
};

}  // namespace swallowtail::planner
