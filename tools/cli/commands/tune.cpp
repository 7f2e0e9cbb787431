#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "planner/cost/path_problem.hpp"
#include "planner/swarm/tuning.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/input.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"

namespace swallowtail::cli {
namespace {

struct TuneOptions {
  Common common;
  std::string scenario;
  std::string algorithm;
  std::string cost;
  std::uint64_t evaluations = 10000;
  int seeds = 11;
  int most_midpoints = 16;
};

planner::PathProblemSpec spec_of(const TuneOptions& options, const planner::Scenario& scenario) {
  planner::PathProblemSpec spec;
  spec.start_m = *scenario.start_m;
  spec.goal_m = *scenario.goal_m;
  spec.limits = scenario.vehicle.limits;
  spec.cost.preset = options.cost.empty() ? scenario.planning.cost : options.cost;
  if (options.cost.empty()) spec.cost.weights = scenario.planning.weights;
  if (scenario.planning.altitude_m) {
    spec.cost.altitude = {scenario.planning.altitude_m->x(), scenario.planning.altitude_m->y()};
  }
  spec.cost.step_grows = options.algorithm.ends_with("-seed");
  return spec;
}

/// One run on a problem of its own: a problem whose costs grow carries the state of its run.
swarm::TuningRun run_of(const TuneOptions& options, const Scene& scene) {
  return [&options, &scene](const swarm::AnyParams& params, int midpoints,
                            std::uint64_t seed) -> Result<swarm::Report> {
    planner::PathProblemSpec spec = spec_of(options, scene.scenario);
    spec.waypoints = midpoints;
    const Result<planner::PathProblem> problem = planner::PathProblem::make(scene.world, spec);
    if (!problem) return problem.error();
    swarm::RunOptions run;
    run.seed = seed;
    run.stop.max_evaluations = options.evaluations;
    run.stop.stop_requested = &interrupted();
    return swarm::optimize(params, problem->problem(), run);
  };
}

nlohmann::ordered_json number(const swarm::Parameter& parameter) {
  if (parameter.is_integer()) return static_cast<std::int64_t>(parameter.get());
  return parameter.get();
}

std::string name_of(const TuneOptions& options, const planner::Scenario& scenario) {
  return options.algorithm.empty() ? scenario.planning.algorithm : options.algorithm;
}

Answer answer_of(const TuneOptions& options, const planner::Scenario& scenario,
                 const swarm::TuningReport& report) {
  swarm::AnyParams params = report.params;
  swarm::AnyParams before = *swarm::params_by_name(options.algorithm);
  const swarm::Parameters was = parameters(before);
  nlohmann::ordered_json settings;
  std::string table = fmt::format("{}: {} tuned with {} seeds of {} evaluations\n", scenario.name,
                                  options.algorithm, options.seeds, options.evaluations);
  table += fmt::format("  median cost      {:.6g} → {:.6g}\n  generations      {} until within 0.1 %\n\n",
                       report.median_before, report.median_after, report.generations);
  table += fmt::format("  {:<20} {:>12} {:>12}   {}\n", "parameter", "before", "after", "range, source");
  table += fmt::format("  {:<20} {:>12} {:>12}   1 to {}, [BOA Alg. 5]\n", "midpoints",
                       scenario.planning.waypoints, report.midpoints, options.most_midpoints);
  std::size_t i = 0;
  for (const swarm::Parameter& parameter : parameters(params)) {
    table += fmt::format("  {:<20} {:>12g} {:>12g}   {:g} to {:g}, {}\n", parameter.name, was[i].get(),
                         parameter.get(), parameter.min, parameter.max, parameter.source);
    settings[std::string(parameter.name)] = number(parameter);
    ++i;
  }
  Answer answer;
  answer.table = table;
  answer.json = {{"status", report.interrupted ? "interrupted" : "tuned"},
                 {"scenario", scenario.name},
                 {"algorithm", options.algorithm},
                 {"seed", options.common.seed},
                 {"seeds", options.seeds},
                 {"evaluations_each", options.evaluations},
                 {"evaluations", report.evaluations},
                 {"median_cost_before", report.median_before},
                 {"median_cost", report.median_after},
                 {"midpoints", report.midpoints},
                 {"generations", report.generations},
                 {"parameters", settings}};
  answer.json["sweep"] = nlohmann::ordered_json::array();
  for (const swarm::TuningStep& step : report.steps) {
    answer.json["sweep"].push_back({{"parameter", step.parameter},
                                    {"value", step.value},
                                    {"median_cost", step.median_cost},
                                    {"kept", step.kept}});
  }
  answer.files[".csv"] = [steps = report.steps] {
    std::string csv = "parameter,value,median_cost,kept\n";
    for (const swarm::TuningStep& step : steps) {
      csv += fmt::format("{},{},{},{}\n", step.parameter, step.value, step.median_cost, step.kept ? 1 : 0);
    }
    return csv;
  };
  return answer;
}

Exit run_tune(TuneOptions options) {
  if (const Status status = check_output(options.common, {".json", ".csv"}); !status.ok()) {
    return fail(status.error());
  }
  const std::optional<Scene> scene = read_scene_or_tell(options.scenario);
  if (!scene) return Exit::kUsage;
  if (!scene->scenario.start_m || !scene->scenario.goal_m) {
    return fail(bad_input(options.scenario + ": tuning needs start_m and goal_m."));
  }
  options.algorithm = name_of(options, scene->scenario);
  const Result<swarm::AnyParams> start = swarm::params_by_name(options.algorithm);
  if (!start) return fail(start.error());

  swarm::TuningOptions tuning;
  tuning.seed = options.common.seed;
  tuning.seeds = options.seeds;
  tuning.threads = options.common.threads;
  tuning.midpoints = scene->scenario.planning.waypoints;
  tuning.most_midpoints = options.most_midpoints;
  tuning.stop_requested = &interrupted();
  std::optional<Result<swarm::TuningReport>> report;
  {
    Progress progress("tune", options.common.quiet ? Progress::Show::kNo : Progress::Show::kYes);
    tuning.observer = [&progress](const swarm::TuningStep& step) {
      progress.update(fmt::format("{} {:g}: median cost {:.6g}{}", step.parameter, step.value,
                                  step.median_cost, step.kept ? ", kept" : ""));
    };
    report = swarm::tune(*start, run_of(options, *scene), tuning);
  }
  if (!*report) return fail(report->error());
  const swarm::TuningReport& done = report->value();
  return deliver(options.common, answer_of(options, scene->scenario, done),
                 done.interrupted ? Exit::kInterrupted : Exit::kDone);
}

}  // namespace

void add_tune(CLI::App& app, Exit& exit) {
  CLI::App* command =
      app.add_subcommand("tune", "Search an optimiser's parameters on a scenario, one after the other");
  const auto options = std::make_shared<TuneOptions>();
  command->add_option("SCENARIO", options->scenario, "Scenario file (.yaml), or a public code's scene (.txt)")
      ->required();
  command->add_option("--algorithm", options->algorithm, "Optimiser, instead of the scenario's");
  command->add_option(
      "--cost", options->cost,
      "What to minimise, instead of the scenario's: default, BOA, PSO, IBABC, NMOPSO or SPSO");
  command->add_option("--budget", options->evaluations, "Evaluations of each run")
      ->check(CLI::Range(std::uint64_t{100}, std::uint64_t{100000000}))
      ->capture_default_str();
  command->add_option("--seeds", options->seeds, "Runs of each setting, with seeds from --seed on")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--most-midpoints", options->most_midpoints, "Greatest number of midpoints to try")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  add_common(*command, options->common,
             "  swallowtail tune tests/data/missions/ten_spheres.yaml --algorithm pso\n"
             "  swallowtail tune ten_spheres.yaml --algorithm boa --budget 3000 --seeds 21 --threads 2\n"
             "  swallowtail tune ten_spheres.yaml --algorithm pso-seed --cost PSO -o tuned.json\n"
             "  -o writes .json (what `plan --params` reads) or .csv (every setting tried)");
  command->callback([options, &exit] { exit = run_tune(*options); });
}

}  // namespace swallowtail::cli
