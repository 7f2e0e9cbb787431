#include <algorithm>
#include <memory>
#include <utility>

#include "planner/base/stop.hpp"
#include "planner/cost/path_problem.hpp"
#include "planner/replan/point_to_point.hpp"
#include "planner/swarm/registry.hpp"
#include "tools/bench/plan/judge.hpp"
#include "tools/bench/plan/subject.hpp"

namespace swallowtail::bench {
namespace {

PlanRun run_plan_path(const planner::CorridorParts& parts, const PlanCase& plan_case, std::uint64_t seed,
                      const RunLimit& limit) {
  planner::PlanRequest request;
  request.start_m = plan_case.start_m;
  request.goal_m = plan_case.goal_m;
  request.limits = plan_case.limits;
  request.params.waypoints = plan_case.waypoints;
  request.params.parts = parts;
  request.seed = seed;
  const ThreadCpuClock clock;
  const double started_s = clock.now_s();
  StopCondition stop;
  stop.clock = &clock;
  stop.deadline_s = started_s + limit.cpu_s;
  stop.max_evaluations = limit.evaluations;
  const auto report = planner::plan_path(plan_case.world, request, stop, &clock);
  PlanRun run;
  run.cpu_ms = 1e3 * (clock.now_s() - started_s);
  if (!report) {
    run.failure = report.error().message;
    return run;
  }
  run.evaluations = report->evaluations;
  for (const auto& p : report->history) run.curve.push_back({p.wall_ms, p.evaluations, 0, p.best_length_m});
  for (const auto& w : report->path) run.path_m.push_back(w.position_m);
  return run;
}

PlanRun run_optimiser(const std::string& name, const PlanCase& plan_case, std::uint64_t seed,
                      const RunLimit& limit) {
  PlanRun failed;
  const auto params = swarm::params_by_name(name);
  planner::PathProblemSpec spec;
  spec.start_m = plan_case.start_m;
  spec.goal_m = plan_case.goal_m;
  spec.waypoints = plan_case.waypoints;
  spec.limits = plan_case.limits;
  Recorder recorder;
  const ThreadCpuClock clock;
  swarm::RunOptions options;
  options.stop.clock = &clock;
  options.stop.deadline_s = clock.now_s() + limit.cpu_s;
  options.stop.max_evaluations = limit.evaluations;
  options.seed = seed;
  options.keep_history = false;
  const auto problem = planner::PathProblem::make(plan_case.world, spec);
  if (!params || !problem) {
    failed.failure = params ? problem.error().message : params.error().message;
    return failed;
  }
  const Judge judge(plan_case);
  options.observer = [&](const swarm::Progress& progress) {
    if (!progress.improved) return swarm::Advice::kContinue;
    const std::vector<Vec3> path = problem->polyline(progress.best);
    const double length_m = length_of(path);
    if (length_m < recorder.best_length_m() && judge.free(path))
      recorder.offer(path, length_m, progress.evaluations, progress.iterations);
    return swarm::Advice::kContinue;
  };
  const auto report = swarm::optimize(*params, problem->problem(), options);
  if (!report) {
    failed.failure = report.error().message;
    return failed;
  }
  return recorder.finish(report->evaluations);
}

Subject planner_with(const std::string& name, const planner::CorridorParts& parts) {
  return {name, "planner", [parts](const PlanCase& plan_case, std::uint64_t seed, const RunLimit& limit) {
            return run_plan_path(parts, plan_case, seed, limit);
          }};
}

}  // namespace

std::vector<Subject> ablation_subjects() {
  const auto without = [](bool planner::CorridorParts::*part) {
    planner::CorridorParts parts;
    parts.*part = false;
    return parts;
  };
  return {planner_with("plan_path", {}),
          planner_with("without butterflies", without(&planner::CorridorParts::butterflies)),
          planner_with("without launcher", without(&planner::CorridorParts::launcher)),
          planner_with("without polish", without(&planner::CorridorParts::polish)),
          planner_with("without tree", without(&planner::CorridorParts::tree))};
}

std::vector<Subject> our_subjects() {
  std::vector<Subject> subjects{planner_with("plan_path", {})};
  for (const std::string& name : swarm::algorithm_names()) {
    subjects.push_back(
        {name, "optimiser", [name](const PlanCase& plan_case, std::uint64_t seed, const RunLimit& limit) {
           return run_optimiser(name, plan_case, seed, limit);
         }});
  }
  return subjects;
}

}  // namespace swallowtail::bench
