#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "tools/bench/commands.hpp"
#include "tools/bench/core/options.hpp"
#include "tools/bench/seeds/christmas_island.hpp"
#include "tools/bench/seeds/claims.hpp"
#include "tools/bench/seeds/coverage_experiments.hpp"
#include "tools/bench/seeds/run.hpp"

namespace swallowtail::bench {
namespace {

constexpr int kRuns = 30;
constexpr int kQuickRuns = 3;
constexpr int kQuickIterations = 10;
/// Of the coverage experiments, whose sweeps have many settings.
constexpr int kCoverageRuns = 8;
constexpr int kQuickCoverageRuns = 2;

struct SeedsBench {
  Options options;
  std::vector<std::string> names;
};

SeedsSchedule schedule_of(const Options& options) {
  SeedsSchedule schedule;
  schedule.first_seed = options.common.seed;
  schedule.runs = runs_of(options, kRuns, kQuickRuns);
  if (options.quick) {
    schedule.tuning_runs = 1;
    schedule.iterations_most = kQuickIterations;
    schedule.range = {{10, 20}, {2, 3}, {10}};
  }
  return schedule;
}

/// Names of every experiment, those on real data last.
std::vector<std::string> known_names() {
  std::vector<std::string> names;
  for (const Experiment& experiment : experiments()) names.push_back(experiment.name);
  for (const std::string& name : coverage_experiments()) names.push_back(name);
  names.emplace_back(kNmopsoIsland);
  names.emplace_back(kSpsoIsland);
  return names;
}

/// Those named; all when none is. Errors: a name that is none.
Result<std::vector<std::string>> chosen(const std::vector<std::string>& names) {
  const std::vector<std::string> known = known_names();
  if (names.empty()) return known;
  for (const std::string& name : names) {
    if (std::ranges::find(known, name) == known.end())
      return bad_input(
          fmt::format("There is no experiment '{}'; known are: {}.", name, fmt::join(known, ", ")));
  }
  return names;
}

void keep_claims(const std::vector<Claim>& claims, Report& report) {
  auto& list = report.extra["claims"];
  list = nlohmann::ordered_json::array();
  for (const Claim& c : claims) {
    list.push_back({{"experiment", c.experiment},
                    {"source", c.source},
                    {"claim", c.sentence},
                    {"verdict", name(c.verdict)},
                    {"evidence", c.evidence}});
  }
}

/// Rows of one experiment; its tables, figures and claims are added. One on data that are not there is
/// skipped.
Status run_one(const std::string& name, const Options& options, cli::Progress& progress, Report& report,
               std::vector<Claim>& claims) {
  const SeedsSchedule schedule = schedule_of(options);
  const auto keep = [&](const Result<std::vector<Row>>& rows, const auto& claims_in) -> Status {
    if (!rows) return rows.error();
    report.rows.insert(report.rows.end(), rows->begin(), rows->end());
    for (Claim& claim : claims_in(name, *rows)) claims.push_back(std::move(claim));
    return {};
  };
  if (name == kNmopsoIsland || name == kSpsoIsland) {
    const auto file = island_file(name);
    if (!file) {
      report.notes.push_back("skipped: " + name + ", its terrain is not there (set SWALLOWTAIL_DATA).");
      return {};
    }
    return keep(name == kNmopsoIsland ? run_nmopso_island(*file, schedule, progress, report)
                                      : run_spso_island(*file, schedule, progress, report),
                island_claims);
  }
  if (std::ranges::find(coverage_experiments(), name) != coverage_experiments().end()) {
    SeedsSchedule fewer = schedule;
    fewer.runs = runs_of(options, kCoverageRuns, kQuickCoverageRuns);
    return keep(run_coverage_experiment(name, options.data, fewer, progress, report), coverage_claims);
  }
  const Experiment& experiment = *std::ranges::find(experiments(), name, &Experiment::name);
  const auto scene = load_case(options.data + "/seeds/" + name + ".yaml");
  if (!scene) return scene.error();
  const auto rows = run_experiment(experiment, *scene, schedule, progress, report);
  if (rows) report.tables.push_back(summary_of(experiment, *rows));
  return keep(rows, claims_of);
}

Status run_all(const std::vector<std::string>& names, const Options& options, Report& report) {
  cli::Progress progress("bench seeds",
                         options.common.quiet ? cli::Progress::Show::kNo : cli::Progress::Show::kYes);
  std::vector<Claim> claims;
  for (const std::string& name : names) {
    if (cli::interrupted()) break;
    if (const Status status = run_one(name, options, progress, report, claims); !status) return status;
  }
  keep_claims(claims, report);
  report.tables.push_back(to_table(claims));
  return {};
}

cli::Exit run_bench(const SeedsBench& bench) {
  if (const Status status = check(bench.options); !status) return cli::fail(status.error());
  const auto todo = chosen(bench.names);
  if (!todo) return cli::fail(todo.error());
  Report report;
  report.bench = "seeds";
  if (const Status status = run_all(*todo, bench.options, report); !status) return cli::fail(status.error());
  report.notes.push_back(
      fmt::format("Two-sided Mann-Whitney tests, Holm's correction within a claim, level {}. As published: "
                  "-seed. Obstacles are "
                  "ours wherever a document prints none.",
                  kClaimLevel));
  return deliver(bench.options, std::move(report));
}

}  // namespace

void add_seeds(CLI::App& app, cli::Exit& exit) {
  CLI::App* command =
      app.add_subcommand("seeds", "The source documents' experiments, and whether their claims hold");
  const auto bench = std::make_shared<SeedsBench>();
  command->add_option("NAME", bench->names,
                      fmt::format("Experiments: {}; none: all", fmt::join(known_names(), ", ")));
  add_options(*command, bench->options,
              "  swallowtail bench seeds\n"
              "  swallowtail bench seeds pso_five pso_ten --runs 100 -o claims.html\n"
              "  swallowtail bench seeds cov_battery cov_levels -o coverage.html\n"
              "  swallowtail bench seeds boa_3d --quick --json");
  command->callback([bench, &exit] { exit = run_bench(*bench); });
}

}  // namespace swallowtail::bench
