#include "tools/bench/seeds/christmas_island.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace swallowtail::bench {
namespace {

planner::NavigationSpec spec() {
  planner::NavigationSpec out;
  out.segment_min_m = 10.0;
  out.height_min_m = 100.0;
  out.height_max_m = 200.0;
  out.threats = {{Vec2(500, 500), 50.0}};
  return out;
}

int broken(const std::vector<Vec3>& path) { return broken_limits(planner::Terrain::flat(5.0), spec(), path); }

TEST(BrokenLimits, CountsEachKind) {
  EXPECT_EQ(broken({Vec3(0, 0, 150), Vec3(100, 0, 150), Vec3(200, 50, 160)}), 0);
  EXPECT_EQ(broken({Vec3(0, 0, 150), Vec3(5, 0, 150)}), 1) << "a segment shorter than R_min";
  EXPECT_EQ(broken({Vec3(0, 0, 150), Vec3(200, 0, 104)}), 1)
      << "below the band, above the flat ground at 5 m";
  EXPECT_EQ(broken({Vec3(0, 0, 150), Vec3(200, 0, 206)}), 1) << "above the band";
  EXPECT_EQ(broken({Vec3(400, 450.5, 150), Vec3(600, 450.5, 150)}), 1) << "threat of 50 m and a drone of 1 m";
  EXPECT_EQ(broken({Vec3(400, 448.5, 150), Vec3(600, 448.5, 150)}), 0);
  EXPECT_EQ(broken({Vec3(0, 0, 150), Vec3(100, 0, 150), Vec3(100, 100, 150)}), 1) << "a turn of 90°";
  EXPECT_EQ(broken({Vec3(0, 0, 120), Vec3(50, 0, 180)}), 1) << "a climb of 50°";
  EXPECT_EQ(broken({Vec3(0, 0, 120), Vec3(70, 0, 180), Vec3(140, 0, 120)}), 1) << "a change of climb of 81°";
}

TEST(ChristmasIsland, EachClaimIsJudgedByWhatWasMeasured) {
  std::vector<Row> rows;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    rows.push_back({"nmopso", kNmopsoIsland, seed, "breaking_a_limit", 0.0, "members"});
    rows.push_back({"nmopso-seed", kNmopsoIsland, seed, "breaking_a_limit", 2.0, "members"});
  }
  int reproduced = 0;
  int refuted = 0;
  for (const Claim& claim : island_claims(kNmopsoIsland, rows)) {
    reproduced += claim.verdict == Verdict::kReproduced ? 1 : 0;
    refuted += claim.verdict == Verdict::kNotReproduced ? 1 : 0;
  }
  EXPECT_EQ(reproduced, 1);
  EXPECT_EQ(refuted, 1);
}

TEST(ChristmasIsland, RunsOnItsTerrain) {
  const auto nmopso = island_file(kNmopsoIsland);
  const auto spso = island_file(kSpsoIsland);
  if (!nmopso || !spso) GTEST_SKIP() << "no real data: set SWALLOWTAIL_DATA";
  cli::Progress progress("test", cli::Progress::Show::kNo);
  SeedsSchedule schedule;
  schedule.runs = 1;
  schedule.iterations_most = 3;
  Report report;
  const auto fronts = run_nmopso_island(*nmopso, schedule, progress, report);
  ASSERT_TRUE(fronts) << fronts.error().message;
  EXPECT_EQ(values_of(*fronts, "nmopso", kNmopsoIsland, "breaking_a_limit"), (std::vector<double>{0.0}));
  const auto costs = run_spso_island(*spso, schedule, progress, report);
  ASSERT_TRUE(costs) << costs.error().message;
  EXPECT_EQ(values_of(*costs, "pso-seed", kSpsoIsland, "cost").size(), 1U);
  EXPECT_EQ(report.tables.size(), 2U);
}

}  // namespace
}  // namespace swallowtail::bench
