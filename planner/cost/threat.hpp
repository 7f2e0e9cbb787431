#pragma once

#include <memory>

#include "planner/cost/objective.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// f4 = Σ over waypoints and balls of max(0, (r_t − w_t)/r_t), w_t the distance of the waypoint to the centre
/// of ball t [IBABC Eq. 5]. A reconstruction: the formula was an image; medium confidence. Every obstacle
/// counts as the ball around it.
class Threat final : public Objective {
 public:
  explicit Threat(std::shared_ptr<const CostScene> scene) : scene_(std::move(scene)) {}
  const char* name() const override { return "threat"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  std::shared_ptr<const CostScene> scene_;
};

}  // namespace swallowtail::planner
