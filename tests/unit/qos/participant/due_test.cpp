#include "qos/participant/due.hpp"

#include <gtest/gtest.h>

namespace swallowtail {
namespace {

TEST(Due, IsTrueOncePerPeriod) {
  Due due(0.5);
  EXPECT_TRUE(due(0.0));
  EXPECT_FALSE(due(0.49));
  EXPECT_TRUE(due(0.5));
  EXPECT_TRUE(due(3.0));
  EXPECT_FALSE(due(3.0));
  due.put_off(3.4);
  EXPECT_FALSE(due(3.8));
  EXPECT_TRUE(due(3.9));
}

TEST(Due, KeepsItsPeriodOnAverageWhenAskedAtOddTimes) {
  Due due(0.05);
  int times = 0;
  for (int i = 0; i < 500; ++i) times += due(0.02 * i) ? 1 : 0;
  EXPECT_NEAR(times, 200, 1);
}

}  // namespace
}  // namespace swallowtail
