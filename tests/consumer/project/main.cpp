#include <cstdio>

#include "coverage/gtsp/solver.hpp"
#include "planner/path/certifier.hpp"

int main() {
  using namespace swallowtail;
  const auto world = planner::World::make(planner::Terrain::flat(0.0), {}, {});
  if (!world) return 1;
  const planner::TimedPath path{{0.0, Vec3(0, 0, 10)}, {2.0, Vec3(10, 0, 10)}};
  if (!planner::certify(path, planner::ClearanceQuery(*world), {}).certified) return 2;

  const auto instance = gtsp::Instance::from_points({{0}, {1}, {2}}, {{0, 0}, {3, 0}, {3, 4}}, gtsp::Metric::kEuc2D);
  if (!instance) return 3;
  const auto solution = gtsp::solve(*instance, {});
  std::printf("tour of length %.0f\n", solution.cost);
  return solution.cost == 12.0 ? 0 : 4;
}
