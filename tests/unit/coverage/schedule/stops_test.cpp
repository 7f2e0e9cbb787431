#include "coverage/schedule/stops.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swallowtail::coverage {
namespace {

/// Strips of 160 m (20 s) side by side at 30 m (10 s up or down), flown to and fro.
class Stops : public testing::Test {
 protected:
  std::vector<RouteLeg> strips(int count) const {
    std::vector<RouteLeg> out;
    for (int i = 0; i < count; ++i) {
      const Vec3 left(0, 10.0 * i, 30);
      const Vec3 right(160, 10.0 * i, 30);
      out.push_back(
          {static_cast<std::uint32_t>(i), i % 2 == 0 ? FlownLeg{left, right} : FlownLeg{right, left}});
    }
    return out;
  }
  StopPlanner planner() { return {links_, params_}; }

  const planner::Terrain ground_ = planner::Terrain::flat(0.0);
  StopParams params_ = [] {
    StopParams p;
    p.battery.capacity = 100.0;
    p.battery.reserve = 10.0;
    p.energy_factor = 1.0;
    p.lead_s = 0.0;
    return p;
  }();
  LinkCache links_{FlightModel({}, {}, ground_), params_.charger};
  const ScheduleStart start_{
      .kind = StartKind::kGround, .position_m = Vec3(0, 0, 0), .direction = {}, .energy = 100.0};
};

TEST_F(Stops, WhatOneBatteryFliesNeedsNoStop) {
  const auto plan = planner().plan(strips(2), start_);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->sorties.size(), 1U);
  EXPECT_TRUE(plan->recharges.empty());
  const double hop = 2.0 + 10.0 / 8.0;
  EXPECT_NEAR(plan->end_s, 11.0 + 20.0 + hop + 20.0 + 11.0, 1e-9);
  EXPECT_NEAR(plan->sorties[0].energy_on_landing, 100.0 - plan->end_s, 1e-9);
}

TEST_F(Stops, ChargesJustWhatTheRestNeedsAndLandsWithTheReserve) {
  const auto plan = planner().plan(strips(6), start_);
  ASSERT_TRUE(plan);
  ASSERT_GE(plan->sorties.size(), 2U);
  EXPECT_NEAR(plan->sorties.back().energy_on_landing, 10.0, 1e-9);
  for (const Sortie& sortie : plan->sorties) EXPECT_GE(sortie.energy_on_landing, 10.0 - 1e-9);
  for (const Recharge& recharge : plan->recharges) EXPECT_LE(recharge.energy_to, 100.0 + 1e-9);
}

TEST_F(Stops, TheAircraftWaitsLandedForASlowRobot) {
  params_.charger.speed_mps = 0.5;
  params_.charger.start_m = Vec3(0, 0, 0);
  LinkCache slow(FlightModel({}, {}, ground_), params_.charger);
  ScheduleStart start = start_;
  start.robot_m = Vec3(0, -400, 0);
  const auto plan = StopPlanner(slow, params_).plan(strips(6), start);
  ASSERT_TRUE(plan);
  ASSERT_FALSE(plan->recharges.empty());
  EXPECT_GT(plan->recharges[0].wait_s, 500.0);
  EXPECT_NEAR(plan->recharges[0].energy_from, plan->sorties[0].energy_on_landing, 1e-9)
      << "waiting on the ground costs nothing";
}

TEST_F(Stops, ATransferBeyondTheBatteryIsDriven) {
  std::vector<RouteLeg> far = strips(2);
  far[1].flown = {Vec3(3000, 0, 30), Vec3(3160, 0, 30)};
  const auto plan = planner().plan(far, start_);
  ASSERT_TRUE(plan);
  ASSERT_EQ(plan->recharges.size(), 1U);
  EXPECT_TRUE(plan->recharges[0].carried_to);
}

TEST_F(Stops, NoScheduleWhereALegIsTooLongOrTheStartTooLow) {
  std::vector<RouteLeg> leg = strips(1);
  leg[0].flown.exit_m.x() = 1000.0;
  EXPECT_FALSE(planner().plan(leg, start_));
  ScheduleStart low = start_;
  low.energy = 40.0;
  EXPECT_FALSE(planner().plan(strips(1), low));
  low.kind = StartKind::kDocked;
  EXPECT_TRUE(planner().plan(strips(1), low)) << "on the robot it is charged first";
  EXPECT_TRUE(std::isinf(planner().end_of(leg, start_)));
}

TEST_F(Stops, ACutoffOnlySavesWork) {
  const auto route = strips(9);
  const double end = planner().end_of(route, start_);
  EXPECT_NEAR(planner().end_of(route, start_, end + 1.0), end, 1e-9);
  EXPECT_TRUE(std::isinf(planner().end_of(route, start_, end - 1.0)));
}

}  // namespace
}  // namespace swallowtail::coverage
