#pragma once

#include "planner/cost/objective.hpp"

namespace swallowtail::planner {

/// Length of the path in a unit [BOA Eq. 9, 10], [PSO Eq. 5, 6], [IBABC Eq. 2].
class Length final : public Objective {
 public:
  explicit Length(double unit_m) : unit_m_(unit_m) {}
  const char* name() const override { return "length"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  double unit_m_;
};

}  // namespace swallowtail::planner
