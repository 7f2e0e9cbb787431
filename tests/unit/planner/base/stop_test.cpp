#include "planner/base/stop.hpp"

#include <gtest/gtest.h>

namespace swallowtail {
namespace {

TEST(StopCondition, NeverStopsByDefault) { EXPECT_FALSE(StopCondition{}.reached(1'000'000, 1'000'000)); }

TEST(StopCondition, StopsAtTheDeadline) {
  ManualClock clock;
  const StopCondition stop{.clock = &clock, .deadline_s = 2.0};
  clock.advance(1.9);
  EXPECT_FALSE(stop.reached(0, 0));
  clock.advance(0.1);
  EXPECT_TRUE(stop.reached(0, 0));
}

TEST(StopCondition, StopsWhenWorkIsUsedUpOrAsked) {
  std::atomic<bool> asked{false};
  const StopCondition stop{.max_evaluations = 10, .max_iterations = 3, .stop_requested = &asked};
  EXPECT_TRUE(stop.reached(10, 0));
  EXPECT_TRUE(stop.reached(0, 3));
  EXPECT_FALSE(stop.reached(9, 2));
  asked = true;
  EXPECT_TRUE(stop.reached(0, 0));
}

}  // namespace
}  // namespace swallowtail
