#include "tests/support/replay_flight.hpp"

#include <gtest/gtest.h>

/// The replay's own flight, where its rules meet.
namespace swallowtail::test_support {
namespace {

/// Lines that meet in a corner of a field end within rounding of each other, at heights of their own.
TEST(ReplayFlight, UprightFlightAHairsBreadthAsideTakesWhatUprightFlightTakes) {
  coverage::Task task;
  task.vehicle.descent_speed_mps = 2.0;
  task.vehicle.climb_speed_mps = 4.0;
  task.battery.model.level_per_s = 1.0;
  task.battery.model.descent_per_s = 0.5;
  task.battery.model.climb_per_s = 3.0;
  ReplayFlight flight(task, 0.02);
  flight.stand_at(Vec3(0.0, 0.0, 30.0), 0.0, 100.0);
  flight.fly_to(Vec3(4e-7, 0.0, 20.0));
  EXPECT_NEAR(flight.time_s, 5.0, 1e-6);
  EXPECT_NEAR(flight.energy, 97.5, 1e-6);
  flight.land(20.0);
  flight.fly_to(Vec3(0.0, 0.0, 28.0));
  EXPECT_NEAR(flight.time_s, 7.0, 1e-6);
  EXPECT_NEAR(flight.energy, 91.5, 1e-6);
}

}  // namespace
}  // namespace swallowtail::test_support
