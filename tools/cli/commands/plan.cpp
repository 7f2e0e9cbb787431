#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "coverage/task/energy_of.hpp"
#include "planner/base/clock.hpp"
#include "planner/replan/front_plan.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/input.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/params_file.hpp"
#include "tools/cli/plan_file.hpp"
#include "tools/cli/progress.hpp"
#include "tools/cli/statistics.hpp"

namespace swallowtail::cli {
namespace {

struct PlanOptions {
  Common common;
  std::string scenario;
  std::string algorithm;
  std::string cost;
  double budget_ms = 0.0;
  std::uint64_t evaluations = 0;
  std::uint64_t iterations = 0;
  int runs = 1;
  std::string params_file;
  std::vector<std::string> settings;
  ChosenParams chosen;  ///< from both
};

/// Reads --params and --set; what --set names wins.
Status take_params(PlanOptions& options) {
  if (!options.params_file.empty()) {
    Result<ChosenParams> chosen = read_params(options.params_file);
    if (!chosen) return chosen.error();
    options.chosen = std::move(*chosen);
    if (options.algorithm.empty()) options.algorithm = options.chosen.algorithm;
  }
  for (const std::string& text : options.settings) {
    Result<std::pair<std::string, double>> setting = parse_setting(text);
    if (!setting) return setting.error();
    options.chosen.settings.push_back(std::move(*setting));
  }
  return {};
}

const std::string& algorithm_of(const PlanOptions& options, const planner::Scenario& scenario) {
  return options.algorithm.empty() ? scenario.planning.algorithm : options.algorithm;
}

planner::CostSpec cost_of(const PlanOptions& options, const planner::Scenario& scenario) {
  const planner::PlanningSpec& planning = scenario.planning;
  planner::CostSpec cost;
  cost.preset = planning.cost;
  cost.weights = planning.weights;
  if (!options.cost.empty()) {
    // Weights belong to the preset that the scenario names.
    if (const auto named = planner::preset_by_name(options.cost),
        own = planner::preset_by_name(planning.cost);
        !named || !own || *named != *own) {
      cost.weights.clear();
    }
    cost.preset = options.cost;
  } else if (cost.preset == "default" && cost.weights.empty() &&
             planner::returns_front(algorithm_of(options, scenario))) {
    cost.preset = "NMOPSO";
  }
  if (planning.altitude_m) cost.altitude = {planning.altitude_m->x(), planning.altitude_m->y()};
  const planner::EnergyRates rates = coverage::still_air_rates_of(scenario);
  const double to_rad = scenario.wind.direction_rad;
  cost.energy = {rates.level_per_s, rates.climb_per_s, rates.descent_per_s, rates.hover_per_s,
                 scenario.wind.speed_mps * Vec2(std::sin(to_rad), std::cos(to_rad))};
  return cost;
}

planner::PricedRequest request_of(const PlanOptions& options, const planner::Scenario& scenario, int run) {
  planner::PricedRequest request;
  planner::PlanRequest& plan = request.plan;
  plan.start_m = *scenario.start_m;
  plan.goal_m = *scenario.goal_m;
  plan.limits = scenario.vehicle.limits;
  plan.params.algorithm = algorithm_of(options, scenario);
  plan.params.waypoints = options.chosen.midpoints.value_or(scenario.planning.waypoints);
  plan.params.settings = options.chosen.settings;
  plan.seed = options.common.seed + static_cast<std::uint64_t>(run);
  request.cost = cost_of(options, scenario);
  return request;
}

StopCondition stop_of(const PlanOptions& options, const Clock& clock) {
  StopCondition stop;
  stop.clock = &clock;
  stop.stop_requested = &interrupted();
  if (options.budget_ms > 0.0) stop.deadline_s = clock.now_s() + options.budget_ms / 1e3;
  if (options.evaluations > 0) stop.max_evaluations = options.evaluations;
  if (options.iterations > 0) stop.max_iterations = options.iterations;
  return stop;
}

struct Run {
  planner::PricedRequest request;
  planner::PricedReport report;
  std::optional<planner::PlannedFront> front;
};

/// All runs, over as many threads as asked for; each depends on its seed alone. Ends early when interrupted.
Result<std::vector<Run>> run_all(const PlanOptions& options, const Scene& scene, Progress& progress) {
  const SteadyClock clock;
  std::vector<std::optional<Result<planner::FrontReport>>> reports(static_cast<std::size_t>(options.runs));
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int run = next++; run < options.runs && !interrupted(); run = next++) {
      const auto observe = [&progress, run](const planner::PlanProgress& now) {
        progress.update(fmt::format("run {}: {:.3f} m after {} evaluations", run + 1, now.best_length_m,
                                    now.evaluations));
      };
      reports[static_cast<std::size_t>(run)] = planner::plan_with_front(
          scene.world, request_of(options, scene.scenario, run), stop_of(options, clock), &clock, observe);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < std::min(options.common.threads, options.runs); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();

  std::vector<Run> runs;
  for (int run = 0; run < options.runs; ++run) {
    auto& report = reports[static_cast<std::size_t>(run)];
    if (!report) continue;
    if (!*report) return report->error();
    planner::FrontReport& done = report->value();
    runs.push_back({request_of(options, scene.scenario, run), std::move(done.priced), std::move(done.front)});
  }
  if (runs.empty()) return Error{Error::Code::kInterrupted, "Interrupted before the first run."};
  return runs;
}

bool is_certified(const Run& run) { return run.report.plan.status == planner::PlanStatus::kCertified; }

/// What runs are compared by: the length under the default cost, else the cost.
double figure_of(const Run& run) {
  const bool by_length = run.request.cost.preset == "default" && run.request.cost.weights.empty();
  return by_length ? run.report.plan.length_m : run.report.plan.cost;
}

/// The best certified run; the first run when none is.
const Run& best_of(const std::vector<Run>& runs) {
  return *std::ranges::min_element(runs, [](const Run& a, const Run& b) {
    if (is_certified(a) != is_certified(b)) return is_certified(a);
    return is_certified(a) && figure_of(a) < figure_of(b);
  });
}

nlohmann::ordered_json run_json(const Run& run, const planner::Scenario& scenario) {
  nlohmann::ordered_json json = to_json(run.report, scenario.name, run.request);
  if (run.front) json.update(to_json(*run.front));
  return json;
}

nlohmann::ordered_json statistics_json(const std::vector<Run>& runs) {
  std::vector<double> length_m, cost, wall_ms, first_ms, hypervolume;
  for (const Run& run : runs) {
    if (run.front) hypervolume.push_back(run.front->hypervolume);
    wall_ms.push_back(run.report.plan.wall_ms);
    if (!is_certified(run)) continue;
    length_m.push_back(run.report.plan.length_m);
    cost.push_back(run.report.plan.cost);
    first_ms.push_back(run.report.plan.first_certified_ms);
  }
  nlohmann::ordered_json out = {{"runs", runs.size()},
                                {"certified", length_m.size()},
                                {"length_m", spread_json(length_m)},
                                {"cost", spread_json(cost)},
                                {"wall_ms", spread_json(wall_ms)},
                                {"first_certified_ms", spread_json(first_ms)}};
  if (!hypervolume.empty()) out["hypervolume"] = spread_json(hypervolume);
  return out;
}

std::string cost_line(const Run& run) {
  const planner::CostTerms& cost = run.report.terms;
  if (cost.terms.empty()) return {};
  std::string out = fmt::format("  cost             {} {:.6f} =", run.request.cost.preset, cost.total);
  for (std::size_t i = 0; i < cost.terms.size(); ++i) {
    const planner::CostTerm& term = cost.terms[i];
    out += fmt::format("{} {:g} · {} {:.6g}", i > 0 ? " +" : "", term.weight, term.name, term.value);
  }
  return out + (is_certified(run) ? "\n" : ", not certified\n");
}

std::string front_lines(const Run& run) {
  if (!run.front) return {};
  const planner::PlannedFront& front = *run.front;
  const auto certified = std::ranges::count_if(front.members, &planner::FrontMember::certified);
  std::string out = fmt::format("  front            {} paths, {} certified; hypervolume {:.4f}\n",
                                front.members.size(), certified, front.hypervolume);
  if (front.picked) {
    const planner::FrontMember& member = front.members[*front.picked];
    const Eigen::Vector4d& f = member.objectives;
    out += fmt::format("  picked           {}: F1 {:.4f}, F2 {:.4f}, F3 {:.4f}, F4 {:.4f}{}\n", *front.picked,
                       f[0], f[1], f[2], f[3], member.certified ? "" : ", not certified");
  }
  return out;
}

std::string table_of(const planner::Scenario& scenario, const std::vector<Run>& runs) {
  const Run& best = best_of(runs);
  const planner::PlanReport& report = best.report.plan;
  std::string out = fmt::format("{}: {}\n  algorithm        {}, seed {}\n  reason           {}\n",
                                scenario.name, planner::name(report.status),
                                best.request.plan.params.algorithm, best.request.plan.seed, report.reason);
  if (is_certified(best)) {
    out += fmt::format("  length           {:.3f} m in {:.1f} s\n  least clearance  {:.3f} m\n",
                       report.length_m, report.duration_s, report.certificate.clearance_min_m);
  }
  out += cost_line(best) + front_lines(best);
  out += fmt::format("  evaluations      {} in {:.2f} ms, first certified after {:.2f} ms\n",
                     report.evaluations, report.wall_ms, report.first_certified_ms);
  if (runs.size() > 1) {
    std::vector<double> figures;
    for (const Run& run : runs) {
      if (is_certified(run)) figures.push_back(figure_of(run));
    }
    const Spread spread = spread_of(figures);
    const bool by_length = figure_of(best) == report.length_m;
    out += fmt::format("  runs             {} of {} certified; {} {:.3f} best, {:.3f} median, {:.3f} worst\n",
                       figures.size(), runs.size(), by_length ? "length" : "cost", spread.min, spread.median,
                       spread.max);
  }
  if (is_certified(best)) {
    out += "\n    time s        east m       north m          up m  phase\n";
    for (const auto& w : report.path) {
      out += fmt::format("  {:8.2f}  {:12.3f}  {:12.3f}  {:12.3f}  {}\n", w.time_s, w.position_m.x(),
                         w.position_m.y(), w.position_m.z(), name(w.phase));
    }
  }
  return out;
}

Answer answer_of(const PlanOptions& options, const planner::Scenario& scenario,
                 const std::vector<Run>& runs) {
  const Run& best = best_of(runs);
  Answer answer;
  answer.json = run_json(best, scenario);
  if (options.runs > 1) {
    answer.json["runs"] = nlohmann::ordered_json::array();
    for (const Run& run : runs) answer.json["runs"].push_back(run_json(run, scenario));
    answer.json["statistics"] = statistics_json(runs);
  }
  answer.table = table_of(scenario, runs);
  answer.files[".csv"] = [path = best.report.plan.path, front = best.front] {
    return front ? front_csv(*front) : path_csv(path);
  };
  answer.files[".geojson"] = [path = best.report.plan.path, origin = scenario.origin] {
    return path_geojson(path, origin);
  };
  return answer;
}

Exit run_plan(const PlanOptions& options) {
  if (const Status status = check_output(options.common, {".json", ".csv", ".geojson"}); !status.ok())
    return fail(status.error());
  const auto scene = read_scene_or_tell(options.scenario);
  if (!scene) return Exit::kUsage;
  if (!scene->scenario.goal_m)
    return fail(bad_input(options.scenario + ": has no goal_m; `swallowtail cover` plans fields."));
  std::optional<Result<std::vector<Run>>> runs;
  {
    Progress progress("plan", options.common.quiet ? Progress::Show::kNo : Progress::Show::kYes);
    runs = run_all(options, *scene, progress);
  }
  if (!*runs) return fail(runs->error());
  Exit exit = is_certified(best_of(runs->value())) ? Exit::kDone : Exit::kNone;
  if (interrupted()) exit = Exit::kInterrupted;
  return deliver(options.common, answer_of(options, scene->scenario, runs->value()), exit);
}

}  // namespace

void add_plan(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("plan", "Plan a certified path from start_m to goal_m");
  const auto options = std::make_shared<PlanOptions>();
  command->add_option("SCENARIO", options->scenario, "Scenario file (.yaml), or a public code's scene (.txt)")
      ->required();
  command->add_option("--algorithm", options->algorithm, "Optimiser, instead of the scenario's");
  command->add_option(
      "--cost", options->cost,
      "What to minimise, instead of the scenario's: default, BOA, PSO, IBABC, NMOPSO or SPSO; NMOPSO where "
      "nobody names one and the algorithm returns a front");
  command
      ->add_option("--budget-ms", options->budget_ms,
                   "Stop after so many milliseconds with the best path so far")
      ->check(CLI::PositiveNumber);
  command->add_option("--evaluations", options->evaluations, "Stop after so many evaluations")
      ->check(CLI::PositiveNumber);
  command->add_option("--iterations", options->iterations, "Stop after so many iterations")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--runs", options->runs,
                   "Run with this many seeds, from --seed on, and report their statistics")
      ->check(CLI::Range(1, 100000));
  command->add_option("--params", options->params_file, "Parameters as `tune -o` writes them (.json)");
  command->add_option("--set", options->settings, "A parameter of the optimiser, key=value; may be repeated")
      ->allow_extra_args(false);
  add_common(
      *command, options->common,
      "  swallowtail plan tests/data/missions/ten_spheres.yaml\n"
      "  swallowtail plan ten_spheres.yaml --budget-ms 20 --json\n"
      "  swallowtail plan ten_spheres.yaml --algorithm pso-seed --cost PSO --iterations 50\n"
      "  swallowtail plan ten_spheres.yaml --params tuned.json --set population=40\n"
      "  swallowtail plan hills.yaml --algorithm nmopso --cost NMOPSO -o front.csv\n"
      "  swallowtail plan ten_spheres.yaml --runs 30 --threads 2 -o plan.json\n"
      "  -o writes .json (what `check --plan` reads), .csv (the front, where there is one) or .geojson");
  command->callback([options, &exit] {
    const Status status = take_params(*options);
    exit = status.ok() ? run_plan(*options) : fail(status.error());
  });
}

}  // namespace swallowtail::cli
