#include <gtest/gtest.h>

#include "planner/base/rng.hpp"
#include "planner/cost/path_problem.hpp"
#include "tests/support/allocations.hpp"

namespace swallowtail::planner {
namespace {

TEST(CostAllocation, EvaluationTakesNoMemory) {
  if (!SWALLOWTAIL_COUNTS_ALLOCATIONS) GTEST_SKIP() << "the sanitizer owns malloc";
  std::vector<Obstacle> obstacles;
  for (std::uint32_t id = 1; id <= 20; ++id) {
    Obstacle& obstacle = obstacles.emplace_back();
    obstacle.id = id;
    obstacle.shape = id % 2 == 0 ? Shape(Sphere{2.0}) : Shape(Cylinder{2.0, 10.0});
    obstacle.position_m = Vec3(2.0 * id, 37.0 - 1.5 * id, 1.0 * id);
    if (id == 20) obstacle.velocity_mps = Vec3(1, 0, 0);
  }
  const Terrain terrain =
      mountains_terrain({{10, 20, 12, 20}, {30, 25, 18, 40}}, Vec2(0, 0), Vec2(40, 40), 0.5).value();
  const auto world = World::make(terrain, obstacles, {Vec3(0, 0, 0), Vec3(40, 40, 30)}).value();
  PathProblemSpec spec;
  spec.start_m = Vec3(1, 1, 5);
  spec.goal_m = Vec3(39, 39, 28);
  for (const std::string& preset : preset_names()) {
    spec.cost.preset = preset;
    spec.cost.weights = {{"energy", 1.0}, {"clearance", 1.0}};
    const PathProblem problem = PathProblem::make(world, spec).value();
    const swarm::Problem& posed = problem.problem();
    Rng rng(3);
    Eigen::MatrixXd candidates(posed.dimension(), 50);
    for (Eigen::Index i = 0; i < candidates.size(); ++i) {
      const Eigen::Index variable = i % posed.dimension();
      candidates.data()[i] = rng.uniform(posed.lower[variable], posed.upper[variable]);
    }
    Eigen::VectorXd costs(50);
    posed.evaluate(candidates, costs);  // this thread's first
    const std::uint64_t before = test::allocations();
    ASSERT_GT(before, 0u) << "the counter must count";
    for (int i = 0; i < 5; ++i) posed.evaluate(candidates, costs);
    EXPECT_GT(before, 0U);
    EXPECT_EQ(test::allocations(), before) << preset;
  }
}

}  // namespace
}  // namespace swallowtail::planner
