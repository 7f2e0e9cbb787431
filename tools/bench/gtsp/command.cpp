#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/core.h>

#include "coverage/gtsp/check_tour.hpp"
#include "coverage/gtsp/solver.hpp"
#include "planner/base/clock.hpp"
#include "tools/bench/commands.hpp"
#include "tools/bench/core/convergence.hpp"
#include "tools/bench/core/options.hpp"
#include "tools/bench/core/statistics.hpp"
#include "tools/bench/gtsp/cases.hpp"
#include "tools/bench/plot/chart.hpp"
#include "tools/cli/progress.hpp"

namespace swallowtail::bench {
namespace {

constexpr const char* kSubject = "swallowtail gtsp";

struct GtspBenchOptions {
  Options base;
  std::string instances = "../shared/data/gtsplib";
  std::string mode = "default";
  int max_vertices = 1'100;
  bool is_growth_only = false;
  double growth_budget_s = 300.0;  ///< CPU time of all runs for the growth together
};

/// What a run may take.
struct RunLimits {
  double time_s = 0.0;  ///< CPU; 0: as long as the mode does
  double bound_effort = 1.0;
};

gtsp::Mode mode_named(const std::string& name) {
  return name == "fast" ? gtsp::Mode::kFast : name == "slow" ? gtsp::Mode::kSlow : gtsp::Mode::kDefault;
}

/// Processor time as the solver's clock, so that histories and limits are free of what else the machine does.
class ProcessCpuClock final : public Clock {
 public:
  double now_s() const override { return process_cpu_s(); }
};

struct Run {
  double cost = gtsp::kNoArc;
  double lower_bound = 0.0;
  double cpu_s = 0.0;
  Curve curve;
};

Result<Run> solve_once(const GtspBenchOptions& options, const GtspCase& bench_case, std::uint64_t seed,
                       const RunLimits& limits) {
  const ProcessCpuClock clock;
  gtsp::Options solver;
  solver.mode = mode_named(options.mode);
  solver.seed = seed;
  solver.threads = options.base.common.threads;
  solver.stop.clock = &clock;
  solver.stop.stop_requested = &cli::interrupted();
  const double begin_s = clock.now_s();
  if (limits.time_s > 0.0) solver.stop.deadline_s = begin_s + limits.time_s;
  solver.bound_effort = limits.bound_effort;
  const gtsp::Solution solution = gtsp::solve(bench_case.instance, solver);
  Run run{solution.cost, solution.lower_bound, clock.now_s() - begin_s, {}};
  for (const auto& entry : solution.history) run.curve.push_back({1e3 * entry.wall_s, 0, 0, entry.cost});
  if (solution.tour.empty()) return run;
  const auto checked = gtsp::check_tour(bench_case.instance, solution.tour, {});
  if (!checked) return internal_error("The checker refused a tour: " + checked.error().message);
  if (checked.value() != solution.cost) return internal_error("The checker measured another cost.");
  return run;
}

class GtspBench {
 public:
  explicit GtspBench(const GtspBenchOptions& options) : options_(options) {
    report_.bench = "gtsp";
    report_.status = "done";
    table_.title = "GTSP, mode " + options.mode;
    table_.columns = {"case", "vertices", "best", "gap %", "worst %", "hits", "gap to bound %", "CPU s"};
  }

  Status run() {
    if (!options_.is_growth_only) {
      if (const Status status = measure_files(); !status) return status;
      report_.tables.push_back(table_);
    }
    return measure_growth();
  }
  Report& report() { return report_; }

 private:
  Status measure_files() {
    auto cases = std::vector<GtspCase>{};
    if (std::filesystem::is_directory(options_.instances)) {
      auto read = read_gtsp_cases(options_.instances);
      if (!read) return read.error();
      cases = std::move(*read);
    } else {
      report_.notes.push_back("The folder " + options_.instances +
                              " is not there: only generated instances.");
    }
    if (const Status status = read_peers(); !status) return status;
    for (const GtspCase& bench_case : cases) {
      if (bench_case.instance.vertex_count() > (options_.base.quick ? 110 : options_.max_vertices)) continue;
      if (const Status status = measure(bench_case); !status) return status;
    }
    return {};
  }

