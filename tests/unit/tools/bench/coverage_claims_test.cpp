#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "tools/bench/seeds/coverage_cells.hpp"
#include "tools/bench/seeds/coverage_experiments.hpp"
#include "tools/bench/seeds/coverage_trial.hpp"

namespace swallowtail::bench {
namespace {

const std::vector<StripLine> kStrips{{Vec2(0, 0), Vec2(60, 0)},
                                     {Vec2(0, 10), Vec2(60, 10)},
                                     {Vec2(0, 20), Vec2(90, 20)},
                                     {Vec2(0, 30), Vec2(60, 30)}};

TEST(CoverageCells, DrawnHeightsKeepTheStrips) {
  bool any_cut = false;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto cells = drawn_cells(kStrips, seed);
    double length_m = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      EXPECT_EQ(cells[i].id, i);
      EXPECT_EQ(cells[i].alpha_m.z(), cells[i].height_m);
      EXPECT_GE(cells[i].height_m, 2.0);
      EXPECT_LE(cells[i].height_m, 10.0);
      length_m += cells[i].length_m();
    }
    EXPECT_NEAR(length_m, 270.0, 1e-9);
    any_cut = any_cut || cells.size() > kStrips.size();
  }
  EXPECT_TRUE(any_cut);
  EXPECT_DOUBLE_EQ(longest_m(level_cells(kStrips, 5.0)), 95.0);
}

TEST(CoverageCells, ReadsTheParentsStripsAndNamesTheLineThatIsNone) {
  const auto file = std::filesystem::temp_directory_path() / "swallowtail_strips.txt";
  std::ofstream(file) << "1 2 1 3 4 1\n\n5 6 1 7 8 0\n";
  const auto strips = read_strips(file.string());
  ASSERT_TRUE(strips) << strips.error().message;
  ASSERT_EQ(strips->size(), 2U);
  EXPECT_EQ((*strips)[1].beta_m, Vec2(7, 8));
  std::ofstream(file) << "1 2 1 3 4 1\n5 6 1 7\n";
  const auto broken = read_strips(file.string());
  ASSERT_FALSE(broken);
  EXPECT_THAT(broken.error().message, ::testing::HasSubstr(":2:"));
  std::filesystem::remove(file);
}

TEST(CoverageTrial, ChargesOnlyWhereTheBatteryDoesNotLast) {
  const auto cells = level_cells(kStrips, 0.0);
  const CoverageTrial ample = run_coverage_trial(cells, {.d_max = 5000.0, .levels = 20}, 1);
  EXPECT_EQ(ample.recharges, 0);
  EXPECT_GT(ample.cost, 270.0);
  const CoverageTrial scarce = run_coverage_trial(cells, {.d_max = 150.0, .levels = 10}, 1);
  EXPECT_GE(scarce.recharges, 1);
  EXPECT_GT(scarce.cost, ample.cost);
  const CoverageTrial none = run_coverage_trial(cells, {.d_max = 80.0, .levels = 10}, 1);
  EXPECT_TRUE(std::isinf(none.cost)) << "one strip is 90 long";
}

std::vector<Row> battery_rows(double (*cost)(double units)) {
  std::vector<Row> rows;
  for (const double units : battery_sweep()) {
    for (const char* heights : {"with heights", "without heights"})
      rows.push_back({battery_subject(heights, units), "cov_battery, x", 1, "cost", cost(units), ""});
  }
  return rows;
}

TEST(CoverageClaims, JudgeTheCurveOverTheBattery) {
  const auto as_printed = coverage_claims(
      kCovBattery, battery_rows([](double units) {
        return units < 1.0 ? std::numeric_limits<double>::infinity() : units < 2.0 ? 2000.0 / units : 1000.0;
      }));
  ASSERT_EQ(as_printed.size(), 6U);
  for (const Claim& claim : as_printed) EXPECT_EQ(claim.verdict, Verdict::kReproduced) << claim.sentence;
  const auto otherwise =
      coverage_claims(kCovBattery, battery_rows([](double units) {
                        return units < 1.5 ? std::numeric_limits<double>::infinity() : 2000.0 - 100.0 * units;
                      }));
  for (const Claim& claim : otherwise) EXPECT_EQ(claim.verdict, Verdict::kNotReproduced) << claim.sentence;
}

TEST(CoverageClaims, NothingIsDecidedWithoutRuns) {
  for (const std::string& name : coverage_experiments()) {
    const std::vector<Row> other{{"nobody", name + ", x", 1, "cost", 1.0, ""}};
    const auto claims = coverage_claims(name, other);
    EXPECT_FALSE(claims.empty());
    for (const Claim& claim : claims) EXPECT_EQ(claim.verdict, Verdict::kNotDecidable) << claim.sentence;
  }
}

}  // namespace
}  // namespace swallowtail::bench
