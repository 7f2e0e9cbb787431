#include "planner/cost/path_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace swallowtail::planner {
namespace {

std::shared_ptr<const World> world_of(std::vector<Obstacle> obstacles,
                                      Terrain terrain = Terrain::flat(-1.0)) {
  return World::make(std::move(terrain), std::move(obstacles), {Vec3(0, 0, 0), Vec3(11, 11, 11)}).value();
}

Obstacle sphere(std::uint32_t id, const Vec3& center_m, double radius_m) {
  Obstacle obstacle;
  obstacle.id = id;
  obstacle.shape = Sphere{radius_m};
  obstacle.position_m = center_m;
  return obstacle;
}

PathProblemSpec spec_of(const std::string& preset) {
  PathProblemSpec spec;
  spec.start_m = Vec3(1, 1, 1);
  spec.goal_m = Vec3(10, 10, 10);
  spec.waypoints = 3;
  spec.limits.radius_m = 1e-6;
  spec.limits.margin_m = 0.0;
  spec.limits.cruise_speed_mps = 1.0;
  spec.cost.preset = preset;
  return spec;
}

double value_of(const CostTerms& terms, const std::string& name) {
  for (const CostTerm& term : terms.terms) {
    if (term.name == name) return term.value;
  }
  return std::nan("");
}

std::string message_of(const PathProblemSpec& spec) {
  const auto problem = PathProblem::make(world_of({}), spec);
  return problem ? "" : problem.error().message;
}

TEST(PathProblem, RefusesWhatMakesNoSense) {
  PathProblemSpec spec = spec_of("bees");
  EXPECT_EQ(message_of(spec),
            "There is no cost preset 'bees'; known are: default, BOA, PSO, IBABC, NMOPSO, SPSO.");
  spec = spec_of("PSO");
  spec.cost.weights = {{"length", std::nan("")}};
  EXPECT_EQ(message_of(spec), "The weight of objective 'length' is nan; it must be finite and at least 0.");
  spec.cost.weights = {{"length", -2.0}};
  EXPECT_NE(message_of(spec).find("is -2.000000"), std::string::npos);
  spec.cost.weights = {{"beauty", 1.0}};
  EXPECT_NE(message_of(spec).find("There is no objective 'beauty'"), std::string::npos);
  spec.cost.weights = {{"length", 1.0}, {"length", 2.0}};
  EXPECT_EQ(message_of(spec), "The objective 'length' is weighted twice.");
  spec = spec_of("PSO");
  spec.goal_m = spec.start_m;
  EXPECT_NE(message_of(spec).find("one place"), std::string::npos);
  spec = spec_of("PSO");
  spec.waypoints = 0;
  EXPECT_NE(message_of(spec).find("is 0; it must be 1 to 64"), std::string::npos);
  spec = spec_of("PSO");
  spec.start_m.x() = -50.0;
  spec.goal_m = Vec3(-40, 1, 1);
  EXPECT_NE(message_of(spec).find("The box of the waypoints is empty"), std::string::npos);
  spec = spec_of("SPSO");
  spec.cost.altitude = {5.0, 5.0};
  EXPECT_NE(message_of(spec).find("altitude band is 5.000000 to 5.000000"), std::string::npos);
}

TEST(PathProblem, TakesPresetsInEitherCase) {
  for (const std::string& name : preset_names()) {
    std::string small = name;
    for (char& c : small) c = static_cast<char>(std::tolower(c));
    const auto problem = PathProblem::make(world_of({}), spec_of(small));
    ASSERT_TRUE(problem) << problem.error().message;
    EXPECT_EQ(problem->preset(), name);
  }
}

// One ball of radius 2 whose centre the straight line passes at distance 1, one hop.
TEST(PathProblem, BoaPunishesTheDepthNotTheDistance) {
  const auto world = world_of({sphere(1, Vec3(5, 5, 6), 2.0)});
  PathProblemSpec spec = spec_of("BOA");
  spec.start_m = Vec3(1, 5, 5);
  spec.goal_m = Vec3(9, 5, 5);
  const PathProblem problem = PathProblem::make(world, spec).value();
  const std::vector<Vec3> line = {spec.start_m, spec.goal_m};
  const CostTerms terms = problem.terms(line);
  EXPECT_NEAR(value_of(terms, "length"), 8.0, 1e-12);
  EXPECT_NEAR(value_of(terms, "range"), 1.0 + 4.5, 1e-12);
  EXPECT_NEAR(value_of(terms, "collision"), 4.0, 1e-4);  // (1 + 1)²
  EXPECT_NEAR(terms.total, 8.0 + 100.0 * value_of(terms, "collision") + 3.0 * 5.5, 1e-9);
}

TEST(PathProblem, BoasStepGrowsWithTheIteration) {
  const auto world = world_of({sphere(1, Vec3(5.5, 5.5, 5.5), 2.0)});
  PathProblemSpec spec = spec_of("BOA");
  EXPECT_FALSE(PathProblem::make(world, spec)->problem().begin_iteration);
  spec.cost.step_grows = true;
  const PathProblem problem = PathProblem::make(world, spec).value();
  Eigen::VectorXd straight(9);
  straight << 3, 3, 3, 5, 5, 5, 8, 8, 8;
  const auto cost_at = [&](std::uint64_t iteration) {
    problem.problem().begin_iteration(iteration);
    Eigen::VectorXd cost(1);
    problem.problem().evaluate(straight, cost);
    return cost[0];
  };
  const CostTerms terms = problem.terms(problem.polyline(straight));
  const double collision = value_of(terms, "collision");
  ASSERT_GT(collision, 1.0);
  EXPECT_NEAR(cost_at(7) - cost_at(2), 5.0 * collision, 1e-9);
  EXPECT_FALSE(problem.problem().begin_iteration(2));
  EXPECT_TRUE(problem.problem().begin_iteration(3));
}

TEST(PathProblem, WhateverIsFreeBeatsWhateverIsNot) {
  const auto world = world_of({sphere(1, Vec3(5.5, 5.5, 5.5), 1.0)});
  const PathProblem problem = PathProblem::make(world, spec_of("PSO")).value();
  Eigen::MatrixXd candidates(9, 2);
  candidates.col(0) << 3, 3, 3, 5, 5, 5, 8, 8, 8;        // through the ball
  candidates.col(1) << 11, 0, 0, 11, 0, 11, 11, 11, 11;  // the long way round
  Eigen::VectorXd costs(2);
  problem.problem().evaluate(candidates, costs);
  EXPECT_GT(costs[0], costs[1]);
  EXPECT_NEAR(costs[1], problem.terms(problem.polyline(candidates.col(1))).total, 1e-12);
}

TEST(PathProblem, AddsAndOverridesObjectivesByWeight) {
  PathProblemSpec spec = spec_of("default");
  spec.cost.weights = {{"energy", 2.0}, {"violation", 0.0}};
  const PathProblem problem = PathProblem::make(world_of({}), spec).value();
  EXPECT_EQ(problem.names(), (std::vector<std::string>{"length", "violation", "energy"}));
  const CostTerms terms = problem.terms(std::vector<Vec3>{Vec3(1, 1, 1), Vec3(9, 1, 1)});
  EXPECT_NEAR(terms.total, 8.0 / std::sqrt(243.0) + 2.0 * 8.0, 1e-12);  // one unit per second at 1 m/s
}

TEST(PathProblem, DecodesWhatItEncodes) {
  const auto world = world_of({sphere(1, Vec3(5.5, 5.5, 5.5), 1.0)});
  const std::vector<Vec3> waypoints = {Vec3(3, 4, 3), Vec3(5, 7, 5), Vec3(8, 8, 7)};
  for (const EncodingKind kind : {EncodingKind::kBox, EncodingKind::kFrame, EncodingKind::kAboveGround}) {
    PathProblemSpec spec = spec_of("default");
    spec.encoding = kind;
    const PathProblem problem = PathProblem::make(world, spec).value();
    const std::vector<Vec3> back = problem.decode(problem.encode(waypoints));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT((back[i] - waypoints[i]).norm(), 1e-12);
  }
  PathProblemSpec spec = spec_of("IBABC");
  const PathProblem problem = PathProblem::make(world, spec).value();
  ASSERT_EQ(problem.problem().dimension(), 6);
  const std::vector<Vec3> back = problem.decode(problem.encode(waypoints));
  const Vec3 along = Vec3(1, 1, 1).normalized();
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR((back[i] - spec.start_m).dot(along), std::sqrt(243.0) * (static_cast<double>(i) + 1.0) / 4.0,
                1e-9);
  }
}

}  // namespace
}  // namespace swallowtail::planner
