#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "charging_fixture.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::charger {
namespace {

std::vector<Vec3> random_way(Rng& rng) {
  std::vector<Vec3> out(rng.below(5));
  for (Vec3& bend : out) bend = Vec3(rng.uniform(-100, 100), rng.uniform(-100, 100), rng.uniform(0, 10));
  return out;
}

/// Enough for the farthest meeting and for some charge, seldom for all that is asked for.
BatteryLimits random_battery(Rng& rng, const Orders& orders) {
  BatteryLimits out;
  out.drive_per_s = rng.uniform(0.0, 0.05);
  out.per_charged = rng.uniform(0.8, 1.5);
  out.refill_s = rng.uniform(0.0, 60.0);
  // There, on with the vehicle, and home, each a diagonal of 200 m by 200 m at most.
  const double longest_s = 3.0 * 283.0 / orders.speed_mps;
  out.capacity = out.drive_per_s * longest_s + rng.uniform(10.0, 100.0);
  out.reserve = rng.uniform(0.0, 0.1) * out.capacity;
  out.capacity += out.reserve;
  return out;
}

Orders random_orders(Rng& rng) {
  Orders orders;
  orders.revision = 1;
  orders.speed_mps = rng.uniform(0.5, 4.0);
  orders.charge_s_per_unit = rng.uniform(0.2, 3.0);
  if (rng.below(2) == 0) {
    orders.taper_from = rng.uniform(0.5, 1.0);
    orders.taper_end_rate = rng.uniform(0.1, 1.0);
  }
  orders.landing_s = rng.uniform(0.0, 10.0);
  orders.take_off_s = rng.uniform(0.0, 10.0);
  orders.start_m = Vec3(rng.uniform(-100, 100), rng.uniform(-100, 100), rng.uniform(0, 10));
  if (rng.below(2) == 0) orders.battery = random_battery(rng, orders);
  std::uint32_t leg = 0;
  const std::uint64_t count = 1 + rng.below(6);
  for (std::uint64_t i = 0; i < count; ++i) {
    leg += 1 + static_cast<std::uint32_t>(rng.below(3));
    Meeting meeting;
    meeting.id = 2 * leg + 1 + static_cast<std::uint32_t>(rng.below(2));
    meeting.site_m = Vec3(rng.uniform(-100, 100), rng.uniform(-100, 100), rng.uniform(0, 10));
    meeting.charge_to = rng.uniform(10.0, 100.0);
    if (rng.below(3) == 0) meeting.carry_to_m = Vec3(rng.uniform(-100, 100), rng.uniform(-100, 100), 0.0);
    if (rng.below(2) == 0 && !orders.battery) {
      meeting.way_m = random_way(rng);
      meeting.carry_way_m = random_way(rng);
      meeting.way_speed_mps = rng.uniform(0.5, 8.0);
    }
    meeting.uses = rng.uniform(0.0, 120.0);
    if (orders.battery && rng.below(3) == 0) {
      Meeting depot;
      depot.id = meeting.id;
      depot.site_m = orders.start_m;
      depot.is_depot = true;
      orders.meetings.push_back(depot);
    }
    orders.meetings.push_back(meeting);
  }
  return orders;
}

struct Refills {
  int alone = 0;
  int on_board = 0;  ///< with the vehicle
};

/// A random mission: the vehicle flies for a while, lands at the next site, waits for READY, flies on.
void run_mission(std::uint64_t seed, Refills& refills) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  Rng rng(seed);
  const Orders orders = random_orders(rng);
  Meet meet(orders, {Delay{.at_s = rng.uniform(0, 200), .duration_s = rng.uniform(0, 60)}});
  meet.partner.fly_off();
  const double step_s = rng.uniform(0.02, 1.0);
  std::vector<std::uint32_t> served;
  Vec3 before_m = orders.start_m;
  double energy = orders.battery ? orders.battery->capacity : 0.0;

  for (const Meeting& meeting : orders.meetings) {
    if (meeting.is_depot) continue;
    meet.partner.energy = rng.uniform(0.0, 100.0);
    const double aim = std::max(meet.partner.energy, meeting.charge_to);
    const double land_s = meet.time_s + rng.uniform(1.0, 200.0);
    bool landed = false;
    for (int i = 0; meet.charging.state().activity != Activity::kReady; ++i) {
      ASSERT_LT(i, 100'000) << "never ready";
      if (!landed && meet.time_s >= land_s) {
        landed = true;
        meet.partner.land_at(meeting.site_m + Vec3(rng.uniform(-0.6, 0.6), rng.uniform(-0.6, 0.6), 0));
        meet.partner.legs_done = (meeting.id + 1) / 2;
      }
      const State& state = meet.step(step_s);
      ASSERT_LE((state.position_m - before_m).head<2>().norm(), orders.speed_mps * step_s * (1 + 1e-9));
      ASSERT_LE(state.speed_mps, orders.speed_mps * (1 + 1e-9));
      ASSERT_LE(meet.partner.energy, aim + 1e-9);
      ASSERT_LE(state.charge_rate, 1.0 / orders.charge_s_per_unit + 1e-12);
      ASSERT_TRUE(state.charge_rate == 0.0 || state.has_vehicle);
      if (orders.battery) {
        ASSERT_GE(state.energy, orders.battery->reserve - 1e-9);
        ASSERT_TRUE(state.energy <= energy + 1e-9 || meet.charging.state().activity == Activity::kRefilling ||
                    (state.position_m - orders.start_m).head<2>().norm() <= kArrival_m + 4.0 * step_s);
      }
      if (state.energy > energy) ++(state.has_vehicle ? refills.on_board : refills.alone);
      energy = state.energy;
      before_m = state.position_m;
    }
    ASSERT_GE(meet.partner.energy, std::min(meeting.charge_to, aim) - 2 * kChargeTolerance - 1e-9);
    ASSERT_TRUE(meet.charging.state().activity == Activity::kReady);
    served.push_back(meet.charging.state().meeting_id);
    ASSERT_EQ(served.back(), meeting.id);
    const Vec3 expected_m = meeting.carry_to_m.value_or(meeting.site_m);
    ASSERT_LE((meet.charging.state().position_m - expected_m).head<2>().norm(), kArrival_m + 1e-9);
    meet.partner.fly_off();
    meet.step(step_s);
    before_m = meet.charging.state().position_m;
    ASSERT_EQ(meet.charging.state().meetings_done, served.size());
  }
  EXPECT_EQ(meet.charging.state().activity, Activity::kIdle);
}

TEST(ChargingProperty, AnyPlanIsServedInOrderWithinSpeedAndCharge) {
  Refills refills;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    run_mission(seed, refills);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(refills.alone, 20);
  EXPECT_GT(refills.on_board, 20);
}

}  // namespace
}  // namespace swallowtail::charger
