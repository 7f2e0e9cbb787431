#include "tools/bench/core/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace swallowtail::bench {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
const Curve kCurve{{1.0, 10, 1, 120.0}, {2.0, 20, 2, 104.0}, {8.0, 80, 8, 100.5}};

TEST(Convergence, FindsWhenAGapIsReached) {
  EXPECT_DOUBLE_EQ(effort_to(kCurve, Effort::kTime_ms, target_of(100.0, 0.05)), 2.0);
  EXPECT_DOUBLE_EQ(effort_to(kCurve, Effort::kEvaluations, target_of(100.0, 0.01)), 80.0);
  EXPECT_DOUBLE_EQ(effort_to(kCurve, Effort::kIterations, 120.0), 1.0);
  EXPECT_EQ(effort_to(kCurve, Effort::kTime_ms, target_of(100.0, 0.001)), kNever);
  EXPECT_EQ(effort_to({}, Effort::kTime_ms, 1e9), kNever);
}

TEST(Convergence, FindsWhatAnEffortBought) {
  EXPECT_EQ(value_after(kCurve, Effort::kTime_ms, 0.5), kNever);
  EXPECT_DOUBLE_EQ(value_after(kCurve, Effort::kTime_ms, 7.9), 104.0);
  EXPECT_DOUBLE_EQ(value_after(kCurve, Effort::kTime_ms, 100.0), 100.5);
}

TEST(Convergence, BandsHoldTheCurvesBetweenThem) {
  const Curve worse{{1.0, 10, 1, 200.0}, {10.0, 100, 10, 150.0}};
  const Band band = band_of({kCurve, worse}, Effort::kTime_ms, 5);
  ASSERT_EQ(band.effort.size(), 5U);
  EXPECT_DOUBLE_EQ(band.effort.front(), 1.0);
  EXPECT_DOUBLE_EQ(band.effort.back(), 10.0);
  EXPECT_NEAR(band.effort[2], std::sqrt(10.0), 1e-12);
  EXPECT_DOUBLE_EQ(band.median.front(), 160.0);
  EXPECT_DOUBLE_EQ(band.median.back(), 0.5 * (100.5 + 150.0));
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LE(band.lower[i], band.median[i]);
    EXPECT_LE(band.median[i], band.upper[i]);
  }
}

TEST(Convergence, OfNothingIsAnEmptyBand) {
  EXPECT_TRUE(band_of({}, Effort::kTime_ms, 5).effort.empty());
  EXPECT_TRUE(band_of({Curve{}}, Effort::kTime_ms, 5).effort.empty());
}

}  // namespace
}  // namespace swallowtail::bench
