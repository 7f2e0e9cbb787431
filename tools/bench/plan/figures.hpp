#pragma once

#include <vector>

#include "tools/bench/core/report.hpp"
#include "tools/bench/plan/run.hpp"

namespace swallowtail::bench {

/// Convergence by time, evaluations and (who counts them) iterations, and the scene with the best path of the
/// first three subjects that have one.
std::vector<Figure> figures_of(const PlanCase& plan_case, const std::vector<Subject>& subjects,
                               const std::vector<Outcome>& outcomes, double best_known_m);

}  // namespace swallowtail::bench
