#include "tools/sim/referee.hpp"

#include <gtest/gtest.h>

namespace swallowtail::sim {
namespace {

Motion standing(double time_s, std::uint32_t legs_done) {
  Motion motion;
  motion.time_s = time_s;
  motion.legs_done = legs_done;
  return motion;
}

TEST(Referee, CompletesACoverageOnceAllIsFlownAndItStands) {
  Referee referee({.goal_m = {}, .grace_s = 5.0});
  EXPECT_FALSE(referee.judge(standing(1.0, 0), 50.0));
  referee.see_plan({.revision = 1, .legs_total = 3, .complete = true, .reason = ""});
  EXPECT_FALSE(referee.judge(standing(2.0, 2), 50.0));
  EXPECT_FALSE(referee.judge(standing(10.0, 3), 50.0));
  EXPECT_FALSE(referee.judge(standing(14.9, 3), 50.0));
  const auto outcome = referee.judge(standing(15.0, 3), 50.0);
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(outcome->completed);
  EXPECT_EQ(outcome->reason, "completed");
}

TEST(Referee, GoesOnWhenALegIsAddedInTheGrace) {
  Referee referee({.goal_m = {}, .grace_s = 5.0});
  referee.see_plan({.revision = 1, .legs_total = 3, .complete = true, .reason = ""});
  EXPECT_FALSE(referee.judge(standing(10.0, 3), 50.0));
  referee.see_plan({.revision = 2, .legs_total = 4, .complete = true, .reason = "a gap"});
  EXPECT_FALSE(referee.judge(standing(16.0, 3), 50.0));
  EXPECT_FALSE(referee.judge(standing(20.0, 4), 50.0));
  EXPECT_TRUE(referee.judge(standing(25.0, 4), 50.0));
}

TEST(Referee, DoesNotCompleteAloft) {
  Referee referee({.goal_m = {}, .grace_s = 5.0});
  referee.see_plan({.revision = 1, .legs_total = 1, .complete = true, .reason = ""});
  Motion motion = standing(10.0, 1);
  motion.mode = data::VehicleMode::kHolding;
  EXPECT_FALSE(referee.judge(motion, 50.0));
  motion.time_s = 100.0;
  EXPECT_FALSE(referee.judge(motion, 50.0));
}

TEST(Referee, SaysWhatAPlanLeavesOut) {
  Referee referee({.goal_m = {}, .grace_s = 5.0});
  referee.see_plan({.revision = 1, .legs_total = 1, .complete = false, .reason = "field 2 is too far"});
  EXPECT_FALSE(referee.judge(standing(10.0, 1), 50.0));
  EXPECT_FALSE(referee.judge(standing(30.0, 1), 50.0));
  const auto outcome = referee.judge(standing(10.0 + 5.0 + Referee::kIncomplete_s, 1), 50.0);
  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome->completed);
  EXPECT_NE(outcome->reason.find("field 2 is too far"), std::string::npos);
}

TEST(Referee, CompletesAGoalWhereItRests) {
  Referee referee({.goal_m = Vec3(10, 0, 20)});
  Motion motion = standing(1.0, 0);
  motion.mode = data::VehicleMode::kTransfer;
  motion.position_m = Vec3(9.5, 0, 20);
  motion.velocity_mps = Vec3(8, 0, 0);
  EXPECT_FALSE(referee.judge(motion, 1.0)) << "passing by";
  motion.mode = data::VehicleMode::kHolding;
  motion.velocity_mps = Vec3::Zero();
  const auto outcome = referee.judge(motion, 1.0);
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(outcome->completed);
}

TEST(Referee, FailsOnAnEmptyBatteryAloftButNotOnTheGround) {
  Referee referee({});
  EXPECT_FALSE(referee.judge(standing(1.0, 0), 0.0));
  Motion motion = standing(2.0, 0);
  motion.mode = data::VehicleMode::kCovering;
  const auto outcome = referee.judge(motion, 0.0);
  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome->completed);
  EXPECT_NE(outcome->reason.find("battery"), std::string::npos);
}

TEST(Referee, FailsWhenThereIsNoSafePathForLong) {
  Referee referee({});
  referee.see_verdict(data::PathVerdict::kNoSafePath, 10.0);
  referee.see_verdict(data::PathVerdict::kNoSafePath, 100.0);
  EXPECT_FALSE(referee.judge(standing(130.0, 0), 1.0));
  EXPECT_TRUE(referee.judge(standing(130.1, 0), 1.0));
  referee.see_verdict(data::PathVerdict::kContingency, 130.0);
  EXPECT_FALSE(referee.judge(standing(300.0, 0), 1.0));
}

TEST(Referee, FailsAtItsTimeLimitAndWhenNothingHappens) {
  Referee limited({.goal_m = {}, .max_time_s = 60.0});
  EXPECT_FALSE(limited.judge(standing(59.9, 0), 1.0));
  EXPECT_TRUE(limited.judge(standing(60.0, 0), 1.0));
  Referee patient({});
  EXPECT_FALSE(patient.judge(standing(Referee::kStuck_s - 1, 0), 10.0));
  EXPECT_FALSE(patient.judge(standing(Referee::kStuck_s, 0), 30.0)) << "it is being charged";
  EXPECT_FALSE(patient.judge(standing(2 * Referee::kStuck_s - 1, 0), 30.0));
  EXPECT_TRUE(patient.judge(standing(2 * Referee::kStuck_s + 1, 0), 30.0));
}

}  // namespace
}  // namespace swallowtail::sim
