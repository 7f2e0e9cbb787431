#pragma once

#include <memory>

#include "planner/cost/objective.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// Nearness to obstacles beyond what must be kept: the sum over hops and obstacles of max(0, S − s)/S, where
/// s is the hop's distance to the obstacle less the distance to keep from it. Grows on through contact.
class ClearanceShortfall final : public Objective {
 public:
  ClearanceShortfall(std::shared_ptr<const CostScene> scene, double danger_distance_m)
      : scene_(std::move(scene)), danger_distance_m_(danger_distance_m) {}
  const char* name() const override { return "clearance"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  std::shared_ptr<const CostScene> scene_;
  double danger_distance_m_;
};

}  // namespace swallowtail::planner