  Status read_peers() {
    const auto peers = read_peer_results(options_.base.data + "/gtsp_peers.csv");
    if (!peers) return peers.error();
    peers_ = *peers;
    for (const PeerResult& peer : peers_) {
      if (std::find(peer_names_.begin(), peer_names_.end(), peer.subject) == peer_names_.end())
        peer_names_.push_back(peer.subject);
    }
    for (const std::string& name : peer_names_) table_.columns.push_back(name + ": %, s");
    report_.notes.emplace_back(
        "The peers' columns are measurements from a file, on another day: read ratios.");
    return {};
  }

  Result<std::vector<Run>> runs_on(const GtspCase& bench_case, int count, const RunLimits& limits) {
    std::vector<Run> runs;
    for (int i = 0; i < count && !cli::interrupted(); ++i) {
      progress_.update(fmt::format("{}, run {} of {}", bench_case.name, i + 1, count));
      const std::uint64_t seed = options_.base.common.seed + static_cast<std::uint64_t>(i);
      auto run = solve_once(options_, bench_case, seed, limits);
      if (!run) return run.error();
      add_row(bench_case.name, seed, "cost", run->cost, "");
      add_row(bench_case.name, seed, "lower_bound", run->lower_bound, "");
      add_row(bench_case.name, seed, "cpu", run->cpu_s, "s");
      runs.push_back(std::move(*run));
    }
    return runs;
  }

  void add_row(const std::string& name, std::uint64_t seed, const std::string& metric, double value,
               const std::string& unit) {
    report_.rows.push_back({kSubject, name, seed, metric, value, unit});
  }

  Status measure(const GtspCase& bench_case) {
    const auto result =
        runs_on(bench_case, runs_of(options_.base, 10, 3), {.time_s = options_.base.time_limit_s});
    if (!result) return result.error();
    if (result->empty()) return {};
    const std::vector<Run>& runs = *result;
    double best = bench_case.best_known;
    for (const Run& run : runs) best = std::min(best, run.cost);
    double gap = 0.0;
    double worst = 0.0;
    double bound_gap = 0.0;
    double cpu_s = 0.0;
    int hits = 0;
    for (const Run& run : runs) {
      const double of_run = 100.0 * (run.cost / best - 1.0);
      gap += of_run / static_cast<double>(runs.size());
      worst = std::max(worst, of_run);
      bound_gap += 100.0 * (run.cost / run.lower_bound - 1.0) / static_cast<double>(runs.size());
      cpu_s += run.cpu_s / static_cast<double>(runs.size());
      hits += run.cost <= best ? 1 : 0;
    }
    std::vector<std::string> row = {bench_case.name,
                                    std::to_string(bench_case.instance.vertex_count()),
                                    fmt::format("{}", best),
                                    fmt::format("{:.3f}", gap),
                                    fmt::format("{:.3f}", worst),
                                    fmt::format("{}/{}", hits, runs.size()),
                                    fmt::format("{:.2f}", bound_gap),
                                    fmt::format("{:.2f}", cpu_s)};
    for (const std::string& name : peer_names_) row.push_back(peer_cell(name, bench_case.name));
    table_.rows.push_back(std::move(row));
    draw_convergence(bench_case.name, runs, best);
    return {};
  }

  std::string peer_cell(const std::string& subject, const std::string& case_name) const {
    for (const PeerResult& peer : peers_) {
      if (peer.subject == subject && peer.case_name == case_name)
        return fmt::format("{:.2f}, {}", peer.gap_percent, significant(peer.cpu_s, 3));
    }
    return "-";
  }

  void draw_convergence(const std::string& name, const std::vector<Run>& runs, double best) {
    std::vector<Curve> curves;
    for (const Run& run : runs) curves.push_back(run.curve);
    const Band band = band_of(curves, Effort::kTime_ms, 60);
    Chart chart{name,        "CPU ms",       "% above best",
                Scale::kLog, Scale::kLinear, {gap_series(kSubject, band, best)}};
    report_.figures.push_back({"Convergence on " + name + ": median and quartiles.", draw(chart)});
  }

  /// Seconds for each run of a size, so that all together keep the budget; the larger, the more.
  double growth_limit_s(const std::vector<int>& sizes, int n, int runs) const {
    const auto weight = [](int size) { return std::pow(size, 1.2); };
    double sum = 0.0;
    for (const int size : sizes) sum += weight(size);
    return options_.growth_budget_s * weight(n) / sum / runs;
  }

