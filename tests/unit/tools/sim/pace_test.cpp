#include "tools/sim/pace.hpp"

#include <gtest/gtest.h>

namespace swallowtail::sim {
namespace {

TEST(Pace, OwesStepsAtTheRate) {
  Pace pace(20.0, 0.05);
  pace.start(100.0);
  EXPECT_EQ(pace.owed(100.0), 0U);
  std::uint64_t steps = 0;
  for (int i = 1; i <= 1000; ++i) steps += pace.owed(100.0 + 0.003 * i);
  EXPECT_EQ(steps, 1200U) << "3 s of wall time at 20 is 60 s of 0.05 s steps";
  EXPECT_EQ(pace.slipped_s(), 0.0);
}

TEST(Pace, SlipsRatherThanHurriesAfterAPause) {
  Pace pace(20.0, 0.05);
  pace.start(0.0);
  EXPECT_EQ(pace.owed(10.0), 100U);
  EXPECT_NEAR(pace.slipped_s(), (10.0 - Pace::kMostBehind_s) * 20.0, 1e-9);
  EXPECT_EQ(pace.owed(10.0), 0U);
}

TEST(Throttle, KeepsTheRateOverTime) {
  Throttle throttle(1.0 / 250.0);
  int allowed = 0;
  for (int i = 0; i < 10'000; ++i) allowed += throttle.allows(i * 1e-3) ? 1 : 0;
  EXPECT_NEAR(allowed, 2500, 15);
}

TEST(Throttle, LetsAShortBurstThrough) {
  Throttle throttle(0.01);
  int allowed = 0;
  for (int i = 0; i < 100; ++i) allowed += throttle.allows(5.0) ? 1 : 0;
  EXPECT_GE(allowed, 5);
  EXPECT_LE(allowed, 7);
}

}  // namespace
}  // namespace swallowtail::sim
