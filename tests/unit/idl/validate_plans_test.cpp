#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "idl/data/validate.hpp"
#include "tests/unit/idl/samples.hpp"

namespace swallowtail {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// What is said of a valid, full sample of T after `spoil` has changed it.
template <class T>
data::Refusal after(const std::function<void(T&)>& spoil) {
  T sample = testing::make_sample<T>(testing::Extent::kFull, 1);
  EXPECT_EQ(data::validate(sample), data::Refusal{});
  spoil(sample);
  return data::validate(sample);
}

TEST(ValidatePlans, CoveragePlanMustBeOrderedAndBounded) {
  using T = data::CoveragePlan;
  EXPECT_EQ(after<T>([](T& p) { p.legs.emplace_back(); }), "sequence above its bound");
  EXPECT_EQ(after<T>([](T& p) { p.legs.resize(3); }), "more legs done than there are");
  EXPECT_EQ(after<T>([](T& p) { p.cost = kNan; }), "cost out of range");
  EXPECT_EQ(after<T>([](T& p) { p.reason.resize(129, 'x'); }), "text above its bound");
  EXPECT_EQ(after<T>([](T& p) { p.reason = std::string("a\0b", 3); }), "text above its bound");
  EXPECT_EQ(after<T>([](T& p) { p.legs[7].transfer = data::Transfer::kEnd; }),
            "plan ends before its last leg");
  EXPECT_EQ(after<T>([](T& p) { p.legs[7].end_s = p.legs[7].start_s - 1.0; }), "leg ends before it starts");
  EXPECT_EQ(after<T>([](T& p) { p.legs[p.legs_done + 1].start_s -= 1.0; }), "legs out of order in time");
  EXPECT_EQ(after<T>([](T& p) { p.legs[p.legs_done].start_s = 0.0; }), data::Refusal{})
      << "flown legs keep their times";
  EXPECT_EQ(after<T>([](T& p) { p.legs[9].energy_after = -1.0; }), "leg energy out of range");
  EXPECT_EQ(after<T>([](T& p) { p.legs[9].exit.z_m = kNan; }), "leg position out of range");
  EXPECT_EQ(after<T>([](T& p) { p.legs[9].kind = data::LegKind::kReposition, p.legs[9].exit.x_m = 1; }),
            "reposition leg covers ground");
  EXPECT_EQ(after<T>([](T& p) { p.legs[9].kind = static_cast<data::LegKind>(2); }),
            "enumerator out of range");
}

TEST(ValidatePlans, WaysMustBendAtBendsOfTheirOwn) {
  using T = data::CoveragePlan;
  EXPECT_EQ(after<T>([](T& p) { p.bends.resize(data::kMaxBends + 1); }), "sequence above its bound");
  EXPECT_EQ(after<T>([](T& p) { p.bends.back().x_m = kNan; }), "bend out of range");
  EXPECT_EQ(after<T>([](T& p) { p.bends.pop_back(); }), "way outside the bends");
  EXPECT_EQ(after<T>([](T& p) { p.legs[3].first_bend = ~0u; }), "way outside the bends");
  EXPECT_EQ(after<T>([](T& p) { p.legs[3].first_bend -= 1; }), "ways share bends");
  using C = data::ChargerPlan;
  EXPECT_EQ(after<C>([](C& p) { p.bends.front().z_m = kNan; }), "bend out of range");
  EXPECT_EQ(after<C>([](C& p) { p.rendezvous[3].carry_first_bend = p.rendezvous[3].first_bend; }),
            "ways share bends");
  EXPECT_EQ(after<C>([](C& p) { p.rendezvous.back().home_bend_count += 1; }), "way outside the bends");
  EXPECT_EQ(after<C>([](C& p) { p.rendezvous[3].speed_mps = kNan; }), "charger speed out of range");
}

TEST(ValidatePlans, ChargerPlanMustBeOrdered) {
  using T = data::ChargerPlan;
  EXPECT_EQ(after<T>([](T& p) { p.taper_from = -0.1; }), "charging taper out of range");
  EXPECT_EQ(after<T>([](T& p) { p.rendezvous[5].rendezvous_id = p.rendezvous[4].rendezvous_id; }),
            "rendezvous ids not growing");
  const auto from_depot = [](T& p) {
    p.rendezvous[4].kind = data::StopKind::kDepot, p.rendezvous[4].carry = false;
    p.rendezvous[5].rendezvous_id = p.rendezvous[4].rendezvous_id;
  };
  EXPECT_EQ(after<T>(from_depot), data::Refusal{});
  EXPECT_EQ(after<T>([&](T& p) { from_depot(p), p.rendezvous[4].carry = true; }), "depot carries");
  EXPECT_EQ(after<T>([&](T& p) { from_depot(p), p.has_battery = false; }), "depot without a battery");
  EXPECT_EQ(after<T>([&](T& p) { from_depot(p), p.rendezvous[5].kind = data::StopKind::kDepot; }),
            "rendezvous ids not growing");
  EXPECT_EQ(after<T>([](T& p) { p.battery.capacity = 0; }), "charger battery out of range");
  EXPECT_EQ(after<T>([](T& p) { p.battery.reserve = p.battery.capacity; }), "charger battery out of range");
  EXPECT_EQ(after<T>([](T& p) { p.battery.drive_per_s = kNan; }), "charger battery out of range");
  EXPECT_EQ(after<T>([](T& p) { p.rendezvous[3].robot_energy = -1; }), "charger energy out of range");
  EXPECT_EQ(after<T>([](T& p) { p.home_speed_mps = kNan; }), "charger speed out of range");
  EXPECT_EQ(after<T>([](T& p) { p.rendezvous[5].depart_s = p.rendezvous[5].arrive_by_s - 1; }),
            "rendezvous ends before it starts");
  EXPECT_EQ(after<T>([](T& p) { p.rendezvous[5].site.x_m = kNan; }), "site out of range");
  EXPECT_EQ(after<T>([](T& p) { p.rendezvous.resize(1025); }), "sequence above its bound");
  EXPECT_EQ(after<T>([](T& p) { p.speed_mps = -1; }), "charger speed out of range");
}

TEST(ValidatePlans, PathPlanMustBeOrderedInTime) {
  using T = data::PathPlan;
  EXPECT_EQ(after<T>([](T& p) { p.waypoints[5].time_s = p.waypoints[4].time_s - 1; }),
            "waypoints out of order in time");
  EXPECT_EQ(after<T>([](T& p) { p.waypoints[5].position.y_m = kNan; }), "position out of range");
  EXPECT_EQ(after<T>([](T& p) { p.waypoints.resize(2049); }), "sequence above its bound");
  EXPECT_EQ(after<T>([](T& p) { p.verdict = data::PathVerdict::kCertified, p.waypoints.clear(); }),
            "certified without waypoints");
  EXPECT_EQ(after<T>([](T& p) { p.clearance_min_m = kNan; }), "clearance out of range");
  EXPECT_EQ(after<T>([](T& p) { p.verdict = static_cast<data::PathVerdict>(3); }), "enumerator out of range");
}

TEST(ValidatePlans, ChargerStateAndStatusMustBeInRange) {
  using C = data::ChargerState;
  EXPECT_EQ(after<C>([](C& c) { c.docked_vehicle_id = 0, c.charge_rate = 1.0; }), "charging no vehicle");
  EXPECT_EQ(after<C>([](C& c) { c.charge_rate = kNan; }), "charge rate out of range");
  EXPECT_EQ(after<C>([](C& c) { c.energy_delivered = -1.0; }), "energy out of range");
  EXPECT_EQ(after<C>([](C& c) { c.energy = kNan; }), "energy out of range");
  using S = data::ParticipantStatus;
  EXPECT_EQ(after<S>([](S& s) { s.name.resize(33, 'x'); }), "text above its bound");
  EXPECT_EQ(after<S>([](S& s) { s.rejected[63].reason.resize(65, 'x'); }), "text above its bound");
  EXPECT_EQ(after<S>([](S& s) { s.rejected.resize(65); }), "sequence above its bound");
  EXPECT_EQ(after<S>([](S& s) { s.latency_p99_ms = kNan; }), "latency out of range");
}

}  // namespace
}  // namespace swallowtail
