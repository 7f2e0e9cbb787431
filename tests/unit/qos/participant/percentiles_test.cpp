#include "qos/participant/percentiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "planner/base/rng.hpp"

namespace swallowtail {
namespace {

TEST(Percentiles, AreZeroWhileEmpty) {
  const auto summary = Percentiles(8).summary();
  EXPECT_EQ(summary.p50, 0.0);
  EXPECT_EQ(summary.p99, 0.0);
  EXPECT_EQ(summary.max, 0.0);
  EXPECT_EQ(summary.count, 0U);
}

TEST(Percentiles, OneValueIsAllOfThem) {
  Percentiles percentiles(8);
  percentiles.add(3.5);
  const auto summary = percentiles.summary();
  EXPECT_EQ(summary.p50, 3.5);
  EXPECT_EQ(summary.p99, 3.5);
  EXPECT_EQ(summary.max, 3.5);
}

TEST(Percentiles, AreTheNearestRankOfASortedWindow) {
  constexpr std::uint64_t kSeed = 3;
  SCOPED_TRACE(kSeed);
  Rng rng(kSeed);
  Percentiles percentiles(100);
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) {
    values.push_back(rng.uniform(-5.0, 50.0));
    percentiles.add(values.back());
  }
  std::sort(values.begin(), values.end());
  EXPECT_EQ(percentiles.summary().p50, values[49]);
  EXPECT_EQ(percentiles.summary().p99, values[98]);
  EXPECT_EQ(percentiles.summary().max, values[99]);
}

TEST(Percentiles, ForgetOldValuesButNotTheGreatest) {
  Percentiles percentiles(10);
  percentiles.add(1000.0);
  for (int i = 0; i < 10; ++i) percentiles.add(1.0);
  const auto summary = percentiles.summary();
  EXPECT_EQ(summary.p99, 1.0);
  EXPECT_EQ(summary.max, 1000.0);
  EXPECT_EQ(summary.count, 11U);
}

TEST(Percentiles, LeaveOutWhatIsNotFinite) {
  Percentiles percentiles(4);
  percentiles.add(std::numeric_limits<double>::quiet_NaN());
  percentiles.add(std::numeric_limits<double>::infinity());
  EXPECT_EQ(percentiles.summary().count, 0U);
}

}  // namespace
}  // namespace swallowtail
