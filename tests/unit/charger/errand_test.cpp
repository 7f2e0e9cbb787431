#include <gtest/gtest.h>

#include "charging_fixture.hpp"

/// How the robot keeps its own battery.
namespace swallowtail::charger {
namespace {

/// The first meeting is 40 m, 20 s, from the depot and asks for 30 units.
Orders limited(double capacity) {
  Orders orders = two_meetings();
  orders.battery = BatteryLimits{capacity, 10.0, 0.5, 1.0, 20.0};
  orders.meetings[0].uses = 30.0;
  orders.meetings[1].uses = 60.0;
  return orders;
}

TEST(Errand, UsesEnergyForDrivingAndCharging) {
  Meet meet(limited(200.0));
  meet.partner.fly_off();
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  EXPECT_NEAR(meet.charging.state().energy, 190.0, 0.1);
  meet.partner.land_at(Vec3(40, 0, 0));
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  EXPECT_NEAR(meet.charging.state().energy, 160.0, 0.2);
}

TEST(Errand, StopsAtItsDepotWhereThePlanSaysSo) {
  Orders orders = limited(200.0);
  Meeting depot;
  depot.id = orders.meetings[1].id;
  depot.is_depot = true;
  depot.site_m = orders.start_m;
  orders.meetings.insert(orders.meetings.begin() + 1, depot);
  Meet meet(orders);
  meet.partner.fly_off();
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  meet.partner.land_at(Vec3(40, 0, 0));
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  meet.partner.fly_off();
  meet.step();
  // The vehicle is at the next meeting already: the robot still comes by its depot.
  meet.partner.land_at(orders.meetings[2].site_m);
  ASSERT_TRUE(meet.reaches(Activity::kRefilling));
  EXPECT_LT((meet.charging.state().position_m - orders.start_m).norm(), kArrival_m);
  const double from_s = meet.time_s;
  ASSERT_TRUE(meet.reaches(Activity::kDriving));
  EXPECT_NEAR(meet.time_s - from_s, 20.0, 0.3);
  EXPECT_NEAR(meet.charging.state().energy, 200.0, 0.2);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
}

TEST(Errand, GoesToItsDepotFirstWhenItHasLostEnergy) {
  Meet meet(limited(200.0));
  meet.charging = Charging::make(limited(200.0), {}, 0.0, {{0.0, 150.0}}).value();
  meet.partner.fly_off();
  meet.step();
  EXPECT_EQ(meet.charging.state().activity, Activity::kRefilling) << "it stands there";
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  EXPECT_NEAR(meet.charging.state().energy, 190.0, 0.2);
}

TEST(Errand, TakesTheVehicleAlongWhereItsEnergyDoesNotDo) {
  Orders orders = limited(45.0);
  Meet meet(orders);
  meet.partner.fly_off();
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  meet.partner.land_at(Vec3(40, 0, 0));
  double least = 1e9;
  bool refilled_on_board = false;
  for (int i = 0; i < 20000 && meet.charging.state().activity != Activity::kReady; ++i) {
    const State& state = meet.step();
    least = std::min(least, state.energy);
    refilled_on_board = refilled_on_board || (state.activity == Activity::kRefilling && state.has_vehicle);
  }
  EXPECT_EQ(meet.charging.state().activity, Activity::kReady);
  EXPECT_TRUE(refilled_on_board);
  EXPECT_GE(least, 10.0 - 1e-9);
  EXPECT_NEAR(meet.partner.energy, 80.0, 2 * kChargeTolerance);
  EXPECT_NEAR(meet.partner.position_m.x(), 40.0, 0.1) << "back where it is to take off";
}

TEST(Errand, MeetsAVehicleThatWaitsBeforeItsFirstLeg) {
  Orders orders = two_meetings();
  orders.meetings[0].id = 0;
  Meet meet(orders);
  meet.partner.land_at(orders.meetings[0].site_m);
  ASSERT_TRUE(meet.reaches(Activity::kReady, 300.0)) << "it has not flown, and does not before it is charged";
}

}  // namespace
}  // namespace swallowtail::charger
