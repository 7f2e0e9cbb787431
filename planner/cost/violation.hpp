#pragma once

#include <memory>

#include "planner/cost/objective.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// Depths of all contacts with obstacles and, per segment, of the greatest breach of the height above ground,
/// summed, in shares of start–goal. Linear, so that a weight that is large enough makes the optimum free of
/// violations.
class Violation final : public Objective {
 public:
  explicit Violation(std::shared_ptr<const CostScene> scene) : scene_(std::move(scene)) {}
  const char* name() const override { return "violation"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  std::shared_ptr<const CostScene> scene_;
};

}  // namespace swallowtail::planner
