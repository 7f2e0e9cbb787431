#include "tools/bench/seeds/claims.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "planner/base/rng.hpp"
#include "tools/bench/seeds/experiment.hpp"
#include "tools/bench/seeds/run.hpp"

namespace swallowtail::bench {
namespace {

const std::string kData = std::string(SWALLOWTAIL_SOURCE_DIR) + "/tests/data/bench";

std::vector<Row> rows_around(const std::string& subject, double center, std::uint64_t seed) {
  Rng rng(seed);
  std::vector<Row> rows;
  for (std::uint64_t i = 0; i < 30; ++i) rows.push_back({subject, "e", i, "cost", center + rng.normal(), ""});
  return rows;
}

std::vector<Row> joined(std::vector<Row> a, const std::vector<Row>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Claims, LowerNeedsSignificanceAndTheRightSign) {
  const auto rows =
      joined(joined(rows_around("low", 10, 1), rows_around("high", 13, 2)), rows_around("same", 10, 3));
  EXPECT_EQ(lower_than(rows, "e", "cost", "low", {"high"}).verdict, Verdict::kReproduced);
  EXPECT_EQ(lower_than(rows, "e", "cost", "high", {"low"}).verdict, Verdict::kNotReproduced);
  EXPECT_EQ(lower_than(rows, "e", "cost", "low", {"same"}).verdict, Verdict::kNotReproduced);
  EXPECT_EQ(lower_than(rows, "e", "cost", "low", {"high", "same"}).verdict, Verdict::kNotReproduced);
  EXPECT_EQ(lower_than(rows, "e", "cost", "low", {"nobody"}).verdict, Verdict::kNotDecidable);
}

TEST(Claims, ReachingAValueNeedsTheWholeInterval) {
  const auto rows = rows_around("s", 10, 5);
  EXPECT_EQ(reaches(rows, "e", "cost", "s", 12.0).verdict, Verdict::kReproduced);
  EXPECT_EQ(reaches(rows, "e", "cost", "s", 9.0).verdict, Verdict::kNotReproduced);
  EXPECT_EQ(reaches(rows, "e", "cost", "nobody", 9.0).verdict, Verdict::kNotDecidable);
}

TEST(Experiments, EachHasItsSceneItsAlgorithmsAndItsClaims) {
  for (const Experiment& experiment : experiments()) {
    const auto scene = load_case(kData + "/seeds/" + experiment.name + ".yaml");
    ASSERT_TRUE(scene) << scene.error().message;
    std::vector<Row> rows;
    for (const std::string& algorithm : experiment.algorithms) {
      const auto trial = run_trial(*scene, experiment.preset, algorithm, {10, scene->waypoints, 3}, 1);
      ASSERT_TRUE(trial) << experiment.name << ", " << algorithm << ": " << trial.error().message;
      EXPECT_LE(trial->settled, 3U);
      EXPECT_GT(trial->cost, 0.0);
      EXPECT_GE(trial->evaluations, 10U);
    }
    const auto claims = claims_of(experiment.name, rows);
    EXPECT_FALSE(claims.empty()) << experiment.name;
    for (const Claim& claim : claims) {
      EXPECT_EQ(claim.verdict, Verdict::kNotDecidable) << "nothing was run";
      EXPECT_THAT(claim.source, ::testing::Not(::testing::IsEmpty()));
      EXPECT_THAT(claim.sentence, ::testing::Not(::testing::IsEmpty()));
      EXPECT_THAT(claim.evidence, ::testing::Not(::testing::IsEmpty()));
    }
  }
}

TEST(Experiments, TrialsDependOnTheSeedAlone) {
  const auto scene = load_case(kData + "/seeds/pso_five.yaml");
  ASSERT_TRUE(scene);
  const auto cost = [&](std::uint64_t seed) {
    return run_trial(*scene, "PSO", "pso-seed", {20, 3, 10}, seed)->cost;
  };
  EXPECT_EQ(cost(4), cost(4));
  EXPECT_NE(cost(4), cost(5));
}

TEST(GreedySetting, KeepsWhatIsBest) {
  const auto scene = load_case(kData + "/seeds/pso_five.yaml");
  ASSERT_TRUE(scene);
  const auto setting = greedy_setting(*scene, "PSO", "pso-seed", {{4, 60}, {3}, {1, 30}}, 1, 3);
  ASSERT_TRUE(setting) << setting.error().message;
  EXPECT_EQ(setting->population, 60);
  EXPECT_EQ(setting->iterations, 30);
}

}  // namespace
}  // namespace swallowtail::bench
