// A batch costs what its columns cost one by one, and what an oracle written from the documents says.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "planner/base/rng.hpp"
#include "planner/kernels/obstacle_field.hpp"
#include "tests/unit/planner/cost/oracle.hpp"

namespace swallowtail::planner {
namespace {

struct Scene {
  std::shared_ptr<const World> world;
  PathProblemSpec spec;
  test::OracleScene seen;
};

Scene random_scene(Rng& rng) {
  Scene scene;
  TerrainGrid& grid = scene.seen.ground;
  grid.origin_m = Vec2(rng.uniform(-3, 3), rng.uniform(-3, 3));
  grid.cell_size_m = rng.uniform(1.5, 4.0);
  grid.rows = grid.cols = 12;
  for (int i = 0; i < grid.rows * grid.cols; ++i)
    grid.elevation_m.push_back(static_cast<float>(rng.uniform(0.0, 8.0)));
  std::vector<Obstacle> obstacles;
  const std::uint64_t count = 1 + rng.below(8);
  for (std::uint32_t id = 1; id <= count; ++id) {
    Obstacle obstacle;
    obstacle.id = id;
    obstacle.shape = Sphere{rng.uniform(0.5, 5.0)};
    obstacle.position_m = Vec3(rng.uniform(0, 40), rng.uniform(0, 40), rng.uniform(0, 25));
    obstacle.margin_m = rng.below(2) == 0 ? 0.0 : rng.uniform(0.0, 1.0);
    obstacles.push_back(obstacle);
  }
  // Bounds wider than the raster: the oracle and the costs see the same lowest and highest ground.
  const Bounds bounds{Vec3(-20, -20, 0), Vec3(60, 60, 30)};
  scene.world = World::make(Terrain::from_grid(grid).value(), obstacles, bounds).value();
  PathProblemSpec& spec = scene.spec;
  spec.start_m = Vec3(rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(1, 29));
  spec.goal_m = Vec3(rng.uniform(30, 45), rng.uniform(30, 45), rng.uniform(1, 29));
  spec.waypoints = 1 + static_cast<int>(rng.below(9));
  spec.limits.radius_m = rng.uniform(0.1, 1.0);
  spec.limits.margin_m = rng.uniform(0.0, 1.0);
  spec.cost.altitude = {rng.uniform(0.0, 5.0), rng.uniform(6.0, 20.0)};
  spec.cost.danger_distance_m = rng.uniform(0.5, 10.0);
  scene.seen.band_min_m = spec.cost.altitude.min_m;
  scene.seen.band_max_m = spec.cost.altitude.max_m;
  scene.seen.danger_m = spec.cost.danger_distance_m;
  scene.seen.clearance_m = spec.limits.clearance_m();
  ObstacleField field(scene.world, spec.limits);
  field.set_slope_share(0.4);
  scene.seen.ground_clearance_m = field.ground_clearance_m();
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    scene.seen.balls.push_back(
        {obstacles[i].position_m, std::get<Sphere>(obstacles[i].shape).radius_m, field.required_m(i)});
  }
  return scene;
}

RC_GTEST_PROP(CostOracle, BatchSingleAndOracleAgree, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  Scene scene = random_scene(rng);
  for (const std::string& preset : preset_names()) {
    scene.spec.cost.preset = preset;
    const PathProblem problem = PathProblem::make(scene.world, scene.spec).value();
    const swarm::Problem& posed = problem.problem();
    const auto columns = static_cast<Eigen::Index>(1 + rng.below(19));
    Eigen::MatrixXd candidates(posed.dimension(), columns);
    for (Eigen::Index i = 0; i < candidates.size(); ++i) {
      const Eigen::Index variable = i % posed.dimension();
      candidates.data()[i] = rng.uniform(posed.lower[variable], posed.upper[variable]);
    }
    Eigen::VectorXd batch(columns);
    posed.evaluate(candidates, batch);
    Eigen::MatrixXd values(static_cast<Eigen::Index>(problem.names().size()), columns);
    problem.values(candidates, values);
    for (Eigen::Index column = 0; column < columns; ++column) {
      Eigen::VectorXd single(1);
      posed.evaluate(candidates.col(column), single);
      RC_ASSERT(single[0] == batch[column]);
      const std::vector<Vec3> path = problem.polyline(candidates.col(column));
      const CostTerms terms = problem.terms(path);
      RC_ASSERT(terms.total == batch[column]);
      for (std::size_t i = 0; i < terms.terms.size(); ++i) {
        const CostTerm& term = terms.terms[i];
        RC_ASSERT(term.value == values(static_cast<Eigen::Index>(i), column));
        const double wanted = test::oracle(scene.seen, preset, term.name, path);
        RC_LOG() << preset << " " << term.name << ": " << term.value << ", oracle " << wanted << "\n";
        RC_ASSERT(std::abs(term.value - wanted) <= 1e-9 * std::max(1.0, std::abs(wanted)));
      }
    }
  }
}

}  // namespace
}  // namespace swallowtail::planner
