#include "charger/charging/charging.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "charging_fixture.hpp"

namespace swallowtail::charger {
namespace {

/// Takes the vehicle on board at the first meeting.
void meet_first(Meet& meet) {
  meet.partner.fly_off();
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  meet.partner.legs_done = 1;
  meet.partner.land_at(Vec3(40.3, 0, 0));
  ASSERT_TRUE(meet.reaches(Activity::kCharging, 1.0));
}

TEST(Charging, IsIdleWithoutMeetings) {
  Orders orders = two_meetings();
  orders.meetings.clear();
  Meet meet(orders);
  meet.run(10.0);
  EXPECT_EQ(meet.charging.state().activity, Activity::kIdle);
  EXPECT_EQ(meet.charging.state().position_m, orders.start_m);
}

TEST(Charging, DrivesToTheFirstSiteAndWaits) {
  Meet meet(two_meetings());
  meet.partner.fly_off();
  meet.run(10.0);
  EXPECT_EQ(meet.charging.state().activity, Activity::kDriving);
  EXPECT_NEAR(meet.charging.state().position_m.x(), 20.0, 0.3);
  EXPECT_NEAR(meet.charging.state().speed_mps, 2.0, 1e-9);
  ASSERT_TRUE(meet.reaches(Activity::kWaiting, 12.0));
  EXPECT_EQ(meet.charging.state().speed_mps, 0.0);
  EXPECT_EQ(meet.charging.state().meeting_id, 1U);
}

TEST(Charging, DoesNotTakeAVehicleThatHasNotFlownYet) {
  Orders orders = two_meetings();
  orders.meetings[0].site_m = orders.start_m;
  Meet meet(orders);
  meet.run(20.0);
  EXPECT_EQ(meet.charging.state().activity, Activity::kWaiting);
}

/// The robot may have been silent while it flew.
TEST(Charging, TakesAVehicleThatStandsWhereItWasToLandLongAgo) {
  Orders orders = two_meetings();
  orders.meetings[0].site_m = orders.start_m;
  orders.meetings[0].arrive_by_s = 30.0;
  Meet meet(orders);
  meet.run(80.0);
  EXPECT_EQ(meet.charging.state().activity, Activity::kWaiting);
  meet.run(20.0);
  EXPECT_TRUE(meet.charging.state().has_vehicle);
}

TEST(Charging, DoesNotTakeAVehicleThatStandsTooFarAway) {
  Meet meet(two_meetings());
  meet.partner.fly_off();
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  meet.partner.land_at(Vec3(41.2, 0, 0));
  meet.run(20.0);
  EXPECT_EQ(meet.charging.state().activity, Activity::kWaiting);
}

TEST(Charging, HandlesChargesAndLetsGo) {
  Meet meet(two_meetings());
  meet_first(meet);
  const double docked_s = meet.time_s;
  EXPECT_TRUE(meet.charging.state().has_vehicle);
  EXPECT_EQ(meet.charging.state().charge_rate, 0.0);
  meet.run(4.5);
  EXPECT_EQ(meet.charging.state().charge_rate, 0.0) << "still handling the landing";
  meet.run(1.0);
  EXPECT_NEAR(meet.charging.state().charge_rate, 0.5, 1e-12);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  EXPECT_NEAR(meet.time_s - docked_s, 5.0 + 30.0 * 2.0 + 3.0, 2.0);
  EXPECT_LE(meet.partner.energy, 80.0);
  EXPECT_GE(meet.partner.energy, 80.0 - 2 * kChargeTolerance);
  EXPECT_EQ(meet.charging.state().meetings_done, 0U);
  meet.run(50.0);
  EXPECT_EQ(meet.charging.state().activity, Activity::kReady);
  meet.partner.fly_off();
  meet.step();
  EXPECT_EQ(meet.charging.state().activity, Activity::kDriving);
  EXPECT_EQ(meet.charging.state().meetings_done, 1U);
  EXPECT_EQ(meet.charging.state().meeting_id, 4U);
  EXPECT_FALSE(meet.charging.state().has_vehicle);
}

TEST(Charging, CarriesWhileItCharges) {
  Orders orders = two_meetings();
  orders.meetings.erase(orders.meetings.begin());
  Meet meet(orders);
  meet.partner.fly_off();
  meet.partner.legs_done = 1;
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  meet.partner.legs_done = 2;
  meet.partner.land_at(Vec3(40, 60, 0));
  ASSERT_TRUE(meet.reaches(Activity::kCarrying, 10.0));
  EXPECT_NEAR(meet.charging.state().charge_rate, 0.5, 1e-12);
  ASSERT_TRUE(meet.reaches(Activity::kCharging, 30.0)) << "40 m at 2 m/s, then the rest of the charge";
  EXPECT_EQ(meet.charging.state().position_m, Vec3(0, 60, 0));
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  EXPECT_EQ(meet.partner.position_m, Vec3(0, 60, 0));
  EXPECT_GE(meet.partner.energy, 100.0 - 2 * kChargeTolerance);
}

TEST(Charging, StopsDrivingWhileDelayed) {
  Meet meet(two_meetings(), {Delay{.at_s = 5.0, .duration_s = 7.0}});
  meet.partner.fly_off();
  meet.run(5.05);
  const Vec3 stopped_m = meet.charging.state().position_m;
  EXPECT_EQ(meet.charging.state().activity, Activity::kDelayed);
  meet.run(6.5);
  EXPECT_EQ(meet.charging.state().position_m, stopped_m);
  ASSERT_TRUE(meet.reaches(Activity::kDriving, 1.0));
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  EXPECT_NEAR(meet.time_s, 27.0, 0.5);
}

TEST(Charging, FollowsAMeetingThatMovesWhileDriving) {
  Meet meet(two_meetings());
  meet.partner.fly_off();
  meet.run(5.0);
  Orders orders = two_meetings();
  orders.revision = 2;
  orders.meetings[0].site_m = Vec3(0, -20, 0);
  ASSERT_TRUE(meet.charging.set_orders(orders));
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  EXPECT_EQ(meet.charging.state().position_m, Vec3(0, -20, 0));
  EXPECT_EQ(meet.charging.state().orders_revision, 2U);
}

TEST(Charging, GoesOnToTheNextWhenAMeetingVanishes) {
  Meet meet(two_meetings());
  meet.partner.fly_off();
  meet.run(5.0);
  Orders orders = two_meetings();
  orders.revision = 2;
  orders.meetings.erase(orders.meetings.begin());
  ASSERT_TRUE(meet.charging.set_orders(orders));
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  EXPECT_EQ(meet.charging.state().meeting_id, 4U);
  orders.revision = 3;
  orders.meetings.clear();
  ASSERT_TRUE(meet.charging.set_orders(orders));
  meet.step();
  EXPECT_EQ(meet.charging.state().activity, Activity::kIdle);
}

TEST(Charging, ServesAVehicleOnBoardWhoseMeetingVanished) {
  Meet meet(two_meetings());
  meet_first(meet);
  Orders orders = two_meetings();
  orders.revision = 2;
  orders.meetings.erase(orders.meetings.begin());
  ASSERT_TRUE(meet.charging.set_orders(orders));
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  EXPECT_NEAR(meet.partner.energy, 80.0, 2 * kChargeTolerance);
}

TEST(Charging, ChargesOnWhenMoreIsAskedForAfterReady) {
  Meet meet(two_meetings());
  meet_first(meet);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  Orders orders = two_meetings();
  orders.revision = 2;
  orders.meetings[0].charge_to = 95.0;
  ASSERT_TRUE(meet.charging.set_orders(orders));
  meet.step();
  EXPECT_EQ(meet.charging.state().activity, Activity::kCharging);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  EXPECT_NEAR(meet.partner.energy, 95.0, 2 * kChargeTolerance);
}

TEST(Charging, DoesNotGoBackToAFinishedMeetingThatIsStillListed) {
  Meet meet(two_meetings());
  meet_first(meet);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  meet.partner.fly_off();
  Orders orders = two_meetings();
  orders.revision = 2;
  meet.step();
  ASSERT_TRUE(meet.charging.set_orders(orders));
  meet.step();
  EXPECT_EQ(meet.charging.state().meeting_id, 4U);
}

TEST(Charging, ServesAVehicleThatCameBackOnceNewOrdersSaySo) {
  Meet meet(two_meetings());
  meet_first(meet);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  meet.partner.fly_off();
  meet.run(3.0);
  meet.partner.land_at(Vec3(40, 0, 0));
  meet.run(1.0);
  EXPECT_EQ(meet.charging.state().meeting_id, 4U) << "the old orders do not name it again";
  Orders orders = two_meetings();
  orders.revision = 2;
  ASSERT_TRUE(meet.charging.set_orders(orders));
  ASSERT_TRUE(meet.reaches(Activity::kCharging, 30.0));
  EXPECT_EQ(meet.charging.state().meeting_id, 1U);
}

TEST(Charging, SkipsMeetingsThatTheVehicleHasLeftBehind) {
  Meet meet(two_meetings());
  meet.partner.fly_off();
  meet.partner.legs_done = 2;
  meet.step();
  EXPECT_EQ(meet.charging.state().meeting_id, 4U);
}

TEST(Charging, TakesOnAfterARestartWhereTheVehicleSaysItIsOnBoard) {
  Meet meet(two_meetings());
  meet.partner.legs_done = 1;
  meet.partner.on_board = true;
  meet.partner.position_m = Vec3(40, 0, 0);
  meet.step();
  EXPECT_EQ(meet.charging.state().position_m, Vec3(40, 0, 0));
  EXPECT_TRUE(meet.charging.state().has_vehicle);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  EXPECT_NEAR(meet.partner.energy, 80.0, 2 * kChargeTolerance);
}

TEST(Charging, DoesNotChargeBlindly) {
  Meet meet(two_meetings());
  meet_first(meet);
  Inputs blind = meet.inputs();
  blind.battery.reset();
  for (int i = 0; i < 100; ++i) {
    meet.time_s += 0.1;
    meet.charging.step(meet.time_s, blind);
  }
  EXPECT_EQ(meet.charging.state().charge_rate, 0.0);
  EXPECT_EQ(meet.charging.state().energy_delivered, 0.0);
}

TEST(Charging, KeepsTheOldOrdersWhenNewOnesAreSenseless) {
  Meet meet(two_meetings());
  Orders orders = two_meetings();
  orders.revision = 9;
  orders.speed_mps = std::numeric_limits<double>::quiet_NaN();
  const Status refused = meet.charging.set_orders(orders);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("speed_mps"), std::string::npos);
  meet.step();
  EXPECT_EQ(meet.charging.state().orders_revision, 1U);
}

TEST(Charging, RefusesEachSenselessOrder) {
  const auto refused = [](auto change) {
    Orders orders = two_meetings();
    change(orders);
    return !validate(orders);
  };
  EXPECT_TRUE(validate(two_meetings()));
  EXPECT_TRUE(refused([](Orders& o) { o.charge_s_per_unit = 0.0; }));
  EXPECT_TRUE(refused([](Orders& o) { o.landing_s = -1.0; }));
  EXPECT_TRUE(refused([](Orders& o) { o.take_off_s = -1.0; }));
  EXPECT_TRUE(refused([](Orders& o) { o.start_m.x() = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](Orders& o) { o.meetings[1].charge_to = -1.0; }));
  EXPECT_TRUE(
      refused([](Orders& o) { o.meetings[1].carry_to_m->y() = std::numeric_limits<double>::quiet_NaN(); }));
}

TEST(Charging, IgnoresTimeThatGoesBack) {
  Meet meet(two_meetings());
  meet.partner.fly_off();
  meet.run(5.0);
  const State before = meet.charging.state();
  const State& after = meet.charging.step(1.0, meet.inputs());
  EXPECT_EQ(after.time_s, before.time_s);
  EXPECT_EQ(after.position_m, before.position_m);
}

TEST(Charging, StoodStillWhileItWasNotStepped) {
  Meet meet(two_meetings());
  meet.partner.fly_off();
  meet.run(2.0);
  const Vec3 before_m = meet.charging.state().position_m;
  meet.step(300.0);
  EXPECT_NEAR((meet.charging.state().position_m - before_m).norm(), 2.0 * kLongestStep_s, 1e-6);
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  meet.partner.land_at({40, 0, 0});
  ASSERT_TRUE(meet.reaches(Activity::kCharging));
  meet.run(7.0);
  const State charging = meet.charging.state();
  ASSERT_GT(charging.charge_rate, 0.0);
  EXPECT_NEAR(meet.step(300.0).energy_delivered - charging.energy_delivered,
              charging.charge_rate * kLongestStep_s, 1e-9);
}

TEST(Charging, SlowsDownAsTheCurveSays) {
  Orders orders = two_meetings();
  orders.taper_from = 0.6;
  orders.taper_end_rate = 0.1;
  orders.meetings.resize(1);
  orders.meetings[0].charge_to = 100.0;
  Meet meet(orders);
  meet.partner.fly_off();
  meet.run(1.0);
  meet.partner.land_at(orders.meetings[0].site_m);
  ASSERT_TRUE(meet.reaches(Activity::kCharging));
  while (meet.partner.energy < 55.0) meet.step();
  EXPECT_NEAR(meet.charging.state().charge_rate, 0.5, 1e-9);
  while (meet.partner.energy < 80.0) meet.step();
  EXPECT_NEAR(meet.charging.state().charge_rate, 0.5 * 0.55, 0.01) << "half way down to a tenth";
  EXPECT_TRUE(meet.reaches(Activity::kReady));
}

TEST(Charging, DrivesAlongItsWaysAtTheirSpeed) {
  Orders orders = two_meetings();
  orders.meetings[0].way_m = {orders.start_m, Vec3(0, 30, 0), Vec3(40, 30, 0)};
  orders.meetings[0].way_speed_mps = 1.0;
  Meet meet(orders);
  meet.partner.fly_off();
  meet.run(20.0);
  EXPECT_NEAR(meet.charging.state().position_m.x(), 0.0, 1e-9);
  EXPECT_NEAR(meet.charging.state().position_m.y(), 20.0, 0.2);
  EXPECT_NEAR(meet.charging.state().speed_mps, 1.0, 1e-9);
  ASSERT_TRUE(meet.reaches(Activity::kWaiting));
  EXPECT_NEAR(meet.time_s, 100.0, 1.0);
}

TEST(Charging, KnowsThatAVehicleLeftUnseen) {
  Meet meet(two_meetings());
  meet_first(meet);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  // It flew while nothing was heard of it, and stands at the second meeting now.
  meet.partner.on_board = false;
  Inputs later = meet.inputs();
  later.vehicle->position_m = two_meetings().meetings[1].site_m;
  later.vehicle->docked_here = false;
  later.vehicle->legs_done = 2;
  meet.charging.step(meet.time_s + 0.1, later);
  EXPECT_FALSE(meet.charging.state().has_vehicle);
  EXPECT_EQ(meet.charging.state().meetings_done, 1U);
  meet.charging.step(meet.time_s + 0.2, later);
  EXPECT_EQ(meet.charging.state().activity, Activity::kDriving);
}

TEST(Charging, ChargesAsANewPlanSaysThatNumbersTheMeetingAnew) {
  Meet meet(two_meetings());
  meet_first(meet);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  Orders anew = two_meetings();
  anew.revision = 2;
  anew.meetings[0].id = 2;
  anew.meetings[0].charge_to = 95.0;
  ASSERT_TRUE(meet.charging.set_orders(anew));
  meet.step();
  EXPECT_EQ(meet.charging.state().meeting_id, 2U);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  EXPECT_NEAR(meet.partner.energy, 95.0, 0.5);
}

TEST(Charging, AnotherVehicleHasNoMeetingsBehindIt) {
  Meet meet(two_meetings());
  meet_first(meet);
  ASSERT_TRUE(meet.reaches(Activity::kReady));
  meet.partner.fly_off();
  meet.run(1.0);
  ASSERT_EQ(meet.charging.state().meetings_done, 1U);
  meet.partner.legs_done = 0;
  meet.partner.land_at(Vec3(-20, 0, 0));
  meet.run(0.5);
  EXPECT_EQ(meet.charging.state().meeting_id, two_meetings().meetings[0].id) << "it is served again";
}

}  // namespace
}  // namespace swallowtail::charger