  /// Median CPU time to 1 % above the best of all seeds, against the number of vertices.
  Status measure_growth() {
    const std::vector<int> sizes = options_.base.quick ? std::vector<int>{50, 100, 200}
                                                       : std::vector<int>{200, 400, 800, 1600, 2800, 4000};
    Series measured{"time to 1 %", {}, {}, {}};
    Table growth{"Growth on generated instances", {"vertices", "median CPU ms to 1 %"}, {}};
    for (const int n : sizes) {
      const GtspCase bench_case = generated_gtsp_case(n, 1);
      const int count = runs_of(options_.base, 5, 3);
      const RunLimits limits{.time_s = growth_limit_s(sizes, n, count), .bound_effort = 0.0};
      const auto runs = runs_on(bench_case, count, limits);
      if (!runs) return runs.error();
      if (runs->empty()) break;
      double best = gtsp::kNoArc;
      for (const Run& run : *runs) best = std::min(best, run.cost);
      std::vector<double> times_ms;
      for (const Run& run : *runs)
        times_ms.push_back(effort_to(run.curve, Effort::kTime_ms, target_of(best, 0.01)));
      std::sort(times_ms.begin(), times_ms.end());
      const double median_ms = times_ms[times_ms.size() / 2];
      add_row(bench_case.name, options_.base.common.seed, "median_time_to_1_percent", median_ms, "ms");
      growth.rows.push_back({std::to_string(n), significant(median_ms)});
      measured.points.emplace_back(n, median_ms);
    }
    if (measured.points.size() < 2) return {};
    add_slope(measured, growth);
    Series allowed{"n^1.5", {}, {}, {}};
    for (const auto& [n, ms] : measured.points)
      allowed.points.emplace_back(
          n, measured.points.front().second * std::pow(n / measured.points.front().first, 1.5));
    const Chart chart{"Growth", "vertices", "CPU ms to 1 %", Scale::kLog, Scale::kLog, {measured, allowed}};
    report_.figures.push_back(
        {"CPU time to 1 % above the best against the number of vertices.", draw(chart)});
    report_.tables.push_back(std::move(growth));
    return {};
  }

  /// Least squares on logarithms.
  void add_slope(const Series& measured, Table& growth) {
    double sx = 0.0;
    double sy = 0.0;
    double sxx = 0.0;
    double sxy = 0.0;
    double count = 0.0;
    for (const auto& [n, ms] : measured.points) {
      if (!(ms > 0.0) || !std::isfinite(ms)) continue;
      const double x = std::log(n);
      const double y = std::log(ms);
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
      count += 1.0;
    }
    const double slope = (count * sxy - sx * sy) / (count * sxx - sx * sx);
    if (!std::isfinite(slope)) return;
    add_row("growth", options_.base.common.seed, "exponent", slope, "");
    growth.rows.push_back({"exponent", fmt::format("{:.2f}", slope)});
  }

  const GtspBenchOptions& options_;
  cli::Progress progress_{"bench gtsp", cli::Progress::Show::kYes};
  Report report_;
  Table table_;
  std::vector<PeerResult> peers_;
  std::vector<std::string> peer_names_;
};

cli::Exit run_bench(const GtspBenchOptions& options) {
  if (const Status status = check(options.base); !status) return cli::fail(status.error());
  GtspBench bench(options);
  if (const Status status = bench.run(); !status) return cli::fail(status.error());
  return deliver(options.base, std::move(bench.report()));
}

}  // namespace

void add_gtsp(CLI::App& app, cli::Exit& exit) {
  CLI::App* command =
      app.add_subcommand("gtsp", "Gap, time and hits of the GTSP solver beside its peers' results");
  const auto options = std::make_shared<GtspBenchOptions>();
  command->add_option("--instances", options->instances, "Folder of .gtsp files with best_known.csv");
  command->add_option("--mode", options->mode, "Of the solver")
      ->check(CLI::IsMember({"fast", "default", "slow"}));
  command->add_option("--max-vertices", options->max_vertices, "Leave larger files out");
  command->add_flag("--growth", options->is_growth_only, "Only the growth of the time to 1 % with the size");
  command->add_option("--growth-budget", options->growth_budget_s, "CPU seconds of all its runs together")
      ->check(CLI::Range(1.0, 1e6));
  add_options(*command, options->base,
              "  swallowtail bench gtsp --quick\n"
              "  swallowtail bench gtsp --growth --growth-budget 120\n"
              "  swallowtail bench gtsp --mode fast --runs 10 -o gtsp.html");
  command->callback([options, &exit] { exit = run_bench(*options); });
}

}  // namespace swallowtail::bench
