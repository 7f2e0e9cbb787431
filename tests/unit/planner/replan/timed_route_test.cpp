#include "planner/replan/timed_route.hpp"

#include <gtest/gtest.h>

namespace swallowtail::planner {
namespace {

const VehicleLimits kLimits;

TimedRoute strip() {
  return TimedRoute::make(Vec3(0, 0, 20), 10.0,
                          {{Vec3(0, 80, 20), Phase::kCover, 0, 0.0},
                           {Vec3(10, 80, 20), Phase::kTransfer, 1, 0.0},
                           {Vec3(10, 0, 20), Phase::kCover, 1, 0.0}},
                          kLimits);
}

TEST(TimedRoute, SpellsOutTheCornersThatTimingAdds) {
  const TimedRoute timed =
      TimedRoute::make(Vec3(0, 0, 0), 0.0, {{Vec3(1, 0, 50), Phase::kTransfer, 0, 0.0}}, kLimits);
  ASSERT_EQ(timed.route.size(), 2u);
  EXPECT_EQ(timed.route[0].position_m, Vec3(0, 0, 50));
  EXPECT_EQ(timed.path[timed.arrivals.back()].position_m, Vec3(1, 0, 50));
}

TEST(Splice, RejoinsTheStripAndKeepsTheRest) {
  const TimedRoute old = strip();
  const Spliced spliced = splice(old, {12.5, 15.0, 0.0, false, {Vec3(6, 30, 20)}}, kLimits);
  const TimedPath& path = spliced.timed.path;
  EXPECT_NEAR(path[spliced.leave_index].position_m.y(), 20.0, 1e-6);
  EXPECT_NEAR(path[spliced.rejoin_index].position_m.y(), 40.0, 1e-6);
  EXPECT_NEAR(spliced.skipped_cover_m, 20.0, 1e-6);
  EXPECT_EQ(path.back().position_m, Vec3(10, 0, 20));
  EXPECT_GT(spliced.timed.end_time_s(), old.end_time_s());
  EXPECT_EQ(path[spliced.rejoin_index].phase, Phase::kTransfer);
}

TEST(Splice, WaitsAndFliesTheSameWay) {
  const TimedRoute old = strip();
  const Spliced spliced = splice(old, {12.5, 15.0, 7.0, true, {}}, kLimits);
  EXPECT_NEAR(spliced.timed.end_time_s(), old.end_time_s() + 7.0, 1e-6);
  EXPECT_NEAR(length_m(spliced.timed.path), length_m(old.path), 1e-9);
  EXPECT_EQ(spliced.skipped_cover_m, 0.0);
}

TEST(Splice, LeavesACoverWaypointToALegThatIsLeftOut) {
  const TimedRoute old = TimedRoute::make(Vec3(0, 0, 20), 0.0,
                                          {{Vec3(0, 80, 20), Phase::kCover, 0, 0.0},
                                           {Vec3(10, 80, 20), Phase::kTransfer, 1, 0.0},
                                           {Vec3(10, 70, 20), Phase::kCover, 1, 0.0},
                                           {Vec3(20, 70, 20), Phase::kTransfer, 2, 0.0},
                                           {Vec3(20, 0, 20), Phase::kCover, 2, 0.0}},
                                          kLimits);
  const Spliced spliced = splice(old, {9.0, old.end_time_s() - 6.0, 0.0, false, {Vec3(40, 80, 30)}}, kLimits);
  std::vector<std::uint32_t> covered;
  for (const TimedWaypoint& w : spliced.timed.path) {
    if (w.phase == Phase::kCover && (covered.empty() || covered.back() != w.leg_index))
      covered.push_back(w.leg_index);
  }
  EXPECT_EQ(covered, (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace swallowtail::planner
