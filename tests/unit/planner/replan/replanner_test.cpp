#include "planner/replan/replanner.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "tests/unit/planner/replan/random_worlds.hpp"

namespace swallowtail::planner {
namespace {

constexpr std::uint64_t kBudget = 20000;

Obstacle ball(std::uint32_t id, const Vec3& at, double radius, const Vec3& velocity = Vec3::Zero()) {
  return {.id = id, .shape = Sphere{radius}, .position_m = at, .velocity_mps = velocity};
}

std::shared_ptr<const World> world_of(std::vector<Obstacle> obstacles) {
  return *World::make(Terrain::flat(0.0), std::move(obstacles),
                      Bounds{Vec3(-200, -200, -1), Vec3(200, 300, 100)});
}

/// One strip of 100 m northwards, then one back.
ReplanRequest two_strips() {
  ReplanRequest request;
  request.start_m = Vec3(0, 0, 20);
  request.route = {{Vec3(0, 100, 20), Phase::kCover, 0, 0.0},
                   {Vec3(10, 100, 20), Phase::kTransfer, 1, 0.0},
                   {Vec3(10, 0, 20), Phase::kCover, 1, 0.0},
                   {Vec3(10, 0, 0), Phase::kLanding, 1, 0.0}};
  return request;
}

ReplanReport plan(const std::shared_ptr<const World>& world, const ReplanRequest& request) {
  Replanner replanner(VehicleLimits{}, {});
  const ReplanReport report = replanner.plan(world, request, {.max_evaluations = kBudget});
  if (report.verdict != Verdict::kNoSafePath) {
    EXPECT_EQ(random_worlds::dense_check(report.path, *world, VehicleLimits{}), "") << report.reason;
    EXPECT_TRUE(report.certificate.certified);
  }
  return report;
}

TEST(Replanner, LeavesAClearRouteAlone) {
  const ReplanReport report = plan(world_of({}), two_strips());
  EXPECT_EQ(report.verdict, Verdict::kCertified);
  EXPECT_EQ(report.reason, "route is clear");
  EXPECT_TRUE(report.lands);
  EXPECT_NEAR(length_m(report.path), 230.0, 1e-9);
}

/// A no-fly area, with a ball beside it that leaves no room between at the height flown.
TEST(Replanner, PassesATallPrismAtTheHeightFlown) {
  double longest = 0.0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Rng rng(seed);
    const double radius_m = rng.uniform(3.0, 12.0);
    ConvexMesh prism;
    for (const double z : {-10.0, 1000.0}) {
      for (int k = 0; k < 6; ++k) {
        const double angle = std::numbers::pi * k / 3.0;
        prism.vertices_m.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), z);
      }
    }
    const double ball_m = rng.uniform(2.0, 4.0);
    std::vector<Obstacle> obstacles{
        {.id = 1, .shape = prism, .position_m = Vec3(rng.uniform(-8, 8), 40, 0)},
        ball(2, Vec3(radius_m + ball_m + rng.uniform(0.0, 5.0), 40, rng.uniform(4.0, 8.0)), ball_m)};
    const auto world =
        *World::make(Terrain::flat(0.0), obstacles, Bounds{Vec3(-1e6, -1e6, -1e3), Vec3(1e6, 1e6, 1e3)});
    ReplanRequest request;
    request.start_m = Vec3(0, 0, 6.4);
    request.route = {{Vec3(rng.uniform(-5, 5), 80, 6.4), Phase::kTransfer, 0, 0.0}};
    const ReplanReport report = plan(world, request);
    ASSERT_EQ(report.verdict, Verdict::kCertified) << "seed " << seed << ": " << report.reason;
    longest = std::max(longest, length_m(report.path));
    EXPECT_LE(length_m(report.path), 160.0) << "seed " << seed;
  }
  RecordProperty("longest_m", std::to_string(longest));
}

TEST(Replanner, StopsFirstWhereADetourAtTheStartTurnsBack) {
  // It flies east beside a ball and is to go west, through it: the way round begins where it is.
  int stops = 0;
  for (const double off_m : {5.51, 5.6, 5.8, 6.0, 6.5}) {
    ReplanRequest request;
    request.start_m = Vec3(off_m, 0, 20);
    request.start_velocity_mps = Vec3(6, 0, 0);
    request.route = {{Vec3(-60, 0, 20), Phase::kTransfer, 0, 0.0}};
    const ReplanReport report = plan(world_of({ball(5, Vec3(0, 0, 20), 3)}), request);
    ASSERT_NE(report.verdict, Verdict::kNoSafePath) << off_m;
    std::size_t first = 1;
    while (first < report.path.size() &&
           (report.path[first].position_m - request.start_m).norm() <= kSamePlace_m)
      ++first;
    if (first == report.path.size()) continue;
    const double stood_s = report.path[first - 1].time_s - report.path.front().time_s;
    const Vec3 direction = (report.path[first].position_m - request.start_m).normalized();
    const bool turns = direction.dot(Vec3::UnitX()) < std::cos(VehicleLimits{}.turn_max_rad);
    EXPECT_TRUE(!turns || stood_s >= kStopToTurn_s) << off_m << ": " << direction.transpose();
    stops += turns ? 1 : 0;
  }
  EXPECT_GT(stops, 0);
}

