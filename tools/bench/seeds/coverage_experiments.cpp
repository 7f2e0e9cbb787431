#include "tools/bench/seeds/coverage_experiments.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "tools/bench/core/statistics.hpp"
#include "tools/bench/plot/chart.hpp"
#include "tools/bench/seeds/coverage_cells.hpp"
#include "tools/bench/seeds/coverage_trial.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

using coverage::SubCell;

constexpr double kSensorWidth_m = 10.0;
/// [COV 5.2]: one cell ten times as high as the others, and what flying there takes more for each metre; the
/// document prints no figure for that.
constexpr double kOneHigh_m = 100.0;
constexpr double kAltitude_per_m = 0.002;
constexpr double kHighD_max = 600.0;
constexpr int kLevels = 10;
/// The parent's own figure for run times.
constexpr int kParentsLevels = 4;
constexpr const char* kWith = "with heights";
constexpr const char* kWithout = "without heights";

struct Ground {
  std::string name;
  std::vector<StripLine> strips;
};

Result<std::vector<Ground>> grounds_of(const std::string& data, const std::vector<double>& widths_m,
                                       const std::vector<std::string>& parents, Report& report) {
  std::vector<Ground> grounds;
  for (const double width_m : widths_m) {
    auto strips = strips_of_fields(data + "/seeds/cov_fields.geojson", width_m);
    if (!strips) return strips.error();
    const std::string name = width_m == kSensorWidth_m ? "fields" : fmt::format("fields by {:g} m", width_m);
    grounds.push_back({name, std::move(*strips)});
  }
  for (const std::string& name : parents) {
    const auto file = parents_file(name);
    if (!file) {
      report.notes.push_back("skipped: the parent's strips " + name +
                             ", they are not there (set SWALLOWTAIL_DATA).");
      continue;
    }
    auto strips = read_strips(*file);
    if (!strips) return strips.error();
    grounds.push_back({name, std::move(*strips)});
  }
  return grounds;
}

/// Share of the cells' length that is flown at their own height.
double covered_percent(const std::vector<SubCell>& asked, double flown_height_m) {
  double at_height_m = 0.0;
  double all_m = 0.0;
  for (const SubCell& cell : asked) {
    all_m += cell.length_m();
    if (cell.height_m == flown_height_m) at_height_m += cell.length_m();
  }
  return 100.0 * at_height_m / all_m;
}

class Runs {
 public:
  Runs(std::string experiment, const SeedsSchedule& schedule, cli::Progress& progress)
      : experiment_(std::move(experiment)), schedule_(schedule), progress_(progress) {}

  /// Every seed: `cells_of(seed)` with the setting that `setting_of(cells)` gives.
  template <class CellsOf, class SettingOf>
  void add(const Ground& ground, const std::string& subject, const CellsOf& cells_of,
           const SettingOf& setting_of) {
    for (int run = 0; run < schedule_.runs && !cli::interrupted(); ++run) {
      const std::uint64_t seed = schedule_.first_seed + static_cast<std::uint64_t>(run);
      progress_.update(fmt::format("{}, {}, {}, run {} of {}", experiment_, ground.name, subject, run + 1,
                                   schedule_.runs));
      const std::vector<SubCell> cells = cells_of(seed);
      CoverageSetting setting = setting_of(cells);
      setting.iterations_most = static_cast<std::uint64_t>(schedule_.iterations_most);
      add(ground, subject, seed, run_coverage_trial(cells, setting, seed));
    }
  }
  void add(const Ground& ground, const std::string& subject, std::uint64_t seed, const char* metric,
           double value, const char* unit) {
    rows_.push_back({subject, experiment_ + ", " + ground.name, seed, metric, value, unit});
  }
  std::vector<Row>& rows() { return rows_; }
  const SeedsSchedule& schedule() const { return schedule_; }

 private:
  void add(const Ground& ground, const std::string& subject, std::uint64_t seed, const CoverageTrial& trial) {
    add(ground, subject, seed, "cost", trial.cost, "");
    add(ground, subject, seed, "cpu", trial.cpu_ms, "ms");
    add(ground, subject, seed, "vertices", trial.vertices, "");
    add(ground, subject, seed, "recharges", trial.recharges, "");
    add(ground, subject, seed, "height_changes", trial.height_changes, "");
    add(ground, subject, seed, "scheduled_cost", trial.scheduled_cost, "s");
  }

