#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/bench/core/best_known.hpp"
#include "tools/bench/core/row.hpp"
#include "tools/bench/core/table.hpp"
#include "tools/bench/plan/bench_case.hpp"
#include "tools/bench/plan/subject.hpp"
#include "tools/cli/progress.hpp"

namespace swallowtail::bench {

/// One run, looked at by the certifier. A path that it refuses counts as none: its curve is emptied.
struct Outcome {
  std::size_t subject = 0;  ///< index in the list that ran
  std::uint64_t seed = 0;
  PlanRun run;
  std::string refusal;  ///< why the certifier refused the path; empty: certified, or no path
  double memory_mb = 0.0;
  bool certified() const { return refusal.empty() && !run.path_m.empty(); }
  double length_m() const;  ///< infinite without a certified path
};

struct Schedule {
  std::uint64_t first_seed = 1;
  int runs = 30;
  RunLimit limit;
  int threads = 1;
};

/// Every subject with every seed on one case; ends early when interrupted. Outcomes stand in the order of
/// subjects, then seeds, whatever the number of threads.
std::vector<Outcome> run_case(const PlanCase& plan_case, const std::vector<Subject>& subjects,
                              const Schedule& schedule, cli::Progress& progress);

/// Length of the shortest certified path; infinite: none.
double shortest_m(const std::vector<Outcome>& outcomes);

/// Rows of each run: certified, length, first_feasible, time_to_5/1/0.1_percent of `best_known_m`,
/// evaluations, evaluations_per_second, memory.
std::vector<Row> rows_of(const PlanCase& plan_case, const std::vector<Subject>& subjects,
                         const std::vector<Outcome>& outcomes, double best_known_m);
/// One line for each subject: medians, quartiles and worst over the seeds.
Table table_of(const PlanCase& plan_case, const std::vector<Subject>& subjects, const std::vector<Row>& rows,
               double best_known_m);

}  // namespace swallowtail::bench
