#include "tools/bench/core/statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace swallowtail::bench {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

TEST(Quartiles, InterpolateBetweenNeighbours) {
  // R: quantile(c(1, 2, 3, 4, 5, 6, 7, 8)), type 7.
  const Quartiles q = quartiles_of({8, 1, 7, 2, 6, 3, 5, 4});
  EXPECT_DOUBLE_EQ(q.min, 1.0);
  EXPECT_DOUBLE_EQ(q.lower, 2.75);
  EXPECT_DOUBLE_EQ(q.median, 4.5);
  EXPECT_DOUBLE_EQ(q.upper, 6.25);
  EXPECT_DOUBLE_EQ(q.max, 8.0);
  EXPECT_EQ(q.count, 8U);
}

TEST(Quartiles, NeverSortsLastAndSpoilsOnlyWhatItReaches) {
  const Quartiles q = quartiles_of({kNever, 1.0, 2.0, kNever, 3.0});
  EXPECT_DOUBLE_EQ(q.lower, 2.0);
  EXPECT_DOUBLE_EQ(q.median, 3.0);
  EXPECT_EQ(q.upper, kNever);
  EXPECT_EQ(quartiles_of({kNever, kNever}).median, kNever);
}

TEST(Quartiles, OfNothingAreZero) { EXPECT_EQ(quartiles_of({}).count, 0U); }

TEST(Bootstrap, CoversTheMedianAboutAsOftenAsItSays) {
  Rng rng(7);
  int covered = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> values(40);
    for (double& v : values) v = rng.normal();
    const Interval interval = bootstrap_median(values, 0.95, 300, rng);
    covered += interval.low <= 0.0 && interval.high >= 0.0 ? 1 : 0;
  }
  EXPECT_GE(covered, 178);  // 95 % of 200 less four standard deviations
  EXPECT_LE(covered, 199);
}

TEST(Bootstrap, IsTheSameForTheSameSeed) {
  const std::vector<double> values{3, 1, 4, 1, 5, 9, 2, 6};
  Rng one(3);
  Rng other(3);
  EXPECT_EQ(bootstrap_median(values, 0.9, 100, one).high, bootstrap_median(values, 0.9, 100, other).high);
}

// The example of SciPy's documentation of mannwhitneyu: ages at diagnosis of men and women; U = 17,
// p = 0.11134688653314041 by the normal approximation with continuity correction.
TEST(MannWhitney, GivesThePublishedFigures) {
  const RankTest test = mann_whitney({19, 22, 16, 29, 24}, {20, 11, 17, 12});
  EXPECT_DOUBLE_EQ(test.statistic, 17.0);
  EXPECT_NEAR(test.p_value, 0.11134688653314041, 1e-12);
}

// By hand: a = 1,2,2,3 and b = 2,3,3,4; pairs won by a: ties count a half, U_a = 3.5; groups of 3 and 3 ties.
TEST(MannWhitney, CountsTiesAsAHalf) {
  const RankTest test = mann_whitney({1, 2, 2, 3}, {2, 3, 3, 4});
  EXPECT_DOUBLE_EQ(test.statistic, 3.0);
  const double share = share_smaller({1, 2, 2, 3}, {2, 3, 3, 4});
  EXPECT_DOUBLE_EQ(share, 1.0 - 3.0 / 16.0);
}

TEST(MannWhitney, SeesNothingWhereAllIsOne) {
  EXPECT_DOUBLE_EQ(mann_whitney({5, 5, 5}, {5, 5}).p_value, 1.0);
  EXPECT_DOUBLE_EQ(mann_whitney({}, {5, 5}).p_value, 1.0);
  EXPECT_DOUBLE_EQ(mann_whitney({kNever, kNever}, {kNever}).p_value, 1.0);
}

TEST(MannWhitney, CallsFalseAlarmAboutAsOftenAsItSays) {
  Rng rng(11);
  int alarms = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<double> a(30);
    std::vector<double> b(30);
    for (double& v : a) v = rng.uniform();
    for (double& v : b) v = rng.uniform();
    alarms += mann_whitney(a, b).p_value < 0.05 ? 1 : 0;
  }
  EXPECT_GT(alarms, 25);
  EXPECT_LT(alarms, 75);
}

TEST(MannWhitney, SeesAShift) {
  Rng rng(12);
  std::vector<double> a(30);
  std::vector<double> b(30);
  for (double& v : a) v = rng.normal();
  for (double& v : b) v = rng.normal() + 1.5;
  EXPECT_LT(mann_whitney(a, b).p_value, 1e-3);
  EXPECT_GT(share_smaller(a, b), 0.75);
}

TEST(KolmogorovSmirnov, MeasuresTheGreatestDifference) {
  const RankTest test = kolmogorov_smirnov({1, 2, 3, 4}, {3, 4, 5, 6});
  EXPECT_DOUBLE_EQ(test.statistic, 0.5);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov({1, 1, 2}, {1, 1, 2}).statistic, 0.0);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov({1, 1, 2}, {1, 1, 2}).p_value, 1.0);
}

// The 5 % point of Kolmogorov's distribution is 1.3581, the 1 % point 1.6276 (any table of it).
TEST(KolmogorovSmirnov, HasTheTabulatedTail) {
  const auto p_at = [](double lambda) {
    const std::size_t n = 20000;  // so large that Stephens' correction does not matter
    std::vector<double> a(n);
    std::vector<double> b(n);
    const double difference = lambda / std::sqrt(static_cast<double>(n) / 2.0);
    for (std::size_t i = 0; i < n; ++i) {
      a[i] = static_cast<double>(i);
      b[i] = static_cast<double>(i) + std::round(difference * static_cast<double>(n));
    }
    return kolmogorov_smirnov(a, b).p_value;
  };
  EXPECT_NEAR(p_at(1.3581), 0.05, 2e-3);
  EXPECT_NEAR(p_at(1.6276), 0.01, 5e-4);
}

TEST(KolmogorovSmirnov, SeesASpreadThatRanksDoNot) {
  Rng rng(5);
  std::vector<double> narrow(200);
  std::vector<double> wide(200);
  for (double& v : narrow) v = rng.normal();
  for (double& v : wide) v = 4.0 * rng.normal();
  EXPECT_GT(mann_whitney(narrow, wide).p_value, 1e-3);
  EXPECT_LT(kolmogorov_smirnov(narrow, wide).p_value, 1e-6);
}

// The worked example of Holm's method: 0.01, 0.04, 0.03 → 0.03, 0.06, 0.06.
TEST(Holm, RaisesInOrder) {
  EXPECT_THAT(holm({0.01, 0.04, 0.03}),
              ::testing::ElementsAre(::testing::DoubleEq(0.03), ::testing::DoubleEq(0.06),
                                     ::testing::DoubleEq(0.06)));
  EXPECT_THAT(holm({0.6, 0.9}), ::testing::ElementsAre(1.0, 1.0));
}

TEST(Rounded, TakesNoiseAwayAndLeavesNever) {
  EXPECT_THAT(rounded({1.00000001, 0.99999999, kNever}, 1e-6), ::testing::ElementsAre(1.0, 1.0, kNever));
}

}  // namespace
}  // namespace swallowtail::bench
