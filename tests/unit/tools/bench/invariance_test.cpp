#include "tools/bench/plan/invariance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/rng.hpp"
#include "tools/bench/plan/judge.hpp"

namespace swallowtail::bench {
namespace {

const Placement kMoved{"moved", 0.7, 3.0, Vec3(100, -50, 20)};

TEST(Placement, MovesWhatIsFreeToWhatIsFree) {
  const PlanCase scene = free_standing_case(3);
  const PlanCase moved = placed(scene, kMoved);
  const Judge judge(scene);
  const Judge moved_judge(moved);
  EXPECT_FALSE(judge.free(scene.start_m, scene.goal_m)) << "the straight line must be blocked";
  EXPECT_NEAR(moved.distance_m(), 3.0 * scene.distance_m(), 1e-9);
  Rng rng(1);
  int free = 0;
  for (int i = 0; i < 200; ++i) {
    const auto point = [&rng] { return Vec3(rng.uniform(-5, 35), rng.uniform(-5, 30), rng.uniform(-8, 14)); };
    const Vec3 a = point();
    const Vec3 b = point();
    const bool is_free = judge.free(a, b);
    EXPECT_EQ(is_free, moved_judge.free(kMoved(a), kMoved(b)));
    free += is_free ? 1 : 0;
  }
  EXPECT_GT(free, 20);
  EXPECT_LT(free, 180);
}

/// A planner that goes round by `detour_m`, whatever the size of the scene, plus a little by the seed.
Subject detouring(const std::string& name, double detour_share, double detour_m) {
  return {name, "optimiser", [=](const PlanCase& c, std::uint64_t seed, const RunLimit&) {
            const double jitter = 0.05 * Rng(seed).uniform();
            const double height_m = (detour_share + jitter) * c.distance_m() + detour_m;
            PlanRun run;
            run.path_m = {c.start_m, 0.5 * (c.start_m + c.goal_m) + Vec3(0, 0, height_m), c.goal_m};
            return run;
          }};
}

TEST(Invariance, ToldApartFromItsAbsence) {
  cli::Progress progress("test", cli::Progress::Show::kNo);
  Schedule schedule;
  schedule.runs = 60;
  const Invariance good = measure_invariance({detouring("by share", 0.8, 0.0)}, schedule, progress);
  for (const auto& row : good.table.rows) EXPECT_NE(row.back(), "DIFFERENT") << row[1];
  const Invariance bad = measure_invariance({detouring("by metres", 0.8, 8.0)}, schedule, progress);
  EXPECT_FALSE(bad.all_hold);
  int different = 0;
  for (const auto& row : bad.table.rows) different += row.back() == "DIFFERENT" ? 1 : 0;
  EXPECT_EQ(different, 2) << "both placements that scale";
}

}  // namespace
}  // namespace swallowtail::bench