TEST(Replanner, GoesRoundAndRejoinsTheStripRightAfter) {
  const ReplanReport report = plan(world_of({ball(5, Vec3(0, 50, 20), 6)}), two_strips());
  ASSERT_EQ(report.verdict, Verdict::kCertified);
  EXPECT_EQ(report.detours, 1) << "the strip back passes it at 10 m";
  EXPECT_LT(report.skipped_cover_m, 60.0);
  bool on_strip_again = false;
  for (std::size_t i = 1; i < report.path.size(); ++i) {
    const TimedWaypoint& w = report.path[i];
    on_strip_again = on_strip_again || (w.phase == Phase::kCover && w.leg_index == 0 &&
                                        w.position_m.y() > 99.0 && report.path[i - 1].position_m.y() < 70.0);
  }
  EXPECT_TRUE(on_strip_again);
}

TEST(Replanner, WaitsOnAStripForWhatPasses) {
  // It crosses the strip when the aircraft gets there.
  const ReplanReport report =
      plan(world_of({ball(9, Vec3(-50, 60, 20), 4, Vec3(50.0 / 7.5, 0, 0))}), two_strips());
  ASSERT_EQ(report.verdict, Verdict::kCertified);
  EXPECT_GE(report.waits, 1);
  EXPECT_EQ(report.detours, 0);
  EXPECT_EQ(report.skipped_cover_m, 0.0);
  EXPECT_NE(report.reason.find("for obstacle 9"), std::string::npos) << report.reason;
}

TEST(Replanner, EvadesWhatComesAlongTheStrip) {
  const ReplanReport report = plan(world_of({ball(9, Vec3(0, 160, 20), 4, Vec3(0, -6, 0))}), two_strips());
  ASSERT_EQ(report.verdict, Verdict::kCertified) << report.reason;
  EXPECT_GE(report.detours, 1);
}

TEST(Replanner, SkipsAStripEntryThatIsBlocked) {
  const ReplanReport report = plan(world_of({ball(3, Vec3(10, 100, 20), 5)}), two_strips());
  ASSERT_EQ(report.verdict, Verdict::kCertified) << report.reason;
  EXPECT_NE(report.reason.find("skips"), std::string::npos) << report.reason;
  EXPECT_GT(report.skipped_cover_m, 5.0);
}

TEST(Replanner, HoldsWhereTheGoalIsBlocked) {
  const ReplanReport report = plan(world_of({ball(4, Vec3(10, 0, 8), 6)}), two_strips());
  ASSERT_EQ(report.verdict, Verdict::kContingency);
  EXPECT_NE(report.reason.find("obstacle 4"), std::string::npos) << report.reason;
  EXPECT_EQ(report.path.back().phase, Phase::kHold);
  EXPECT_FALSE(report.lands);
  EXPECT_GE(report.path.back().time_s - report.path[report.path.size() - 2].time_s, 5.0);
}

TEST(Replanner, DoesNotHoldWhereSomethingWillCome) {
  // The goal is walled in by a box that is there to stay; a ball sweeps the strip it would hold on.
  const Obstacle lid{.id = 4, .shape = Box{Vec3(30, 20, 19), 0.0}, .position_m = Vec3(10, 0, 9)};
  ReplanRequest request = two_strips();
  request.start_m = Vec3(0, 60, 20);
  const ReplanReport report = plan(world_of({lid, ball(6, Vec3(10, 140, 20), 6, Vec3(0, -2, 0))}), request);
  ASSERT_NE(report.verdict, Verdict::kNoSafePath) << report.reason;
}

TEST(Replanner, HasNoPathFromInsideAnObstacle) {
  const ReplanReport report = plan(world_of({ball(2, Vec3(0, 0, 20), 5)}), two_strips());
  EXPECT_EQ(report.verdict, Verdict::kNoSafePath);
  EXPECT_TRUE(report.path.empty());
  EXPECT_FALSE(report.reason.empty());
}

TEST(Replanner, StopsFirstIfTheTurnIsTooSharp) {
  ReplanRequest request = two_strips();
  request.start_velocity_mps = Vec3(0, -8, 0);
  const ReplanReport report = plan(world_of({}), request);
  ASSERT_EQ(report.verdict, Verdict::kCertified);
  EXPECT_EQ(report.path[1].position_m, request.start_m);
  EXPECT_GE(report.path[1].time_s - report.path[0].time_s +
                (report.path[2].position_m == request.start_m ? 1.0 : 0.0),
            kStopToTurn_s);
}

TEST(Replanner, FallsBackWhenThereIsNoTimeAtAll) {
  const std::atomic<bool> asked{true};
  const auto world = world_of({ball(5, Vec3(0, 50, 20), 6)});
  Replanner replanner(VehicleLimits{}, {});
  const ReplanReport report = replanner.plan(world, two_strips(), {.stop_requested = &asked});
  EXPECT_EQ(report.verdict, Verdict::kContingency);
  EXPECT_EQ(random_worlds::dense_check(report.path, *world, VehicleLimits{}), "");
}

TEST(Replanner, AsksForNothingItCannotCheck) {
  Replanner replanner(VehicleLimits{}, {});
  ReplanRequest request = two_strips();
  request.route[1].position_m.x() = std::nan("");
  EXPECT_EQ(replanner.plan(world_of({}), request, {}).verdict, Verdict::kNoSafePath);
  EXPECT_EQ(replanner.plan(world_of({}), {}, {}).verdict, Verdict::kNoSafePath);
  EXPECT_EQ(replanner.plan(nullptr, two_strips(), {}).verdict, Verdict::kNoSafePath);
  EXPECT_EQ(Replanner({.cruise_speed_mps = -1.0}, {}).plan(world_of({}), two_strips(), {}).verdict,
            Verdict::kNoSafePath);
  EXPECT_EQ(Replanner({}, {.detour_waypoints = 0}).plan(world_of({}), two_strips(), {}).verdict,
            Verdict::kNoSafePath);
}

}  // namespace
}  // namespace swallowtail::planner
