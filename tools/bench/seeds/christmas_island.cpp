#include "tools/bench/seeds/christmas_island.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include "planner/base/clock.hpp"
#include "planner/cost/path_problem.hpp"
#include "planner/scenario/public_scene.hpp"
#include "planner/swarm/registry.hpp"
#include "tools/bench/core/statistics.hpp"
#include "tools/bench/plot/chart.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

constexpr double kNmopsoLimit_s = 0.3;
constexpr double kSpsoLimit_s = 0.2;
constexpr int kGuesses = 20;  ///< bowed paths to begin with, for the default form
constexpr std::uint64_t kGenerations = 500;
constexpr double kPublishedHypervolume = 0.895;  ///< our reading of the public code, 21 seeds
constexpr double kSpsoMedian = 4739.0;           ///< SPSO's median
constexpr double kTolerance = 1e-6;

planner::NavigationSpec spec_of(const planner::PublicScene& scene) {
  planner::NavigationSpec spec;
  spec.start_m = *scene.scenario.start_m;
  spec.goal_m = *scene.scenario.goal_m;
  spec.box_min_m = scene.scenario.bounds.min_m.head<2>();
  spec.box_max_m = scene.scenario.bounds.max_m.head<2>();
  spec.nodes = scene.scenario.planning.waypoints;
  spec.turn_max_rad = scene.scenario.vehicle.limits.turn_max_rad;
  spec.climb_max_rad = scene.scenario.vehicle.limits.climb_max_rad;
  // The public code's R_min: a third of what each node would have.
  spec.segment_min_m = (spec.goal_m - spec.start_m).norm() / (3.0 * spec.nodes);
  if (scene.scenario.planning.altitude_m) {
    spec.height_min_m = scene.scenario.planning.altitude_m->x();
    spec.height_max_m = scene.scenario.planning.altitude_m->y();
  }
  for (const planner::Obstacle& o : scene.scenario.obstacles) {
    if (const auto* cylinder = std::get_if<planner::Cylinder>(&o.shape))
      spec.threats.push_back({o.position_m.head<2>(), cylinder->radius_m});
  }
  return spec;
}

double level_distance_m(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double t = std::clamp((p - a).dot(b - a) / std::max(1e-300, (b - a).squaredNorm()), 0.0, 1.0);
  return (a + t * (b - a) - p).norm();
}

bool leaves_band(const planner::Terrain& terrain, const planner::NavigationSpec& spec, const Vec3& a,
                 const Vec3& b) {
  constexpr double kStep_m = 0.5;
  const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / kStep_m)));
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p = a + (b - a) * (static_cast<double>(i) / steps);
    const double above_m = p.z() - terrain.height_at(p.x(), p.y());
    if (above_m < spec.height_min_m - kTolerance || above_m > spec.height_max_m + kTolerance) return true;
  }
  return false;
}

double climb_of(const Vec3& hop) { return std::atan2(hop.z(), hop.head<2>().norm()); }

double turn_between(const Vec3& from, const Vec3& to) {
  const double raw = std::atan2(to.y(), to.x()) - std::atan2(from.y(), from.x());
  return std::abs(std::remainder(raw, 2.0 * std::numbers::pi));
}

Row row_of(const char* experiment, const std::string& subject, std::uint64_t seed, const char* metric,
           double value, const char* unit = "") {
  return {subject, experiment, seed, metric, value, unit};
}

struct Island {
  const planner::PublicScene& scene;
  planner::NavigationSpec spec;
  planner::NavigationProblem problem;
};

Result<swarm::MultiReport> run_front(const Island& island, const std::string& algorithm, std::uint64_t seed,
                                     const SeedsSchedule& schedule) {
  const auto params = swarm::params_by_name(algorithm);
  if (!params) return params.error();
  const ThreadCpuClock clock;
  swarm::MultiRunOptions options;
  options.seed = seed;
  options.history_every = 0;
  options.stop.clock = &clock;
  if (algorithm.ends_with("-seed")) {
    options.stop.max_iterations = kGenerations;
  } else {
    Rng rng(seed);
    options.stop.deadline_s = clock.now_s() + kNmopsoLimit_s;
    options.guesses = island.problem.guesses(kGuesses, rng);
  }
  if (schedule.iterations_most > 0)
    options.stop.max_iterations = static_cast<std::uint64_t>(schedule.iterations_most);
  return swarm::optimize_multi(*params, island.problem.problem(), options);
}

