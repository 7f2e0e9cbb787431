#pragma once

#include <memory>

#include "planner/cost/objective.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// Cl^w1 of [BOA Eq. 15, 16]: Cl = Ci + Co, the count and depth of contacts with obstacles
/// (ball_collision.hpp) and the length below ground (terrain_collision.hpp), metres.
class Collision final : public Objective {
 public:
  Collision(std::shared_ptr<const CostScene> scene, double power) : scene_(std::move(scene)), power_(power) {}
  const char* name() const override { return "collision"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  std::shared_ptr<const CostScene> scene_;
  double power_;
};

}  // namespace swallowtail::planner
