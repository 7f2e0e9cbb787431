#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/planner/participant/planner_fixture.hpp"

/// Obstacles that may turn or change their speed at any time.
namespace swallowtail::planner {
namespace {

class TurningObstacle : public testing::Test, protected PlannerFixture {};

/// It goes beside the strip, as near as its radius and the vehicle's clearance allow and a little more.
TEST_F(TurningObstacle, KeepsMarginFromObstaclesThatMayTurnWhereAskedTo) {
  const auto passed_m = [this](double acceleration_mps2, const data::Vec3& velocity) {
    start_planner_with({.vehicle_id = 1, .obstacle_acceleration_mps2 = acceleration_mps2});
    paths.clear();
    publish(task());
    publish(plan({data::Transfer::kEnd}));
    data::Obstacle mover = sphere(7, {7.0, 60, 20}, 4.0);
    mover.velocity_mps = velocity;
    publish(mover);
    run(0.3);
    double least = 1e9;
    const TimedPath flown = to_path(path().waypoints);
    for (double t = flown.front().time_s; t < flown.back().time_s; t += 0.02) {
      const Vec3 at(7.0 + velocity.x_m * t, 60 + velocity.y_m * t, 20);
      least = std::min(least, (position_at(flown, t) - at).norm());
    }
    return least;
  };
  EXPECT_NEAR(passed_m(0.0, {0, 0.5, 0}), 7.0, 1e-3);
  // Half a second's lead and 16 m/s²: 2 m more than the 6.5 m.
  EXPECT_GE(passed_m(16.0, {0, 0.5, 0}), 8.5 - 1e-3);
  EXPECT_NEAR(passed_m(16.0, {0, 0, 0}), 7.0, 1e-3) << "what stands still does not turn";
}

/// It turns at once, and what was kept from it for that is spent when an answer can be flown.
TEST_F(TurningObstacle, GetsAwayFromAnObstacleThatHasTurnedTowardsIt) {
  start_planner_with({.vehicle_id = 1, .obstacle_acceleration_mps2 = 16.0});
  publish(task());
  publish(plan({data::Transfer::kEnd}));
  run(11.0);
  ASSERT_EQ(vehicle.mode, data::VehicleMode::kCovering);
  data::Obstacle mover = sphere(7, {9.0, position().y(), 20}, 4.0);
  const auto tell = [&](const data::Vec3& at, const data::Vec3& velocity) {
    mover.position = at;
    mover.velocity_mps = velocity;
    mover.state_time_s = time_s;
    publish(mover);
  };
  double least_m = 1e9;
  const auto watch = [&](double seconds) {
    for (double done_s = 0.0; done_s < seconds; done_s += 0.05) {
      run(0.05);
      const Vec3 at = to_vec(mover.position) + to_vec(mover.velocity_mps) * (time_s - mover.state_time_s);
      least_m = std::min(least_m, (position() - at).norm());
    }
  };
  tell(mover.position, {0, 8, 0});
  watch(1.0);
  ASSERT_EQ(path_count(), 1u) << "flies beside it: " << path().reason;
  tell(to_data(position() + Vec3(9.0, 0.0, 0.0)), {-2.0, 8.0, 0.0});
  watch(0.2);
  ASSERT_EQ(path_count(), 2u);
  EXPECT_EQ(path().verdict, data::PathVerdict::kContingency);
  EXPECT_NE(path().reason.find("no margin for turns"), std::string::npos) << path().reason;
  watch(40.0);
  EXPECT_GE(least_m, 6.5 - 1e-3);
  EXPECT_EQ(path().verdict, data::PathVerdict::kCertified) << "the margin is kept again";
  EXPECT_EQ(vehicle.mode, data::VehicleMode::kLanded);
}

}  // namespace
}  // namespace swallowtail::planner