Figure front_figure(const swarm::Front& front, const std::string& algorithm) {
  Chart chart{algorithm + " on Christmas Island: front of one seed",
              "F1 (length)",
              "F2 to F4",
              Scale::kLinear,
              Scale::kLinear,
              {}};
  const char* names[] = {"F2 (threat)", "F3 (height)", "F4 (turns)"};
  for (Eigen::Index objective = 1; objective < 4; ++objective) {
    Series series{names[objective - 1], {}, {}, {}, true};
    for (Eigen::Index i = 0; i < front.size(); ++i)
      series.points.emplace_back(front.objectives(0, i), front.objectives(objective, i));
    chart.series.push_back(std::move(series));
  }
  return {chart.title, draw(chart)};
}

Table island_table(const char* experiment, const std::vector<Row>& rows,
                   const std::vector<std::string>& subjects, const std::vector<std::string>& metrics) {
  Table table{std::string(experiment) + ": medians (quartiles) over the seeds", {"algorithm"}, {}};
  for (const std::string& metric : metrics) table.columns.push_back(metric);
  for (const std::string& subject : subjects) {
    if (values_of(rows, subject, experiment, metrics.front()).empty()) continue;
    std::vector<std::string> cells{subject};
    for (const std::string& metric : metrics) {
      const Quartiles q = quartiles_of(values_of(rows, subject, experiment, metric));
      cells.push_back(fmt::format("{} ({} … {})", significant(q.median, 5), significant(q.lower, 5),
                                  significant(q.upper, 5)));
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace

std::optional<std::string> island_file(const std::string& name) {
  const char* named = std::getenv("SWALLOWTAIL_DATA");
  const std::filesystem::path folder = named != nullptr ? named : SWALLOWTAIL_DEFAULT_DATA;
  const std::filesystem::path file = folder / "terrain" / "scenarios" / (name + ".txt");
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return std::nullopt;
  return file.string();
}

int broken_limits(const planner::Terrain& terrain, const planner::NavigationSpec& spec,
                  const std::vector<Vec3>& path) {
  int broken = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec3 hop = path[i] - path[i - 1];
    if (hop.norm() < spec.segment_min_m.value_or(0.0) - kTolerance) ++broken;
    for (const auto& threat : spec.threats) {
      const double keep_m = threat.radius_m + spec.vehicle_size_m;
      if (level_distance_m(threat.center_m, path[i - 1].head<2>(), path[i].head<2>()) < keep_m - kTolerance)
        ++broken;
    }
    if (leaves_band(terrain, spec, path[i - 1], path[i])) ++broken;
    if (std::abs(climb_of(hop)) > spec.climb_max_rad + kTolerance) ++broken;
    if (i < 2) continue;
    const Vec3 before = path[i - 1] - path[i - 2];
    if (turn_between(before, hop) > spec.turn_max_rad + kTolerance) ++broken;
    if (std::abs(climb_of(hop) - climb_of(before)) > spec.climb_max_rad + kTolerance) ++broken;
  }
  return broken;
}

Result<std::vector<Row>> run_nmopso_island(const std::string& file, const SeedsSchedule& schedule,
                                           cli::Progress& progress, Report& report) {
  const auto scene = planner::read_public_scene(file);
  if (!scene) return scene.error();
  std::vector<Row> rows;
  const std::vector<std::string> algorithms{"nmopso-seed", "nmopso"};
  for (const std::string& algorithm : algorithms) {
    planner::NavigationSpec spec = spec_of(*scene);
    spec.form = algorithm.ends_with("-seed") ? planner::NavigationForm::kPublished
                                             : planner::NavigationForm::kRepaired;
    const auto problem = planner::NavigationProblem::make(scene->world->terrain(), spec);
    if (!problem) return problem.error();
    const Island island{*scene, spec, *problem};
    for (int run = 0; run < schedule.runs && !cli::interrupted(); ++run) {
      const std::uint64_t seed = schedule.first_seed + static_cast<std::uint64_t>(run);
      progress.update(fmt::format("{}, {}, run {} of {}", kNmopsoIsland, algorithm, run + 1, schedule.runs));
      const ThreadCpuClock clock;
      const double started_s = clock.now_s();
      const auto front = run_front(island, algorithm, seed, schedule);
      if (!front) return front.error();
      int breaking = 0;
      for (Eigen::Index i = 0; i < front->front.size(); ++i) {
        const std::vector<Vec3> path = problem->polyline(front->front.decisions.col(i));
        breaking += broken_limits(scene->world->terrain(), spec, path) > 0 ? 1 : 0;
      }
      const auto size = static_cast<double>(front->front.size());
      rows.push_back(row_of(kNmopsoIsland, algorithm, seed, "hypervolume", front->hypervolume));
      rows.push_back(row_of(kNmopsoIsland, algorithm, seed, "hypervolume_missed", 1.0 - front->hypervolume));
      rows.push_back(row_of(kNmopsoIsland, algorithm, seed, "front_size", size));
      rows.push_back(row_of(kNmopsoIsland, algorithm, seed, "breaking_a_limit", breaking, "members"));
      rows.push_back(row_of(kNmopsoIsland, algorithm, seed, "cpu", 1e3 * (clock.now_s() - started_s), "ms"));
      if (run == 0) report.figures.push_back(front_figure(front->front, algorithm));
    }
  }
  report.tables.push_back(island_table(kNmopsoIsland, rows, algorithms,
                                       {"hypervolume", "front_size", "breaking_a_limit", "cpu"}));
  return rows;
}

Result<std::vector<Row>> run_spso_island(const std::string& file, const SeedsSchedule& schedule,
                                         cli::Progress& progress, Report& report) {
  const auto scene = planner::read_public_scene(file);
  if (!scene) return scene.error();
  planner::PathProblemSpec spec;
  spec.start_m = *scene->scenario.start_m;
  spec.goal_m = *scene->scenario.goal_m;
  spec.waypoints = scene->scenario.planning.waypoints;
  spec.limits = scene->scenario.vehicle.limits;
  spec.cost.preset = "SPSO";
  spec.cost.weights = scene->scenario.planning.weights;
  if (scene->scenario.planning.altitude_m)
    spec.cost.altitude = {scene->scenario.planning.altitude_m->x(), scene->scenario.planning.altitude_m->y()};
  std::vector<Row> rows;
  std::vector<std::string> algorithms;
  for (const std::string& algorithm : swarm::algorithm_names()) {
    auto params = swarm::params_by_name(algorithm);
    if (!params) return params.error();
    if (swarm::takes_several_objectives(*params)) continue;
    algorithms.push_back(algorithm);
    for (int run = 0; run < schedule.runs && !cli::interrupted(); ++run) {
      const auto problem = planner::PathProblem::make(scene->world, spec);
      if (!problem) return problem.error();
      progress.update(fmt::format("{}, {}, run {} of {}", kSpsoIsland, algorithm, run + 1, schedule.runs));
      const ThreadCpuClock clock;
      const double started_s = clock.now_s();
      swarm::RunOptions options;
      options.seed = schedule.first_seed + static_cast<std::uint64_t>(run);
      options.stop.clock = &clock;
      options.stop.deadline_s = started_s + kSpsoLimit_s;
      if (schedule.iterations_most > 0)
        options.stop.max_iterations = static_cast<std::uint64_t>(schedule.iterations_most);
      options.keep_history = false;
      const auto best = swarm::optimize(*params, problem->problem(), options);
      if (!best) return best.error();
      rows.push_back(row_of(kSpsoIsland, algorithm, options.seed, "cost", best->best_cost));
      rows.push_back(row_of(kSpsoIsland, algorithm, options.seed, "evaluations",
                            static_cast<double>(best->evaluations)));
      rows.push_back(
          row_of(kSpsoIsland, algorithm, options.seed, "cpu", 1e3 * (clock.now_s() - started_s), "ms"));
    }
  }
  report.tables.push_back(island_table(kSpsoIsland, rows, algorithms, {"cost", "evaluations", "cpu"}));
  return rows;
}

std::vector<Claim> island_claims(const std::string& name, const std::vector<Row>& rows) {
  const auto sourced = [](Claim claim, const char* source, const std::string& sentence) {
    claim.source = source;
    claim.sentence = sentence;
    return claim;
  };
  if (name == kSpsoIsland)
    return {sourced(reaches(rows, name, "cost", "pso", kSpsoMedian), "[SPSO]",
                    fmt::format("SPSO's median cost of {:.0f} in 0.41 s", kSpsoMedian))};
  Claim mutation{name, "[NMOPSO 1]", "adaptive mutation keeps diversity and improves the solutions",
                 Verdict::kNotDecidable,
                 "the summary prints no numbers, and the published form has no switch for it"};
  return {sourced(reaches(rows, name, "hypervolume_missed", "nmopso-seed", 1.0 - kPublishedHypervolume),
                  "[NMOPSO 4]",
                  fmt::format("a hypervolume of {} (our reading of the public code)", kPublishedHypervolume)),
          sourced(reaches(rows, name, "breaking_a_limit", "nmopso-seed", 0.0), "[NMOPSO 2]",
                  "navigation variables keep the kinematic limits (nmopso-seed: as the public code has it)"),
          sourced(reaches(rows, name, "breaking_a_limit", "nmopso", 0.0), "default form",
                  "no front member breaks a limit"),
          sourced(lower_than(rows, name, "hypervolume_missed", "nmopso", {"nmopso-seed"}), "default form",
                  "nmopso's front dominates more than nmopso-seed's"),
          mutation};
}

}  // namespace swallowtail::bench
