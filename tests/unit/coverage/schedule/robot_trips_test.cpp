#include "coverage/schedule/robot_trips.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace swallowtail::coverage {
namespace {

using testing::HasSubstr;

/// Three meetings 100 m from the depot, 50 s at 2 m/s, each charging 50 units; 250 s lie between the first
/// two, 50 s before the last.
class RobotTrips : public testing::Test {
 protected:
  RobotTrips() {
    task_.charger.speed_mps = 2.0;
    task_.charger.battery = {120.0, 0.1, 1.0, 20.0};
    for (std::uint32_t i = 0; i < 4; ++i) {
      Leg leg;
      leg.start_s = starts_s_[i];
      leg.end_s = starts_s_[i] + 10.0;
      plan_.legs.push_back(leg);
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      Rendezvous meeting;
      meeting.id = exit_id(i);
      meeting.site_m = meeting.carry_to_m = Vec3(100, 0, 0);
      meeting.robot_arrives_s = i == 0 ? 50.0 : plan_.rendezvous.back().depart_s;
      meeting.land_s = lands_s_[i];
      meeting.depart_s = meeting.land_s + 50.0;
      meeting.energy_from = 100.0;
      meeting.charge_to = 150.0;
      plan_.rendezvous.push_back(meeting);
    }
    plan_.makespan_s = 600.0;
  }
  Status limit() { return limit_robot(task_, FlightModel(task_.vehicle, {}, ground_), plan_); }

  const double starts_s_[4] = {10.0, 200.0, 460.0, 560.0};
  const double lands_s_[3] = {100.0, 400.0, 500.0};
  const planner::Terrain ground_ = planner::Terrain::flat(0.0);
  Task task_;
  Plan plan_;
};

TEST_F(RobotTrips, NewEnergyIsFetchedWhereNobodyWaitsForIt) {
  ASSERT_TRUE(limit());
  ASSERT_EQ(plan_.depot_visits.size(), 1U);
  EXPECT_EQ(plan_.depot_visits[0].before, 1U);
  EXPECT_NEAR(plan_.depot_visits[0].arrives_s, 200.0, 1e-9);
  EXPECT_NEAR(plan_.depot_visits[0].leaves_s, 220.0, 1e-9);
  EXPECT_NEAR(plan_.rendezvous[1].robot_arrives_s, 270.0, 1e-9);
  EXPECT_NEAR(plan_.makespan_s, 600.0, 1e-9);
  EXPECT_NEAR(plan_.robot_home_s, 600.0, 1e-9);
}

TEST_F(RobotTrips, WhatTheAircraftWaitsMovesAllThatFollows) {
  task_.charger.battery.capacity = 65.0;
  ASSERT_TRUE(limit());
  ASSERT_EQ(plan_.depot_visits.size(), 2U);
  // Free at 450 s, back at the site 120 s later, 70 s after the landing.
  EXPECT_NEAR(plan_.rendezvous[2].robot_arrives_s, 570.0, 1e-9);
  EXPECT_NEAR(plan_.rendezvous[2].land_s, 500.0, 1e-9);
  EXPECT_NEAR(plan_.rendezvous[2].wait_s, 70.0, 1e-9);
  EXPECT_NEAR(plan_.rendezvous[2].depart_s, 620.0, 1e-9);
  EXPECT_NEAR(plan_.legs[2].start_s, 460.0, 1e-9);
  EXPECT_NEAR(plan_.legs[3].start_s, 630.0, 1e-9);
  EXPECT_NEAR(plan_.makespan_s, 670.0, 1e-9);
}

TEST_F(RobotTrips, ABatteryThatDoesForAllChangesNothingButTheWayHome) {
  task_.charger.battery.capacity = 160.0;
  ASSERT_TRUE(limit());
  EXPECT_TRUE(plan_.depot_visits.empty());
  EXPECT_NEAR(plan_.robot_home_s, 600.0, 1e-9);
}

TEST_F(RobotTrips, AMeetingBeyondItsBatteryIsNamedWithItsPlace) {
  task_.charger.battery.capacity = 59.0;
  const Status status = limit();
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("the rendezvous at (100.00, 0.00) m"));
}

TEST_F(RobotTrips, TheAircraftDoesNotWaitBeyondItsReserve) {
  task_.charger.battery.capacity = 65.0;
  task_.battery.reserve = 25.0;
  task_.battery.model.landed_per_s = 2.0;
  const Status status = limit();
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().message, HasSubstr("beyond its reserve"));
}

}  // namespace
}  // namespace swallowtail::coverage
