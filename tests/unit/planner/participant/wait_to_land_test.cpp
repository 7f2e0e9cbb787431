#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/planner/participant/planner_fixture.hpp"

/// Something slow comes between the aircraft and its landing: a wait is certified, but the energy has to last
/// for it.
namespace swallowtail::planner {
namespace {

class WaitToLand : public testing::TestWithParam<double>, protected PlannerFixture {
 protected:
  /// One strip of 100 m with a landing at its end, and this much left there above the reserve. The plan's
  /// flight takes one unit per second.
  void fly_until(double mission_s, double spare) { fly_until(mission_s, spare, task()); }
  void fly_until(double mission_s, double spare, const data::CoverageTask& asked) {
    publish(asked);
    data::CoveragePlan all = plan({data::Transfer::kEnd});
    data::Leg& leg = all.legs.front();
    leg.start_s = 0.0;
    leg.end_s = 30.0;
    leg.energy_after = task().battery.reserve + spare;
    leg.energy_before = leg.energy_after + 30.0;
    publish(all);
    run(mission_s);
  }
  /// Below the strip's end in a moment, and for 16 m of its way.
  void block_landing() {
    data::Obstacle slow = sphere(9, {-9.5, 100, 7}, 6.0);
    slow.velocity_mps = {GetParam(), 0, 0};
    slow.state_time_s = time_s;
    publish(slow);
    run(0.3);
  }
  double down_s() const { return path().waypoints.back().time_s - time_s; }
  bool lands_elsewhere() const {
    return path().lands && (to_vec(path().waypoints.back().position) - Vec3(0, 100, 0)).norm() > 1.0;
  }
};

TEST_P(WaitToLand, IsFlownWhereTheEnergyLasts) {
  fly_until(20.0, 200.0);
  block_landing();
  EXPECT_EQ(path().verdict, data::PathVerdict::kCertified) << path().reason;
  EXPECT_FALSE(lands_elsewhere());
  EXPECT_GT(down_s(), 20.0);
}

TEST_P(WaitToLand, IsNoneOnTheWayDownWhereTheEnergyDoesNotLast) {
  fly_until(23.0, 5.0);
  ASSERT_EQ(vehicle.mode, data::VehicleMode::kLanding);
  block_landing();
  EXPECT_TRUE(lands_elsewhere()) << path().reason;
  EXPECT_LT(down_s(), 20.0);
  run(25.0);
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kLanded);
}

TEST_P(WaitToLand, IsNoneOnAStripThatEndsSoonWhereTheEnergyDoesNotLast) {
  fly_until(20.0, 5.0);
  ASSERT_EQ(vehicle.mode, data::VehicleMode::kCovering);
  block_landing();
  EXPECT_TRUE(lands_elsewhere()) << path().reason;
  EXPECT_LT(down_s(), 20.0);
}

/// Nearer by is a yard that the robot must not enter.
TEST_P(WaitToLand, ComesDownWhereTheRobotMayCome) {
  data::CoverageTask yard = task();
  yard.points.insert(yard.points.end(), {{-8, 92}, {30, 92}, {30, 130}, {-8, 130}});
  yard.rings.push_back({0, 4, 4, false, data::AreaKind::kNoDrive});
  fly_until(23.0, 5.0, yard);
  block_landing();
  ASSERT_TRUE(path().lands) << path().reason;
  const data::Vec3 down = path().waypoints.back().position;
  EXPECT_TRUE(down.x_m < -11.0 || down.x_m > 33.0 || down.y_m < 89.0 || down.y_m > 133.0)
      << down.x_m << ", " << down.y_m;
}

/// What lies far ahead may be gone by then.
TEST_P(WaitToLand, FarAheadLeavesTheStripAsItIs) {
  fly_until(2.0, 5.0);
  block_landing();
  EXPECT_TRUE(std::ranges::any_of(path().waypoints, [](const data::TimedWaypoint& w) {
    return w.phase == data::PathPhase::kCover && w.position.y_m > 80.0;
  })) << path().reason;
}

INSTANTIATE_TEST_SUITE_P(Speeds, WaitToLand, testing::Values(0.6, 0.7, 0.8, 0.9, 1.0));

}  // namespace
}  // namespace swallowtail::planner
