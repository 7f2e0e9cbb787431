#include "planner/replan/detour_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "planner/swarm/registry.hpp"

namespace swallowtail::planner {
namespace {

struct Setting {
  explicit Setting(const Vec3& shift = Vec3::Zero(), double turn_rad = 0.0, double scale = 1.0) {
    const Eigen::AngleAxisd turn(turn_rad, Vec3::UnitZ());
    const auto place = [&](const Vec3& p) { return Vec3(scale * (turn * p) + shift); };
    const std::vector<std::pair<Vec3, double>> balls = {{{30, 1, 20}, 8}, {{60, -4, 22}, 9}};
    std::vector<Obstacle> obstacles;
    for (const auto& [center, radius] : balls) {
      const auto id = static_cast<std::uint32_t>(obstacles.size() + 1);
      obstacles.push_back({.id = id, .shape = Sphere{scale * radius}, .position_m = place(center)});
    }
    limits.radius_m = 0.5 * scale;
    limits.margin_m = 2.0 * scale;
    limits.cruise_speed_mps = 8.0 * scale;
    limits.climb_speed_mps = 3.0 * scale;
    limits.descent_speed_mps = 3.0 * scale;
    world = *World::make(Terrain::flat(-1000.0), obstacles, Bounds{});
    ends = {place({0, 0, 20}), place({100, 0, 20}), 0.0, Vec3::Zero(), Vec3::Zero()};
  }
  VehicleLimits limits;
  std::shared_ptr<const World> world;
  DetourEnds ends;
};

double best_value(const Setting& s, std::uint64_t seed) {
  const ObstacleField field(s.world, s.limits);
  const DetourProblem problem(field, s.limits, s.ends, 4, DetourObjective::kLength);
  swarm::RunOptions options;
  options.seed = seed;
  options.stop.max_evaluations = 3000;
  const swarm::Problem in_box = problem.in_box(1.0);
  return swarm::optimize(*swarm::params_by_name("boa"), in_box, options)->best_cost;
}

TEST(DetourProblem, EncodingComesBack) {
  const Setting s(Vec3(5, 6, 7), 1.0);
  const ObstacleField field(s.world, s.limits);
  const DetourProblem problem(field, s.limits, s.ends, 3, DetourObjective::kLength);
  const std::vector<Vec3> points = {Vec3(20, 30, 25), Vec3(40, 41, 30), Vec3(60, 50, 22)};
  const std::vector<Vec3> back = problem.decode(problem.encode(points));
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((back[i] - points[i]).norm(), 1e-9);
}

TEST(DetourProblem, CostIsLengthWhereNothingIsHit) {
  const Setting s;
  const ObstacleField field(s.world, s.limits);
  const DetourProblem problem(field, s.limits, s.ends, 1, DetourObjective::kLength);
  const auto cost = problem.cost(problem.encode({Vec3(50, 60, 20)}));
  EXPECT_EQ(cost.violation_m, 0.0);
  EXPECT_NEAR(cost.length_m, 2.0 * std::hypot(50, 60), 1e-9);
  EXPECT_GT(problem.cost(problem.encode({Vec3(50, 0, 20)})).violation_m, 5.0);
}

TEST(DetourProblem, SteepHopsCountAsTheyAreFlown) {
  const Setting s;
  const ObstacleField field(s.world, s.limits);
  const DetourProblem problem(field, s.limits, s.ends, 1, DetourObjective::kLength);
  const auto cost = problem.cost(problem.encode({Vec3(10, 0, 60)}));
  EXPECT_NEAR(cost.length_m, 30.0 + 10.0 * std::sqrt(2.0) + std::hypot(90, 40), 1e-6)
      << "up, along the steepest slope, and a slope within the limit";
}

TEST(DetourProblem, AShiftedTurnedOrScaledSceneGivesTheSameAnswer) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const double value = best_value(Setting(), seed);
    EXPECT_NEAR(best_value(Setting(Vec3(500, -300, 40)), seed), value, 5e-3);
    EXPECT_NEAR(best_value(Setting(Vec3::Zero(), 0.8), seed), value, 5e-3);
    EXPECT_NEAR(best_value(Setting(Vec3::Zero(), 0.0, 4.0), seed), value, 5e-3);
  }
}

TEST(Resample, KeepsCornersAndFillsUp) {
  const std::vector<Vec3> filled = resample(Vec3(0, 0, 0), {Vec3(10, 10, 0)}, Vec3(30, 10, 0), 2);
  ASSERT_EQ(filled.size(), 2u);
  EXPECT_EQ(filled[0], Vec3(10, 10, 0));
  EXPECT_EQ(filled[1], Vec3(20, 10, 0));
  const std::vector<Vec3> thinned =
      resample(Vec3(0, 0, 0), {Vec3(5, 0.1, 0), Vec3(10, 10, 0)}, Vec3(30, 10, 0), 1);
  ASSERT_EQ(thinned.size(), 1u);
  EXPECT_EQ(thinned[0], Vec3(10, 10, 0));
}

}  // namespace
}  // namespace swallowtail::planner
