#include <gtest/gtest.h>

#include "planner/replan/replanner.hpp"
#include "tests/unit/planner/replan/random_worlds.hpp"

namespace swallowtail::planner {
namespace {

using random_worlds::Scene;
using random_worlds::SceneOptions;

constexpr std::uint64_t kBudget = 30000;

struct Tally {
  int certified = 0;
  int contingency = 0;
  int none = 0;
};

/// Whatever is returned passes the dense check, and the work stays within the budget.
Tally run(const SceneOptions& options, int worlds) {
  Tally tally;
  for (int seed = 1; seed <= worlds; ++seed) {
    const Scene scene = random_worlds::make_scene(static_cast<std::uint64_t>(seed), options);
    EXPECT_NE(scene.world, nullptr);
    const VehicleLimits limits;
    Replanner replanner(limits, {});
    ReplanRequest request;
    request.start_m = scene.start;
    request.start_time_s = 10.0;
    request.route = scene.route;
    const ReplanReport report = replanner.plan(scene.world, request, {.max_evaluations = kBudget});
    EXPECT_LE(report.evaluations, kBudget + 100) << "seed " << seed;
    tally.certified += report.verdict == Verdict::kCertified ? 1 : 0;
    tally.contingency += report.verdict == Verdict::kContingency ? 1 : 0;
    tally.none += report.verdict == Verdict::kNoSafePath ? 1 : 0;
    if (report.verdict == Verdict::kNoSafePath) {
      EXPECT_TRUE(report.path.empty());
      continue;
    }
    EXPECT_TRUE(report.certificate.certified);
    EXPECT_EQ(random_worlds::dense_check(report.path, *scene.world, limits), "")
        << "seed " << seed << ": " << report.reason;
    std::uint32_t leg = 0;
    for (const TimedWaypoint& w : report.path) {
      if (w.phase != Phase::kCover) continue;
      EXPECT_GE(w.leg_index, leg) << "seed " << seed << ": legs in order";
      EXPECT_LE(w.leg_index, leg + 1) << "seed " << seed << ": no leg is lost";
      leg = w.leg_index;
    }
  }
  return tally;
}

TEST(ReplannerProperty, StandingObstacles) {
  const Tally tally = run({.standing = 10, .moving = 0}, 60);
  EXPECT_GE(tally.certified, 58);
}

TEST(ReplannerProperty, StandingAndMovingObstacles) {
  const Tally tally = run({.standing = 5, .moving = 5}, 60);
  EXPECT_GE(tally.certified, 56);
}

TEST(ReplannerProperty, CrowdedWorlds) {
  const Tally tally = run({.strips = 6, .standing = 20, .moving = 10}, 30);
  EXPECT_EQ(tally.certified + tally.contingency + tally.none, 30);
}

TEST(ReplannerProperty, TheSameRequestsGiveTheSameAnswers) {
  const Scene scene = random_worlds::make_scene(3, {.standing = 8, .moving = 3});
  const auto answer = [&] {
    Replanner replanner(VehicleLimits{}, {});
    ReplanRequest request{.start_m = scene.start, .start_time_s = 10.0, .route = scene.route};
    replanner.plan(scene.world, request, {.max_evaluations = kBudget});
    return replanner.plan(scene.world, request, {.max_evaluations = kBudget});
  };
  const ReplanReport a = answer();
  const ReplanReport b = answer();
  ASSERT_EQ(a.path.size(), b.path.size());
  for (std::size_t i = 0; i < a.path.size(); ++i) {
    ASSERT_EQ(a.path[i].position_m, b.path[i].position_m);
    ASSERT_EQ(a.path[i].time_s, b.path[i].time_s);
  }
  EXPECT_EQ(a.evaluations, b.evaluations);
}

}  // namespace
}  // namespace swallowtail::planner
