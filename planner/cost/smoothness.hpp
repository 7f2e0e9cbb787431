#pragma once

#include "planner/cost/objective.hpp"

namespace swallowtail::planner {

/// Change of direction from one hop to the next, 0 … π; 0 where either has no length.
double turn_rad(const PathBatch::Hop& before, const PathBatch::Hop& after, int lane);

/// f2 = Σ α_i / mean(‖a‖, ‖b‖) over the corners, with a and b the segments before and after, lengths in a
/// unit [IBABC Eq. 3]. A reconstruction: the patent's formula was an image; low confidence.
class Smoothness final : public Objective {
 public:
  explicit Smoothness(double unit_m) : unit_m_(unit_m) {}
  const char* name() const override { return "smoothness"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  double unit_m_;
};

}  // namespace swallowtail::planner
