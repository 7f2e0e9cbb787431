#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/bench/core/row.hpp"
#include "tools/bench/core/table.hpp"
#include "tools/bench/plan/run.hpp"

namespace swallowtail::bench {

/// A scene moved as a whole: about the vertical by `turn_rad`, then by `scale`, then by `shift_m`.
struct Placement {
  std::string name;
  double turn_rad = 0.0;
  double scale = 1.0;
  Vec3 shift_m = Vec3::Zero();
  Vec3 operator()(const Vec3& p) const;
};

/// Twelve spheres, cylinders and boxes between two points, far from any bounds, and far above level ground.
PlanCase free_standing_case(std::uint64_t seed);
/// The case as `placement` moves it; sizes, speeds and clearances scale too.
PlanCase placed(const PlanCase& plan_case, const Placement& placement);

struct Invariance {
  std::vector<Row> rows;
  Table table;
  bool all_hold = true;
};
/// For each subject: lengths divided by the scale, over `runs` seeds in the scene as it is and over as many
/// other seeds in each placement, compared by Mann–Whitney's and by Kolmogorov and Smirnov's test (raised by
/// Holm's method over all tests; lengths rounded to 1e-6 of start–goal, so that rounding does not count). And
/// for a scale that is a power of two, seed by seed: whether the path is the very same. Runs end after
/// `evaluations` and never by time.
Invariance measure_invariance(const std::vector<Subject>& subjects, const Schedule& schedule,
                              cli::Progress& progress);

}  // namespace swallowtail::bench
