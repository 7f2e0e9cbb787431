#include "qos/participant/signals.hpp"

#include <gtest/gtest.h>

#include <csignal>

#include "planner/base/clock.hpp"
#include "qos/participant/run_loop.hpp"

namespace swallowtail {
namespace {

TEST(StopSignals, AFirstSignalSetsTheFlag) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const StopSignals stop;
    EXPECT_FALSE(stop.requested());
    std::raise(signal);
    EXPECT_TRUE(stop.requested());
    EXPECT_TRUE(stop.flag().load());
  }
}

TEST(StopSignals, WakeAWaiterAtOnce) {
  const StopSignals stop;
  const SteadyClock clock;
  std::raise(SIGTERM);
  const double before_s = clock.now_s();
  EXPECT_TRUE(stop.wait_for(30.0));
  EXPECT_LT(clock.now_s() - before_s, 5.0);
}

TEST(StopSignals, AWaitThatIsOverSaysSo) {
  const StopSignals stop;
  EXPECT_FALSE(stop.wait_for(0.001));
  EXPECT_FALSE(stop.wait_for(-1.0));
}

TEST(StopSignalsDeathTest, TheSecondEndsTheProcessAtOnce) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const StopSignals stop;
        std::raise(SIGINT);
        std::raise(SIGINT);
      },
      testing::ExitedWithCode(130), "");
}

TEST(StopSignals, LeaveTheOldHandlersBehind) {
  { const StopSignals stop; }
  EXPECT_EXIT(std::raise(SIGTERM), testing::KilledBySignal(SIGTERM), "");
}

TEST(RunLoop, EndsWhenTheStepSaysSo) {
  const StopSignals stop;
  int calls = 0;
  run_loop(stop, 0.0001, [&] { return ++calls < 5; });
  EXPECT_EQ(calls, 5);
}

TEST(RunLoop, EndsOnASignal) {
  const StopSignals stop;
  int calls = 0;
  run_loop(stop, 30.0, [&] {
    ++calls;
    std::raise(SIGINT);
    return true;
  });
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace swallowtail