  std::string experiment_;
  const SeedsSchedule& schedule_;
  cli::Progress& progress_;
  std::vector<Row> rows_;
};

/// Both ways of [COV 5]: the strips at height 0, or with heights drawn.
template <class SettingOf>
void run_both_ways(const Ground& ground, const auto& subject_of, const SettingOf& setting_of, Runs& runs) {
  runs.add(
      ground, subject_of(kWithout), [&](std::uint64_t) { return level_cells(ground.strips, 0.0); },
      setting_of);
  runs.add(
      ground, subject_of(kWith), [&](std::uint64_t seed) { return drawn_cells(ground.strips, seed); },
      setting_of);
}

void run_heights(const Ground& ground, Runs& runs) {
  run_both_ways(
      ground, [](const std::string& heights) { return heights; },
      [](const std::vector<SubCell>&) { return CoverageSetting{}; }, runs);
}

/// One strip, chosen by the seed, whole and at kOneHigh_m.
std::vector<SubCell> with_one_high(const Ground& ground, std::uint64_t seed) {
  std::vector<StripLine> others = ground.strips;
  const std::size_t high = seed % others.size();
  const StripLine strip = others[high];
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(high));
  std::vector<SubCell> cells = drawn_cells(others, seed);
  SubCell cell = level_cells({strip}, kOneHigh_m).front();
  cell.id = static_cast<std::uint32_t>(cells.size());
  cells.push_back(cell);
  return cells;
}

void run_safe_height(const Ground& ground, Runs& runs) {
  const auto setting = [](const std::vector<SubCell>&) {
    return CoverageSetting{.d_max = kHighD_max, .levels = kLevels, .altitude_per_m = kAltitude_per_m};
  };
  runs.add(
      ground, kWith, [&](std::uint64_t seed) { return with_one_high(ground, seed); }, setting);
  const std::string safe = "at the safe height";
  runs.add(
      ground, safe, [&](std::uint64_t) { return level_cells(ground.strips, kOneHigh_m); }, setting);
  for (int run = 0; run < runs.schedule().runs; ++run) {
    const std::uint64_t seed = runs.schedule().first_seed + static_cast<std::uint64_t>(run);
    runs.add(ground, safe, seed, "covered", covered_percent(with_one_high(ground, seed), kOneHigh_m), "%");
    runs.add(ground, kWith, seed, "covered", 100.0, "%");
  }
}

void run_battery(const Ground& ground, Runs& runs) {
  for (const double units : battery_sweep()) {
    run_both_ways(
        ground, [units](const std::string& heights) { return battery_subject(heights, units); },
        [units](const std::vector<SubCell>& cells) {
          return CoverageSetting{.d_max = units * longest_m(cells), .levels = kLevels};
        },
        runs);
  }
}

void run_levels(const Ground& ground, Runs& runs) {
  for (const int levels : level_sweep()) {
    run_both_ways(
        ground, [levels](const std::string& heights) { return level_subject(heights, levels); },
        [levels](const std::vector<SubCell>&) { return CoverageSetting{.levels = levels}; }, runs);
  }
}

void run_neighbours(const Ground& ground, Runs& runs) {
  for (const bool full : {true, false}) {
    run_both_ways(
        ground, [full](const std::string& heights) { return heights + (full ? ", full graph" : ", X = 5"); },
        [full](const std::vector<SubCell>& cells) {
          return CoverageSetting{.levels = kParentsLevels,
                                 .neighbours = full ? static_cast<int>(cells.size()) : 5,
                                 .layers = Layers::kNearestOnly};
        },
        runs);
  }
}

std::vector<std::string> subjects_of(const std::vector<Row>& rows, const std::string& case_name) {
  std::vector<std::string> subjects;
  for (const Row& row : rows) {
    if (row.case_name == case_name && std::ranges::find(subjects, row.subject) == subjects.end())
      subjects.push_back(row.subject);
  }
  return subjects;
}

std::string median_cell(const std::vector<Row>& rows, const std::string& subject,
                        const std::string& case_name, const char* metric) {
  const std::vector<double> values = values_of(rows, subject, case_name, metric);
  return values.empty() ? "-" : significant(median_of(values));
}

