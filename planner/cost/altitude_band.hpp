#pragma once

#include <memory>

#include "planner/cost/nmopso_cost.hpp"
#include "planner/cost/objective.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// How far the waypoints' heights above ground are from the middle of a band, in half widths of the band, on
/// average [NMOPSO F3]: 0 in the middle, 1 at its edges. Departs from the source, which is infinite outside
/// the band: beyond an edge each half width counts kBeyondLimit times, so that a search finds its way back.
class AltitudeBand final : public Objective {
 public:
  AltitudeBand(std::shared_ptr<const CostScene> scene, const char* name, double min_m, double max_m)
      : scene_(std::move(scene)), name_(name), min_m_(min_m), max_m_(max_m) {}
  const char* name() const override { return name_; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  std::shared_ptr<const CostScene> scene_;
  const char* name_;  ///< "altitude", or "F3" in the preset NMOPSO
  double min_m_;
  double max_m_;
};

}  // namespace swallowtail::planner
