#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "planner/kernels/batch_field.hpp"
#include "planner/kernels/obstacle_field.hpp"
#include "tools/bench/plan/bench_case.hpp"

namespace swallowtail::bench {

/// The world as every planner on the bench sees it: one validity check of whole segments, exact, nothing
/// sampled, from the kernels that ours use. One for each run; not for several threads at once.
class Judge {
 public:
  explicit Judge(const PlanCase& plan_case);
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  const PlanCase& plan_case() const { return case_; }
  bool free(const Vec3& a, const Vec3& b) const;
  bool free(std::span<const Vec3> polyline) const;

  struct Penalised {
    double length_m = 0.0;
    double violation_m = 0.0;
  };
  /// Length, and depth by which hops come too near to obstacles and ground, summed: what the preset "default"
  /// of planner/cost sees. Eight hops at a time. `polyline` of at least two points.
  Penalised penalised(std::span<const Vec3> polyline) const;

 private:
  const PlanCase& case_;
  planner::ObstacleField field_;
  planner::BatchField batch_;
};

double length_of(std::span<const Vec3> polyline);

/// What the certifier says of a polyline from start to goal: empty, or why it is refused. It stands apart
/// from the kernels: other geometry, other code.
std::string refusal_of(const PlanCase& plan_case, std::span<const Vec3> polyline);

}  // namespace swallowtail::bench
