#pragma once

#include <memory>

#include "planner/cost/objective.hpp"
#include "planner/cost/scene.hpp"

namespace swallowtail::planner {

/// f3 = Σ (s_i + s_j) · mean(‖a‖, ‖b‖) over the waypoints, lengths in shares of start–goal [IBABC Eq. 4]. s_i
/// = max(0, z − h_max)/h_max: flying above the scene's highest point, heights counted from the lowest ground;
/// s_j = max(0, d_safe − d_obs)/d_safe: nearer than d_safe to the nearest obstacle's ball. A reconstruction:
/// the formula was an image; low confidence.
class Concealment final : public Objective {
 public:
  Concealment(std::shared_ptr<const CostScene> scene, double safe_distance_m)
      : scene_(std::move(scene)), safe_distance_m_(safe_distance_m) {}
  const char* name() const override { return "concealment"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  std::shared_ptr<const CostScene> scene_;
  double safe_distance_m_;
};

}  // namespace swallowtail::planner