Table table_of(const std::string& name, const std::vector<Ground>& grounds, const std::vector<Row>& rows) {
  static const std::vector<const char*> kMetrics{"cost",           "cpu",           "vertices", "recharges",
                                                 "height_changes", "scheduled_cost"};
  Table table{name + ": medians over the seeds",
              {"ground", "subject", "cost", "CPU ms", "vertices", "recharges", "changes of height",
               "cost with the robot's driving"},
              {}};
  const bool covers = name == kCovSafeHeight;
  if (covers) table.columns.emplace_back("covered at its height %");
  for (const Ground& ground : grounds) {
    const std::string case_name = name + ", " + ground.name;
    for (const std::string& subject : subjects_of(rows, case_name)) {
      std::vector<std::string> cells{ground.name, subject};
      for (const char* metric : kMetrics) cells.push_back(median_cell(rows, subject, case_name, metric));
      if (covers) cells.push_back(median_cell(rows, subject, case_name, "covered"));
      table.rows.push_back(std::move(cells));
    }
  }
  return table;
}

/// Median cost over what is swept, one line for each ground and way.
template <class Values, class SubjectOf>
void add_sweep_figure(const std::string& name, const std::string& x_label, const Values& values,
                      const SubjectOf& subject_of, const std::vector<Ground>& grounds,
                      const std::vector<Row>& rows, Report& report) {
  Chart chart{name, x_label, "cost", Scale::kLog, Scale::kLinear, {}};
  for (const Ground& ground : grounds) {
    for (const char* heights : {kWithout, kWith}) {
      Series series{ground.name + ", " + heights, {}, {}, {}, false};
      for (const auto value : values) {
        const auto costs = values_of(rows, subject_of(heights, value), name + ", " + ground.name, "cost");
        if (!costs.empty()) series.points.emplace_back(value, median_of(costs));
      }
      chart.series.push_back(std::move(series));
    }
  }
  report.figures.push_back({name + ": median cost over " + x_label + ".", draw(chart)});
}

}  // namespace

const std::vector<std::string>& coverage_experiments() {
  static const std::vector<std::string> all{kCovHeights, kCovSafeHeight, kCovBattery, kCovLevels,
                                            kCovNeighbours};
  return all;
}

const std::vector<double>& battery_sweep() {
  static const std::vector<double> all{0.95, 1.0, 1.05, 1.1, 1.15, 1.2, 1.25, 1.3, 1.4,  1.6,
                                       1.8,  2.0, 2.5,  3.0, 4.0,  5.0, 7.0,  10., 12.0, 15.0};
  return all;
}

const std::vector<int>& level_sweep() {
  static const std::vector<int> all{2, 3, 4, 5, 6, 8, 10, 12, 16, 20};
  return all;
}

std::string battery_subject(const std::string& heights, double units_of_m) {
  return fmt::format("{}, D_max = {:.2f} M", heights, units_of_m);
}

std::string level_subject(const std::string& heights, int levels) {
  return fmt::format("{}, k = {}", heights, levels);
}

Result<std::vector<Row>> run_coverage_experiment(const std::string& name, const std::string& data,
                                                 const SeedsSchedule& schedule, cli::Progress& progress,
                                                 Report& report) {
  const bool grows = name == kCovNeighbours;
  const auto grounds =
      grows ? grounds_of(data, {20.0, 10.0, 5.0},
                         {"timeVSi_4_10", "timeVSi_4_24", "timeVSi_4_45", "timeVSi_4_66"}, report)
            : grounds_of(data, {kSensorWidth_m}, {"timeVSi_4_24"}, report);
  if (!grounds) return grounds.error();
  Runs runs(name, schedule, progress);
  for (const Ground& ground : *grounds) {
    if (name == kCovHeights) run_heights(ground, runs);
    if (name == kCovSafeHeight) run_safe_height(ground, runs);
    if (name == kCovBattery) run_battery(ground, runs);
    if (name == kCovLevels) run_levels(ground, runs);
    if (name == kCovNeighbours) run_neighbours(ground, runs);
  }
  report.tables.push_back(table_of(name, *grounds, runs.rows()));
  if (name == kCovBattery)
    add_sweep_figure(name, "D_max / M", battery_sweep(), battery_subject, *grounds, runs.rows(), report);
  if (name == kCovLevels)
    add_sweep_figure(name, "k", level_sweep(), level_subject, *grounds, runs.rows(), report);
  return std::move(runs.rows());
}

}  // namespace swallowtail::bench
