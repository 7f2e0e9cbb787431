#include "tools/bench/plan/run.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

#include <fmt/core.h>

#include "tools/bench/core/memory.hpp"
#include "tools/bench/core/statistics.hpp"
#include "tools/bench/plan/judge.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
struct Gap {
  const char* metric;
  double share;
};
constexpr std::array kGaps{Gap{"time_to_5_percent", 0.05}, Gap{"time_to_1_percent", 0.01},
                           Gap{"time_to_0.1_percent", 0.001}};

Outcome run_one(const PlanCase& plan_case, const Subject& subject, std::uint64_t seed,
                const Schedule& schedule) {
  Outcome outcome;
  outcome.seed = seed;
  const PeakMemory memory;
  outcome.run = subject.run(plan_case, seed, schedule.limit);
  outcome.memory_mb = schedule.threads == 1 ? memory.taken_mb() : std::numeric_limits<double>::quiet_NaN();
  if (!outcome.run.path_m.empty()) outcome.refusal = refusal_of(plan_case, outcome.run.path_m);
  if (!outcome.certified()) outcome.run.curve.clear();
  return outcome;
}

std::string gap_text(double length_m, double best_known_m) {
  if (!std::isfinite(length_m)) return "none";
  return fmt::format("{:.3f}", 100.0 * (length_m / best_known_m - 1.0));
}

}  // namespace

double Outcome::length_m() const { return certified() ? length_of(run.path_m) : kNever; }

std::vector<Outcome> run_case(const PlanCase& plan_case, const std::vector<Subject>& subjects,
                              const Schedule& schedule, cli::Progress& progress) {
  const auto runs = static_cast<std::size_t>(schedule.runs);
  std::vector<std::optional<Outcome>> slots(subjects.size() * runs);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < slots.size() && !cli::interrupted(); i = next++) {
      const std::size_t subject = i / runs;
      progress.update(
          fmt::format("{}, {}, run {} of {}", plan_case.name, subjects[subject].name, i % runs + 1, runs));
      slots[i] = run_one(plan_case, subjects[subject], schedule.first_seed + i % runs, schedule);
      slots[i]->subject = subject;
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < schedule.threads; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  std::vector<Outcome> outcomes;
  for (auto& slot : slots) {
    if (slot) outcomes.push_back(std::move(*slot));
  }
  return outcomes;
}

double shortest_m(const std::vector<Outcome>& outcomes) {
  double least_m = kNever;
  for (const Outcome& outcome : outcomes) least_m = std::min(least_m, outcome.length_m());
  return least_m;
}

std::vector<Row> rows_of(const PlanCase& plan_case, const std::vector<Subject>& subjects,
                         const std::vector<Outcome>& outcomes, double best_known_m) {
  std::vector<Row> rows;
  for (const Outcome& outcome : outcomes) {
    const auto add = [&](const char* metric, double value, const char* unit) {
      rows.push_back({subjects[outcome.subject].name, plan_case.name, outcome.seed, metric, value, unit});
    };
    const PlanRun& run = outcome.run;
    add("certified", outcome.certified() ? 1.0 : 0.0, "");
    add("length", outcome.length_m(), "m");
    add("first_feasible", run.curve.empty() ? kNever : run.curve.front().cpu_ms, "ms");
    for (const Gap& gap : kGaps)
      add(gap.metric, effort_to(run.curve, Effort::kTime_ms, target_of(best_known_m, gap.share)), "ms");
    add("cpu", run.cpu_ms, "ms");
    add("evaluations", static_cast<double>(run.evaluations), "");
    add("evaluations_per_second",
        run.cpu_ms > 0.0 ? 1e3 * static_cast<double>(run.evaluations) / run.cpu_ms : 0.0, "1/s");
    if (std::isfinite(outcome.memory_mb)) add("memory", outcome.memory_mb, "MiB");
  }
  return rows;
}

Table table_of(const PlanCase& plan_case, const std::vector<Subject>& subjects, const std::vector<Row>& rows,
               double best_known_m) {
  Table table;
  table.title = fmt::format("{}: best known {:.6f} m, straight line {:.3f} m, {} obstacles", plan_case.name,
                            best_known_m, plan_case.distance_m(), plan_case.world->obstacles().size());
  table.columns = {"subject", "certified", "gap % median", "quartiles",     "worst", "first ms",
                   "5 % ms",  "1 % ms",    "0.1 % ms",     "evaluations/s", "MiB"};
  for (const Subject& subject : subjects) {
    const auto values = [&](const std::string& metric) {
      return values_of(rows, subject.name, plan_case.name, metric);
    };
    const std::vector<double> certified = values("certified");
    if (certified.empty()) continue;
    const Quartiles length = quartiles_of(values("length"));
    const auto median = [&](const std::string& metric) { return significant(median_of(values(metric)), 3); };
    table.rows.push_back(
        {subject.name, fmt::format("{} of {}", std::ranges::count(certified, 1.0), certified.size()),
         gap_text(length.median, best_known_m),
         gap_text(length.lower, best_known_m) + " … " + gap_text(length.upper, best_known_m),
         gap_text(length.max, best_known_m), median("first_feasible"), median("time_to_5_percent"),
         median("time_to_1_percent"), median("time_to_0.1_percent"), median("evaluations_per_second"),
         values("memory").empty() ? "–" : fmt::format("{:.1f}", median_of(values("memory")))});
  }
  return table;
}

}  // namespace swallowtail::bench
