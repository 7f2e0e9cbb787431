#pragma once

#include "planner/cost/objective.hpp"

namespace swallowtail::planner {

/// Hops beyond the operating range OP [BOA Eq. 11]: e = Σ 1 + (d − OP) over the hops with d > OP, in metres.
/// Printed with 1 − (d − OP), which would reward them.
class RangePenalty final : public Objective {
 public:
  explicit RangePenalty(double operating_range_m) : operating_range_m_(operating_range_m) {}
  const char* name() const override { return "range"; }
  void evaluate(const PathBatch& paths, Lanes& values) const override;

 private:
  double operating_range_m_;
};

}  // namespace swallowtail::planner
