#pragma once

#include <memory>

#include "planner/cost/objective.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// Hard feasibility [PSO Eq. 7], of whole segments and not, as in the document, of the waypoints alone: 0 for
/// a path that touches nothing; else at least 1, growing with the depth of the contacts and the length below
/// ground in shares of start–goal, so that a search finds its way out. With a weight greater than the cost of
/// any path (PathProblem: the longest path in the box), whatever is free beats whatever is not.
class Contact final : public Objective {
 public:
  explicit Contact(std::shared_ptr<const CostScene> scene) : scene_(std::move(scene)) {}
  const char* name() const override { return "contact"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  std::shared_ptr<const CostScene> scene_;
};

}  // namespace swallowtail::planner
