#include "tools/bench/seeds/run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "tools/bench/core/statistics.hpp"
#include "tools/bench/plot/chart.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

constexpr std::uint64_t kTuningSeeds = 2'000'000;
constexpr std::uint64_t kSettingSeeds = 3'000'000;
constexpr const char* kTunedExperiment = "boa_3d";
constexpr std::size_t kChartPoints = 80;

class Rows {
 public:
  Rows(std::string experiment, std::vector<Row>& rows) : experiment_(std::move(experiment)), rows_(rows) {}

  void add(const std::string& subject, std::uint64_t seed, const Trial& trial) {
    const auto row = [&](const char* metric, double value, const char* unit) {
      rows_.push_back({subject, experiment_, seed, metric, value, unit});
    };
    row("cost", trial.cost, "");
    row("length", trial.length_m, "m");
    row("settled", static_cast<double>(trial.settled), "iterations");
    row("first_cost", trial.first_cost, "");
    row("evaluations", static_cast<double>(trial.evaluations), "");
    row("cpu", trial.cpu_ms, "ms");
  }
  void add(const std::string& subject, const Setting& setting) {
    rows_.push_back({subject, experiment_, 0, "population", static_cast<double>(setting.population), ""});
    rows_.push_back({subject, experiment_, 0, "waypoints", static_cast<double>(setting.waypoints), ""});
    rows_.push_back({subject, experiment_, 0, "iterations", static_cast<double>(setting.iterations), ""});
  }

 private:
  std::string experiment_;
  std::vector<Row>& rows_;
};

struct Context {
  const Experiment& experiment;
  const PlanCase& scene;
  const SeedsSchedule& schedule;
  cli::Progress& progress;
};

/// Every seed with the setting that `setting_of` gives for it.
template <class SettingOf>
Status run_seeds(const Context& c, const std::string& algorithm, const std::string& subject,
                 const SettingOf& setting_of, Rows& rows, std::vector<Curve>* curves) {
  for (int run = 0; run < c.schedule.runs && !cli::interrupted(); ++run) {
    const std::uint64_t seed = c.schedule.first_seed + static_cast<std::uint64_t>(run);
    c.progress.update(
        fmt::format("{}, {}, run {} of {}", c.experiment.name, subject, run + 1, c.schedule.runs));
    auto trial = run_trial(c.scene, c.experiment.preset, algorithm, setting_of(seed), seed);
    if (!trial) return trial.error();
    rows.add(subject, seed, *trial);
    if (curves != nullptr) curves->push_back(std::move(trial->curve));
  }
  return {};
}

Status run_tuned(const Context& c, const std::string& algorithm, Rows& rows) {
  const SettingRange& range = c.schedule.range;
  const auto random = [&range](std::uint64_t seed) {
    Rng rng(kSettingSeeds + seed);
    return random_setting(range, rng);
  };
  if (const Status status = run_seeds(c, algorithm, algorithm + ", random", random, rows, nullptr); !status)
    return status;
  c.progress.update(fmt::format("{}, tuning {}", c.experiment.name, algorithm));
  const auto tuned = greedy_setting(c.scene, c.experiment.preset, algorithm, range,
                                    kTuningSeeds + c.schedule.first_seed, c.schedule.tuning_runs);
  if (!tuned) return tuned.error();
  const std::string subject = algorithm + ", tuned";
  rows.add(subject, *tuned);
  return run_seeds(
      c, algorithm, subject, [&tuned](std::uint64_t) { return *tuned; }, rows, nullptr);
}

}  // namespace

Result<std::vector<Row>> run_experiment(const Experiment& experiment, const PlanCase& scene,
                                        const SeedsSchedule& schedule, cli::Progress& progress,
                                        Report& report) {
  std::vector<Row> out;
  Rows rows(experiment.name, out);
  const Context context{experiment, scene, schedule, progress};
  Setting setting{experiment.population, scene.waypoints, experiment.iterations};
  if (schedule.iterations_most > 0)
    setting.iterations = std::min(setting.iterations, schedule.iterations_most);
  Chart chart{experiment.name + ": cost by iteration", "iterations", "cost", Scale::kLinear, Scale::kLog, {}};
  for (const std::string& algorithm : experiment.algorithms) {
    std::vector<Curve> curves;
    const auto as_printed = [&setting](std::uint64_t) { return setting; };
    if (const Status status = run_seeds(context, algorithm, algorithm, as_printed, rows, &curves); !status)
      return status.error();
    const Band band = band_of(curves, Effort::kIterations, kChartPoints);
    Series series{algorithm, {}, {}, {}, false};
    for (std::size_t i = 0; i < band.effort.size(); ++i) {
      series.points.emplace_back(band.effort[i], band.median[i]);
      series.lower.emplace_back(band.effort[i], band.lower[i]);
      series.upper.emplace_back(band.effort[i], band.upper[i]);
    }
    chart.series.push_back(std::move(series));
    if (experiment.name != kTunedExperiment || !algorithm.ends_with("-seed")) continue;
    if (const Status status = run_tuned(context, algorithm, rows); !status) return status.error();
  }
  report.figures.push_back({chart.title + ": median and quartiles over the seeds", draw(chart)});
  return out;
}

Table summary_of(const Experiment& experiment, const std::vector<Row>& rows) {
  Table table;
  table.title = fmt::format("{}: population {}, {} iterations, cost {}", experiment.name,
                            experiment.population, experiment.iterations, experiment.preset);
  table.columns = {"algorithm", "cost median",          "quartiles",   "best",  "worst", "median length",
                   "flyable",   "settled at iteration", "evaluations", "CPU ms"};
  std::vector<std::string> subjects;
  for (const Row& row : rows) {
    if (std::ranges::find(subjects, row.subject) == subjects.end()) subjects.push_back(row.subject);
  }
  for (const std::string& subject : subjects) {
    const auto values = [&](const char* metric) { return values_of(rows, subject, experiment.name, metric); };
    const Quartiles cost = quartiles_of(values("cost"));
    const std::vector<double> lengths = values("length");
    const auto flyable = std::ranges::count_if(lengths, [](double v) { return std::isfinite(v); });
    table.rows.push_back(
        {subject, significant(cost.median, 5),
         significant(cost.lower, 5) + " … " + significant(cost.upper, 5), significant(cost.min, 5),
         significant(cost.max, 5), significant(median_of(lengths), 5),
         fmt::format("{} of {}", flyable, lengths.size()), significant(median_of(values("settled")), 3),
         significant(median_of(values("evaluations")), 6), significant(median_of(values("cpu")), 3)});
  }
  return table;
}

}  // namespace swallowtail::bench
