#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "tools/bench/core/report.hpp"
#include "tools/bench/core/row.hpp"
#include "tools/bench/plan/bench_case.hpp"
#include "tools/bench/seeds/experiment.hpp"
#include "tools/cli/progress.hpp"

namespace swallowtail::bench {

struct SeedsSchedule {
  std::uint64_t first_seed = 1;
  int runs = 30;
  int tuning_runs = 5;  ///< seeds of each setting that the greedy search looks at; others than those measured
  int iterations_most = 0;  ///< 0: as the document says
  SettingRange range;
};

/// Rows of cost, length, settled (iterations), evaluations and cpu of every algorithm over the seeds, with
/// the document's setting; for "boa_3d" also as "NAME, random" and "NAME, tuned" ([BOA Algorithm 5]; rows of
/// the metrics population, waypoints and iterations say what was found). A figure of the convergence by
/// iteration is added to `report`. Ends early when interrupted.
Result<std::vector<Row>> run_experiment(const Experiment& experiment, const PlanCase& scene,
                                        const SeedsSchedule& schedule, cli::Progress& progress,
                                        Report& report);

/// One line for each algorithm.
Table summary_of(const Experiment& experiment, const std::vector<Row>& rows);

}  // namespace swallowtail::bench
