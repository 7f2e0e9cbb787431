#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "coverage/maintain/plan_keeper.hpp"
#include "planner/base/rng.hpp"

/// States in any order, with any content: the keeper refuses what makes no sense and stays sane.
namespace swallowtail::coverage {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Task small_task() {
  Task task;
  task.fields.push_back({1, "field", {{{0, 0}, {120, 0}, {120, 60}, {0, 60}}, {}}, 15.0});
  task.battery.capacity = 90.0;
  task.battery.reserve = 8.0;
  task.start_m = task.charger.start_m = Vec3(-5.0, -5.0, 0.0);
  return task;
}

Vec3 random_place(Rng& rng) {
  return {rng.uniform(-50.0, 200.0), rng.uniform(-50.0, 120.0), rng.uniform(0.0, 40.0)};
}

/// Somewhere, somehow; often in the middle of a leg.
AircraftView random_vehicle(Rng& rng, const LivePlan& plan, double time_s) {
  AircraftView view;
  view.time_s = time_s;
  view.position_m = random_place(rng);
  view.mode = static_cast<AircraftMode>(rng.below(5));
  view.legs_done = rng.below(plan.legs.size() + 2);
  view.leg_index = view.legs_done;
  if (rng.uniform() < 0.6 && view.legs_done < plan.legs.size()) {
    const Leg& leg = plan.legs[view.legs_done];
    view.position_m = leg.entry_m + rng.uniform() * (leg.exit_m - leg.entry_m);
    view.velocity_mps = 8.0 * (leg.exit_m - leg.entry_m).normalized();
    view.mode = AircraftMode::kFlying;
  }
  if (view.on_ground()) view.position_m.z() = 0.0;
  return view;
}

void expect_sane(const PlanKeeper& keeper) {
  const LivePlan& plan = keeper.plan();
  ASSERT_LE(plan.legs_done, plan.legs.size());
  ASSERT_TRUE(std::isfinite(plan.end_s));
  for (const Leg& leg : plan.legs) {
    ASSERT_TRUE(leg.entry_m.allFinite() && leg.exit_m.allFinite());
    ASSERT_TRUE(std::isfinite(leg.energy_before) && std::isfinite(leg.energy_after));
    ASSERT_LE(leg.start_s, leg.end_s + 1e-6);
  }
  for (const Rendezvous& meeting : plan.rendezvous) {
    ASSERT_TRUE(meeting.site_m.allFinite() && std::isfinite(meeting.charge_to));
    ASSERT_LE(meeting.charge_to, keeper.task().battery.capacity + 1e-6);
  }
}

class BadStates : public testing::Test {
 protected:
  void SetUp() override {
    auto made = PlanKeeper::make(small_task(), planner::Terrain::flat(0.0), params());
    ASSERT_TRUE(made.ok()) << made.error().message;
    fresh_.emplace(std::move(*made));
  }
  static KeeperParams params() {
    KeeperParams out;
    out.resolve_schedules = 30;
    return out;
  }
  std::optional<PlanKeeper> fresh_;
};

TEST_F(BadStates, WhateverComesThePlanStaysSane) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    PlanKeeper keeper = *fresh_;
    double time_s = 0.0;
    std::uint32_t revision = keeper.plan().revision;
    for (int i = 0; i < 60; ++i) {
      time_s += rng.uniform(0.0, 20.0);
      const std::uint64_t kind = rng.below(3);
      bool changed = false;
      if (kind == 0) changed = keeper.on_vehicle(random_vehicle(rng, keeper.plan(), time_s));
      if (kind == 1) {
        const double capacity = rng.uniform(0.5, 1.1) * small_task().battery.capacity;
        const double most = std::min(capacity, keeper.task().battery.capacity);
        changed = keeper.on_battery({time_s, rng.uniform() * most, capacity});
      }
      if (kind == 2)
        changed = keeper.on_robot({time_s, random_place(rng), rng.uniform() < 0.3, rng.uniform() < 0.3});
      EXPECT_EQ(changed, keeper.plan().revision > revision);
      revision = keeper.plan().revision;
      expect_sane(keeper);
      if (HasFatalFailure()) return;
    }
    EXPECT_EQ(keeper.refused(), 0U);
  }
}

TEST_F(BadStates, WhatIsNotFiniteOrLateIsCountedAndChangesNothing) {
  PlanKeeper keeper = *fresh_;
  AircraftView vehicle;
  vehicle.time_s = 100.0;
  vehicle.position_m = small_task().start_m;
  keeper.on_vehicle(vehicle);
  keeper.on_battery({100.0, 90.0, 90.0});
  keeper.on_robot({100.0, small_task().start_m, false, false});
  const LivePlan before = keeper.plan();
  std::uint64_t refused = 0;
  const auto refuses = [&](bool changed) {
    EXPECT_FALSE(changed);
    EXPECT_EQ(keeper.refused(), ++refused);
    EXPECT_EQ(keeper.plan().revision, before.revision);
  };
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    AircraftView no_time = vehicle;
    no_time.time_s = bad;
    refuses(keeper.on_vehicle(no_time));
    for (Vec3 AircraftView::*member : {&AircraftView::position_m, &AircraftView::velocity_mps}) {
      AircraftView view = vehicle;
      (view.*member).y() = bad;
      refuses(keeper.on_vehicle(view));
    }
    refuses(keeper.on_battery({bad, 50.0, 90.0}));
    refuses(keeper.on_battery({101.0, bad, 90.0}));
    refuses(keeper.on_battery({101.0, 50.0, bad}));
    refuses(keeper.on_robot({bad, small_task().start_m, false, false}));
    refuses(keeper.on_robot({101.0, Vec3(bad, 0.0, 0.0), false, false}));
  }
  refuses(keeper.on_battery({101.0, -1.0, 90.0}));
  vehicle.time_s = 99.0;
  refuses(keeper.on_vehicle(vehicle));
  refuses(keeper.on_battery({99.0, 50.0, 90.0}));
  refuses(keeper.on_robot({99.0, small_task().start_m, false, false}));
}

}  // namespace
}  // namespace swallowtail::coverage
