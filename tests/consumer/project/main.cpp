#include <cstdio>

#include "coverage/gtsp/solver.hpp"
#include "coverage/schedule/plan.hpp"
#include "planner/path/certifier.hpp"
#include "planner/replan/point_to_point.hpp"

int main() {
  using namespace swallowtail;
  const auto world = planner::World::make(planner::Terrain::flat(0.0), {}, {});
  if (!world) return 1;
  const planner::TimedPath path{{0.0, Vec3(0, 0, 10)}, {2.0, Vec3(10, 0, 10)}};
  if (!planner::certify(path, planner::ClearanceQuery(*world), {}).certified) return 2;

  const auto report = planner::plan_path(*world, {.start_m = Vec3(0, 0, 10), .goal_m = Vec3(50, 0, 10)}, {});
  if (!report || report->status != planner::PlanStatus::kCertified) return 3;

  coverage::Task task;
  task.fields = {{.id = 1, .polygon = {.outline = {{0, 0}, {60, 0}, {60, 40}, {0, 40}}}}};
  const auto plan = coverage::plan_coverage(task, planner::Terrain::flat(0.0), {});
  if (!plan || plan->covered_percent < 99.9) return 4;

  const auto instance =
      gtsp::Instance::from_points({{0}, {1}, {2}}, {{0, 0}, {3, 0}, {3, 4}}, gtsp::Metric::kEuc2D);
  if (!instance) return 5;
  const auto solution = gtsp::solve(*instance, {});
  std::printf("tour of length %.0f\n", solution.cost);
  return solution.cost == 12.0 ? 0 : 6;
}
