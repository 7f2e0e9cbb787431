#include "qos/participant/mission_time.hpp"

#include <gtest/gtest.h>

#include "planner/base/clock.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail {
namespace {

using data::ClockState;

TEST(MissionTime, IsZeroAndWaitingBeforeTheFirstSample) {
  const MissionTime time;
  EXPECT_EQ(time.now_s(123.0), 0.0);
  EXPECT_EQ(time.state(), ClockState::kWaiting);
  EXPECT_FALSE(time.running());
  EXPECT_EQ(time.rate(), 1.0);
}

TEST(MissionTime, StandsStillWhileWaiting) {
  MissionTime time;
  time.update({.time_s = 4.0, .rate = 20.0, .state = ClockState::kWaiting}, 10.0);
  EXPECT_EQ(time.now_s(10.5), 4.0);
}

TEST(MissionTime, RunsOnAtTheRateBetweenSamples) {
  ManualClock wall;
  wall.advance(50.0);
  MissionTime time;
  time.update({.time_s = 100.0, .rate = 20.0, .state = ClockState::kRunning}, wall.now_s());
  wall.advance(0.05);
  EXPECT_NEAR(time.now_s(wall.now_s()), 101.0, 1e-9);
}

TEST(MissionTime, StandsStillWhenTheClockFallsSilent) {
  MissionTime time;
  time.update({.time_s = 10.0, .rate = 2.0, .state = ClockState::kRunning}, 0.0);
  EXPECT_NEAR(time.now_s(30.0), 10.0 + 2.0 * MissionTime::kCoast_s, 1e-9);
}

TEST(MissionTime, StopsAtTheEnd) {
  MissionTime time;
  time.update({.time_s = 10.0, .rate = 2.0, .state = ClockState::kRunning}, 0.0);
  time.update({.time_s = 10.2, .rate = 2.0, .state = ClockState::kEnded}, 0.1);
  EXPECT_TRUE(time.ended());
  EXPECT_NEAR(time.now_s(0.9), 10.2, 1e-9);
}

TEST(MissionTime, FollowsAMissionThatStartsAnew) {
  MissionTime time;
  time.update({.time_s = 500.0, .rate = 1.0, .state = ClockState::kRunning}, 0.0);
  EXPECT_NEAR(time.now_s(0.0), 500.0, 1e-9);
  time.update({.time_s = 0.0, .rate = 1.0, .state = ClockState::kWaiting}, 1.0);
  EXPECT_EQ(time.now_s(1.0), 0.0);
}

TEST(MissionTime, NeverGoesBackHoweverLateSamplesAre) {
  constexpr std::uint64_t kSeed = 7;
  SCOPED_TRACE(kSeed);
  Rng rng(kSeed);
  MissionTime time;
  double before_s = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    const double wall_s = 0.05 * i;
    const double late_s = rng.uniform(0.0, 0.04);
    time.update({.time_s = 20.0 * wall_s, .rate = 20.0, .state = ClockState::kRunning}, wall_s + late_s);
    const double now_s = time.now_s(wall_s + late_s + rng.uniform(0.0, 0.01));
    ASSERT_GE(now_s, before_s);
    ASSERT_NEAR(now_s, 20.0 * wall_s, 20.0 * 0.1);
    before_s = now_s;
  }
}

}  // namespace
}  // namespace swallowtail
