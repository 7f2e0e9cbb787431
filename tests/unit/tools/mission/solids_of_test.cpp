#include "tools/mission/check/solids_of.hpp"

#include <gtest/gtest.h>

#include "tools/mission/check/distance.hpp"

namespace swallowtail::check {
namespace {

planner::Obstacle ball(std::uint32_t id) {
  planner::Obstacle o;
  o.id = id;
  o.shape = planner::Sphere{2.0};
  o.position_m = Vec3(10, 0, 0);
  return o;
}

TEST(SolidsOf, AppearsMovesVanishes) {
  planner::Scenario scenario;
  planner::Obstacle late = ball(7);
  late.state_time_s = 5.0;
  scenario.events.push_back({5.0, planner::ObstacleAppears{late}});
  scenario.events.push_back({8.0, planner::ObstacleMoves{7, Vec3(1, 0, 0)}});
  scenario.events.push_back({20.0, planner::ObstacleVanishes{7}});
  const auto solids = solids_of(scenario);
  ASSERT_EQ(solids.size(), 2U);
  EXPECT_DOUBLE_EQ(solids[0].appears_s, 5.0);
  EXPECT_DOUBLE_EQ(solids[0].vanishes_s, 8.0);
  EXPECT_DOUBLE_EQ(solids[1].appears_s, 8.0);
  EXPECT_DOUBLE_EQ(solids[1].vanishes_s, 20.0);
  EXPECT_DOUBLE_EQ(distance_m(solids[1], {22, 0, 0}, 18.0), 0.0);
}

TEST(SolidsOf, ValidityEndsIt) {
  planner::Scenario scenario;
  planner::Obstacle short_lived = ball(3);
  short_lived.valid_until_s = 12.0;
  scenario.obstacles = {short_lived};
  EXPECT_DOUBLE_EQ(solids_of(scenario).at(0).vanishes_s, 12.0);
}

}  // namespace
}  // namespace swallowtail::check
