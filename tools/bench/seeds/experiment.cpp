#include "tools/bench/seeds/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/clock.hpp"
#include "planner/cost/path_problem.hpp"
#include "planner/swarm/registry.hpp"
#include "tools/bench/core/statistics.hpp"
#include "tools/bench/plan/judge.hpp"

namespace swallowtail::bench {
namespace {

constexpr double kSettled = 1e-3;

std::uint64_t settled_at(const std::vector<swarm::HistoryEntry>& history) {
  const double last = history.back().best_cost;
  std::uint64_t at = history.size() - 1;
  while (at > 0 && std::abs(history[at - 1].best_cost - last) <= kSettled * std::abs(last)) --at;
  return at;
}

int middle(const std::vector<int>& values) { return values[values.size() / 2]; }

}  // namespace

const std::vector<Experiment>& experiments() {
  static const std::vector<std::string> kBoa{"boa-seed", "pso-seed", "aco-seed", "boa", "pso", "aco"};
  static const std::vector<Experiment> all{
      {"boa_2d", "BOA", 50, 100, kBoa},
      {"boa_3d", "BOA", 20, 300, kBoa},
      {"boa_mountains", "BOA", 20, 300, kBoa},
      {"boa_mixed", "BOA", 20, 300, kBoa},
      {"pso_five",
       "PSO",
       200,
       50,
       {"pso-seed", "boa-seed", "ibabc-seed", "aco-seed", "pso", "boa", "ibabc", "aco"}},
      {"pso_ten",
       "PSO",
       200,
       50,
       {"pso-seed", "boa-seed", "ibabc-seed", "aco-seed", "pso", "boa", "ibabc", "aco"}},
      {"ibabc_box", "IBABC", 50, 100, {"ibabc-seed", "ibabc", "pso-seed", "pso"}},
  };
  return all;
}

Result<Trial> run_trial(const PlanCase& scene, const std::string& preset, const std::string& algorithm,
                        const Setting& setting, std::uint64_t seed) {
  auto params = swarm::params_by_name(algorithm);
  if (!params) return params.error();
  planner::PathProblemSpec spec;
  spec.start_m = scene.start_m;
  spec.goal_m = scene.goal_m;
  spec.waypoints = setting.waypoints;
  spec.limits = scene.limits;
  spec.cost.preset = preset;
  spec.cost.step_grows = preset == "BOA" && algorithm.ends_with("-seed");
  spec.cost.step_end = setting.iterations;
  const auto problem = planner::PathProblem::make(scene.world, spec);
  if (!problem) return problem.error();
  const ThreadCpuClock clock;
  swarm::RunOptions options;
  options.stop.clock = &clock;
  options.stop.max_iterations = static_cast<std::uint64_t>(setting.iterations);
  options.seed = seed;
  const double started_s = clock.now_s();
  swarm::AnyParams chosen = swarm::with_population(*params, setting.population);
  for (const swarm::Parameter& parameter : swarm::parameters(chosen)) {
    if (parameter.name != "generations") continue;
    if (const Status status = swarm::set({parameter}, parameter.name, setting.iterations); !status)
      return status.error();
  }
  const auto report = swarm::optimize(chosen, problem->problem(), options);
  if (!report) return report.error();
  Trial trial;
  trial.cpu_ms = 1e3 * (clock.now_s() - started_s);
  const std::vector<Vec3> path = problem->polyline(report->best);
  trial.cost = problem->terms(path).total;
  trial.length_m =
      refusal_of(scene, path).empty() ? length_of(path) : std::numeric_limits<double>::infinity();
  trial.evaluations = report->evaluations;
  trial.settled = settled_at(report->history);
  trial.first_cost = report->history.front().best_cost;
  for (std::size_t i = 0; i < report->history.size(); ++i) {
    const auto& h = report->history[i];
    trial.curve.push_back({1e3 * h.elapsed_s, h.evaluations, i, h.best_cost});
  }
  return trial;
}

Setting random_setting(const SettingRange& range, Rng& rng) {
  const auto any = [&rng](const std::vector<int>& values) { return values[rng.below(values.size())]; };
  Setting setting;
  setting.population = any(range.populations);
  setting.waypoints = any(range.waypoints);
  setting.iterations = any(range.iterations);
  return setting;
}

Result<Setting> greedy_setting(const PlanCase& scene, const std::string& preset, const std::string& algorithm,
                               const SettingRange& range, std::uint64_t first_seed, int runs) {
  Setting best{middle(range.populations), middle(range.waypoints), middle(range.iterations)};
  const auto median_cost = [&](const Setting& setting) -> Result<double> {
    std::vector<double> costs;
    for (int run = 0; run < runs; ++run) {
      const auto trial =
          run_trial(scene, preset, algorithm, setting, first_seed + static_cast<std::uint64_t>(run));
      if (!trial) return trial.error();
      costs.push_back(trial->cost);
    }
    return median_of(costs);
  };
  const auto sweep = [&](int Setting::*what, const std::vector<int>& values) -> Status {
    double least = std::numeric_limits<double>::infinity();
    Setting winner = best;
    for (const int value : values) {
      Setting setting = best;
      setting.*what = value;
      const auto cost = median_cost(setting);
      if (!cost) return cost.error();
      if (*cost < least) {
        least = *cost;
        winner = setting;
      }
    }
    best = winner;
    return {};
  };
  for (const auto& [what, values] :
       {std::pair{&Setting::population, &range.populations}, std::pair{&Setting::waypoints, &range.waypoints},
        std::pair{&Setting::iterations, &range.iterations}}) {
    if (const Status status = sweep(what, *values); !status) return status.error();
  }
  return best;
}

}  // namespace swallowtail::bench
