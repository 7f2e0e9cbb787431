#include "planner/replan/preset_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "planner/scenario/public_scene.hpp"

namespace swallowtail::planner {
namespace {

Obstacle ball(std::uint32_t id, const Vec3& center_m, double radius_m) {
  Obstacle obstacle;
  obstacle.id = id;
  obstacle.shape = Sphere{radius_m};
  obstacle.position_m = center_m;
  return obstacle;
}

std::shared_ptr<const World> world_of(std::vector<Obstacle> obstacles) {
  return World::make(Terrain::flat(-1), std::move(obstacles), {Vec3(0, 0, 0), Vec3(11, 11, 11)}).value();
}

PricedRequest request_of(const std::string& algorithm, const std::string& preset) {
  PricedRequest request;
  request.plan.start_m = Vec3(1, 1, 1);
  request.plan.goal_m = Vec3(10, 10, 10);
  request.plan.limits = {1e-6, 0.0, 1.0, 1.0, 1.0, std::numbers::pi, 1.5};
  request.plan.params.algorithm = algorithm;
  request.plan.params.waypoints = 3;
  request.cost.preset = preset;
  return request;
}

const std::vector<Obstacle> kTwoBalls = {ball(1, Vec3(5.5, 5.5, 5.5), 2.0), ball(2, Vec3(8, 6, 8), 1.0)};

TEST(PresetPlan, EveryPresetGivesACertifiedPathAndItsTerms) {
  const auto world = world_of(kTwoBalls);
  for (const std::string& preset : preset_names()) {
    const auto report = plan_with_cost(world, request_of("boa", preset), {.max_evaluations = 12'000});
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->plan.status, PlanStatus::kCertified) << preset << ": " << report->plan.reason;
    double sum = 0.0;
    for (const CostTerm& term : report->terms.terms) sum += term.weight * term.value;
    EXPECT_NEAR(report->terms.total, sum, 1e-9 * sum) << preset;
    EXPECT_LE(report->plan.evaluations, 12'000u) << preset;
    EXPECT_TRUE(report->attempt.empty());
  }
}

TEST(PresetPlan, PolishBringsTheShortestPathOfThreeWaypoints) {
  const auto world = world_of({ball(1, Vec3(5.5, 5.5, 5.5), 2.0)});
  const auto report = plan_with_cost(world, request_of("boa", "PSO"), {.max_evaluations = 40'000}).value();
  ASSERT_EQ(report.plan.status, PlanStatus::kCertified);
  // Round a ball of radius r at the middle: with h half the straight line, the taut string has two tangents
  // and an arc; three waypoints bend round it with a polygon, a little longer.
  const double h = 0.5 * std::sqrt(243.0);
  const double taut = 2.0 * (std::sqrt(h * h - 4.0) + 2.0 * std::asin(2.0 / h));
  EXPECT_GE(report.plan.length_m, taut - 1e-9);
  EXPECT_LE(report.plan.length_m, 1.002 * taut);
}

TEST(PresetPlan, SameSeedSamePath) {
  const auto world = world_of(kTwoBalls);
  for (const char* algorithm : {"boa", "pso-seed"}) {
    const PricedRequest request = request_of(algorithm, "BOA");
    const StopCondition stop{.max_evaluations = 6'000};
    const auto a = plan_with_cost(world, request, stop).value();
    const auto b = plan_with_cost(world, request, stop).value();
    ASSERT_EQ(a.plan.path.size(), b.plan.path.size());
    EXPECT_EQ(a.terms.total, b.terms.total);
    for (std::size_t i = 0; i < a.plan.path.size(); ++i) {
      EXPECT_EQ(a.plan.path[i].position_m, b.plan.path[i].position_m);
    }
  }
}

TEST(PresetPlan, WhatIsNotCertifiedIsAnAttemptAndNeverAPath) {
  Obstacle wall = ball(1, Vec3(5, 5, 5), 1.0);
  wall.shape = Box{Vec3(1.0, 30.0, 30.0), 0.0};
  const auto report =
      plan_with_cost(world_of({wall}), request_of("pso-seed", "PSO"), {.max_evaluations = 4'000});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->plan.status, PlanStatus::kNoneFound);
  EXPECT_TRUE(report->plan.path.empty());
  EXPECT_EQ(report->attempt.size(), 5u);
  EXPECT_NE(report->plan.reason.find("blocked by obstacle 1"), std::string::npos) << report->plan.reason;
  EXPECT_GT(report->terms.total, 4.0 * std::sqrt(3.0) * 11.0) << "more than any path in the box is long";
}

TEST(PresetPlan, BlockedEndsAndBadInputHaveTheirOwnAnswers) {
  PricedRequest request = request_of("boa", "BOA");
  EXPECT_EQ(plan_with_cost(world_of({ball(1, Vec3(1, 1, 1), 1)}), request, {})->plan.status,
            PlanStatus::kStartBlocked);
  EXPECT_EQ(plan_with_cost(world_of({ball(1, Vec3(10, 10, 10), 1)}), request, {})->plan.status,
            PlanStatus::kGoalBlocked);
  request.plan.goal_m.x() = 12.0;
  EXPECT_EQ(plan_with_cost(world_of({}), request, {})->plan.status, PlanStatus::kOutOfBounds);
  EXPECT_FALSE(plan_with_cost(world_of({}), request_of("boa", "cheapest"), {}).ok());
  EXPECT_FALSE(plan_with_cost(world_of({}), request_of("bees", "BOA"), {}).ok());
  EXPECT_FALSE(plan_with_cost(nullptr, request_of("boa", "BOA"), {}).ok());
  request = request_of("boa", "BOA");
  request.cost.weights = {{"length", -1.0}};
  EXPECT_FALSE(plan_with_cost(world_of({}), request, {}).ok());
}

/// Christmas Island as SPSO's public code has it: its cost, its sampling; median 4739, best 4684 for that
/// code.
TEST(PresetPlan, BeatsThePublicCodeOnItsOwnIsland) {
  const char* folder = std::getenv("SWALLOWTAIL_DATA");
  const std::filesystem::path data = folder != nullptr
                                         ? std::filesystem::path(folder)
                                         : std::filesystem::path(SWALLOWTAIL_SOURCE_DIR) / "../shared/data";
  const std::filesystem::path file = data / "terrain/scenarios/spso_demo.txt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const auto scene = read_public_scene(file.string());
  ASSERT_TRUE(scene) << scene.error().message;
  PricedRequest request;
  request.plan.start_m = *scene->scenario.start_m;
  request.plan.goal_m = *scene->scenario.goal_m;
  request.plan.limits = scene->scenario.vehicle.limits;
  request.plan.params.waypoints = scene->scenario.planning.waypoints;
  request.cost.preset = scene->scenario.planning.cost;
  request.cost.altitude = {scene->scenario.planning.altitude_m->x(),
                           scene->scenario.planning.altitude_m->y()};
  std::vector<double> costs;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    request.plan.seed = seed;
    const auto report = plan_with_cost(scene->world, request, {.max_evaluations = 50'000}).value();
    EXPECT_EQ(report.plan.status, PlanStatus::kCertified) << "seed " << seed;
    costs.push_back(report.terms.total);
  }
  std::ranges::sort(costs);
  EXPECT_LE(costs[4], 4690.0);
}

}  // namespace
}  // namespace swallowtail::planner
