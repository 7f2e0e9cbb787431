#include "coverage/schedule/order_value.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/base/rng.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

/// Random battery, robot, start and legs, from one seed.
struct Case {
  explicit Case(std::uint64_t seed) : rng(seed) {
    EnergyModel& rates = params.battery.model;
    rates.climb_per_s = rng.uniform(1.0, 2.0);
    rates.descent_per_s = rng.uniform(0.3, 1.0);
    rates.hover_per_s = rng.uniform(0.3, 1.2);
    rates.landed_per_s = rng.uniform() < 0.5 ? 0.0 : 0.02;
    params.battery.capacity = rng.uniform(80.0, 400.0);
    params.battery.reserve = rng.uniform(5.0, 20.0);
    params.battery.charge_s_per_unit = rng.uniform() < 0.1 ? 0.0 : rng.uniform(0.1, 3.0);
    params.charger.speed_mps = rng.uniform(0.5, 4.0);
    params.energy_factor = rng.uniform(1.0, 1.2);
    params.spare = rng.uniform(0.0, 5.0);
    params.air_factor = rng.uniform() < 0.5 ? 0.0 : 1.02;
    start.kind = static_cast<StartKind>(rng.below(3));
    start.position_m =
        Vec3(rng.uniform(-50.0, 50.0), rng.uniform(-50.0, 50.0), start.kind == StartKind::kAir ? 20.0 : 0.0);
    start.time_s = rng.uniform(0.0, 100.0);
    start.energy = params.battery.capacity * rng.uniform(0.4, 1.0);
    start.robot_m = Vec3(rng.uniform(-200.0, 200.0), 0.0, 0.0);
    start.robot_free_s = start.time_s + rng.uniform(0.0, 60.0);
    const auto count = static_cast<std::uint32_t>(1 + rng.below(60));
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec3 a(rng.uniform(0.0, 150.0), 10.0 * i, 20.0 + 5.0 * static_cast<double>(rng.below(3)));
      legs.push_back({2 * i, {a, a + Vec3(rng.uniform(-100.0, 100.0), rng.uniform(-10.0, 10.0), 0.0)}});
    }
  }
  /// A stretch of up to 15 legs turned round, or cut in two parts that change places.
  std::pair<std::size_t, std::vector<RouteLeg>> change() {
    const std::size_t first = rng.below(legs.size());
    const std::size_t count = 1 + rng.below(std::min<std::size_t>(legs.size() - first, 15));
    std::vector<RouteLeg> out(legs.begin() + static_cast<std::ptrdiff_t>(first),
                              legs.begin() + static_cast<std::ptrdiff_t>(first + count));
    if (rng.uniform() < 0.5) {
      std::rotate(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(rng.below(count)), out.end());
      return {first, out};
    }
    std::reverse(out.begin(), out.end());
    for (RouteLeg& leg : out) leg = {leg.id ^ 1U, {leg.flown.exit_m, leg.flown.entry_m}};
    return {first, out};
  }
  std::vector<RouteLeg> with(const std::pair<std::size_t, std::vector<RouteLeg>>& change) const {
    std::vector<RouteLeg> out = legs;
    std::copy(change.second.begin(), change.second.end(),
              out.begin() + static_cast<std::ptrdiff_t>(change.first));
    return out;
  }

  Rng rng;
  StopParams params;
  ScheduleStart start;
  std::vector<RouteLeg> legs;
};

void expect_same(double value, double judged, std::uint64_t seed) {
  if (std::isinf(judged)) {
    EXPECT_TRUE(std::isinf(value)) << "seed " << seed;
  } else {
    EXPECT_NEAR(value, judged, 1e-7) << "seed " << seed;
  }
}

TEST(ValueOfAnOrder, IsTheEndThatTheStopPlannerFinds) {
  const planner::Terrain ground = planner::Terrain::flat(0.0);
  int schedules = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    Case c(seed);
    LinkCache links(FlightModel({}, c.params.battery.model, ground), c.params.charger);
    StopPlanner judge(links, c.params);
    OrderValue value(links, c.params, c.start);
    value.set(c.legs);
    expect_same(value.end_s(), judge.end_of(c.legs, c.start), seed);
    for (int i = 0; i < 12; ++i) {
      const auto change = c.change();
      const double judged = judge.end_of(c.with(change), c.start);
      expect_same(value.end_with(change.first, change.second, kNone), judged, seed);
      schedules += std::isfinite(judged) ? 1 : 0;
      if (c.rng.uniform() < 0.5) continue;
      c.legs = c.with(change);
      value.replace(change.first, change.second);
      expect_same(value.end_s(), judged, seed);
    }
  }
  EXPECT_GT(schedules, 1000);
}

TEST(ValueOfAnOrder, ACutoffHidesWhatIsNotBelowIt) {
  const planner::Terrain ground = planner::Terrain::flat(0.0);
  Case c(7);
  LinkCache links(FlightModel({}, c.params.battery.model, ground), c.params.charger);
  OrderValue value(links, c.params, c.start);
  value.set(c.legs);
  ASSERT_TRUE(std::isfinite(value.end_s()));
  const auto change = c.change();
  const double end = value.end_with(change.first, change.second, kNone);
  EXPECT_EQ(value.end_with(change.first, change.second, end + 1.0), end);
  EXPECT_TRUE(std::isinf(value.end_with(change.first, change.second, end)));
}

}  // namespace
}  // namespace swallowtail::coverage
