#include "coverage/maintain/plan_keeper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/coverage/maintain/on_leg.hpp"

namespace swallowtail::coverage {
namespace {

/// A field of 240 × 120 m with a hole of 80 × 60 m in its middle, and a battery for a part of it.
Task holed_task() {
  Task task;
  const Polygon field{{{0, 0}, {240, 0}, {240, 120}, {0, 120}}, {{{80, 30}, {80, 90}, {160, 90}, {160, 30}}}};
  task.fields.push_back({1, "holed", field, 20.0});
  task.sweep_rad = 0.0;
  task.battery.capacity = 220.0;
  task.start_m = Vec3(0.0, -5.0, 0.0);
  task.charger.start_m = Vec3(0.0, -5.0, 0.0);
  return task;
}

/// Metres of a flight that lie deeper than 10 cm within the hole.
double within_hole_m(const Vec3& from, const Vec3& to) {
  const double length = (to - from).norm();
  double out = 0.0;
  for (double s = 0.1; s < length; s += 0.1) {
    const Vec3 p = from + (to - from) * (s / length);
    if (p.x() > 80.1 && p.x() < 159.9 && p.y() > 30.1 && p.y() < 89.9) out += 0.1;
  }
  return out;
}

double flown_within_hole_m(const LivePlan& plan, std::size_t first) {
  double out = 0.0;
  for (std::size_t i = first; i < plan.legs.size(); ++i) {
    const Leg& leg = plan.legs[i];
    out += within_hole_m(leg.entry_m, leg.exit_m);
    if (i + 1 == plan.legs.size() || leg.transfer == Transfer::kFDTU) continue;
    Vec3 at = leg.exit_m;
    for (const Vec3& bend : leg.transfer_m) {
      out += within_hole_m(at, bend);
      at = bend;
    }
    out += within_hole_m(at, plan.legs[i + 1].entry_m);
  }
  return out;
}

class Keeper : public testing::Test {
 protected:
  /// Takes off and flies a share of a leg, then the battery turns out to hold this much.
  static bool break_battery(PlanKeeper& keeper, std::size_t leg, double energy, double share = 0.5) {
    AircraftView start;
    start.position_m = Vec3(0.0, -5.0, 0.0);
    keeper.on_vehicle(start);
    keeper.on_battery({0.0, keeper.task().battery.capacity});
    for (std::size_t i = 0; i <= leg; ++i) {
      for (int step = 0; step <= 100; ++step)
        keeper.on_vehicle(on_leg(keeper.plan(), i, 0.01 * step * (i < leg ? 1.0 : share)));
    }
    return keeper.on_battery({on_leg(keeper.plan(), leg, share).time_s, energy});
  }
};

TEST_F(Keeper, WhatIsScheduledAnewFliesRoundHoles) {
  auto made = PlanKeeper::make(holed_task(), planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok()) << made.error().message;
  ASSERT_LT(flown_within_hole_m(made->plan(), 0), 0.2);
  PlanKeeper resumed(holed_task(), planner::Terrain::flat(0.0), {}, made->plan());
  for (PlanKeeper* keeper : {&*made, &resumed}) {
    const double needs = keeper->plan().legs[1].energy_before - keeper->plan().legs[2].energy_after;
    ASSERT_TRUE(break_battery(*keeper, 1, keeper->task().battery.reserve + needs + 25.0))
        << keeper->plan().reason;
    EXPECT_LT(flown_within_hole_m(keeper->plan(), 1), 0.2) << keeper->plan().reason;
  }
}

/// Two meadows, with a wall between them that must not be flown over.
TEST_F(Keeper, WhatComesAfterALandingAtOnceGoesRoundNoFlyAreas) {
  Task task = holed_task();
  task.fields = {{1, "west", {{{0, 0}, {60, 0}, {60, 60}, {0, 60}}, {}}, 20.0},
                 {2, "east", {{{80, 0}, {140, 0}, {140, 60}, {80, 60}}, {}}, 20.0}};
  task.no_fly.push_back({{{65, -40}, {75, -40}, {75, 50}, {65, 50}}, {}});
  auto made = PlanKeeper::make(task, planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok()) << made.error().message;
  std::size_t landings = 0;
  for (std::size_t leg = 0; leg < made->plan().legs.size(); ++leg) {
    PlanKeeper keeper = *made;
    break_battery(keeper, leg, keeper.task().battery.reserve + 1.0, 0.999);
    const LivePlan& plan = keeper.plan();
    if (plan.reason.find("lands at once") == std::string::npos) continue;
    ++landings;
    for (std::size_t i = plan.legs_done; i + 1 < plan.legs.size(); ++i) {
      const Vec3 from = plan.legs[i].exit_m;
      const Vec3 way = plan.legs[i + 1].entry_m - from;
      const double y_at_wall_m = from.y() + way.y() / way.x() * (70.0 - from.x());
      const bool crosses = (from.x() < 70.0) != (from.x() + way.x() < 70.0) && y_at_wall_m < 49.0;
      EXPECT_TRUE(!crosses || !plan.legs[i].transfer_m.empty()) << "broken on leg " << leg << ", after " << i;
    }
  }
  EXPECT_GT(landings, 5U);
}

TEST_F(Keeper, ABatteryThatHoldsLessChangesWhatIsAheadOnly) {
  auto made = PlanKeeper::make(holed_task(), planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok());
  const LivePlan before = made->plan();
  ASSERT_TRUE(break_battery(*made, 2, made->task().battery.reserve + 45.0));
  const LivePlan& after = made->plan();
  EXPECT_GT(after.revision, before.revision);
  EXPECT_FALSE(after.reason.empty());
  ASSERT_GE(after.legs.size(), before.legs.size());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after.legs[i].sub_cell_id, before.legs[i].sub_cell_id);
    EXPECT_EQ(after.legs[i].exit_m, before.legs[i].exit_m);
  }
  double flown_m = 0.0;
  double planned_m = 0.0;
  for (const Leg& leg : before.legs) planned_m += (leg.exit_m - leg.entry_m).norm();
  for (const Leg& leg : after.legs) flown_m += (leg.exit_m - leg.entry_m).norm();
  EXPECT_NEAR(flown_m, planned_m, 1e-6) << "all of it is still in the plan";
  for (const Rendezvous& meeting : after.rendezvous)
    EXPECT_GE(meeting.energy_from, made->task().battery.reserve - 1e-6);
}

TEST_F(Keeper, LongPastItsTimeToLeaveItSaysWhatHoldsItUp) {
  struct Case {
    AircraftMode mode;
    double heard_s;  ///< of the robot, before the end
    bool is_ready;
    const char* holder;
  };
  for (const Case& one : {Case{AircraftMode::kDocked, 0.0, true, "for a safe path from the robot"},
                          Case{AircraftMode::kDocked, 0.0, false, "for the robot to let it go"},
                          Case{AircraftMode::kLanded, 0.0, false, "for the robot to come"},
                          Case{AircraftMode::kDocked, 130.0, true, "for the robot, which is silent"}}) {
    auto made = PlanKeeper::make(holed_task(), planner::Terrain::flat(0.0), {});
    ASSERT_TRUE(made.ok());
    made->on_vehicle({.position_m = made->task().start_m});
    for (int step = 0; step <= 100; ++step) made->on_vehicle(on_leg(made->plan(), 0, 0.01 * step));
    const Rendezvous meeting = made->plan().rendezvous.front();
    AircraftView landed;
    landed.time_s = meeting.depart_s + 121.0;
    landed.position_m = meeting.site_m;
    landed.mode = one.mode;
    landed.legs_done = legs_before(meeting.id);
    made->on_robot({.time_s = landed.time_s - one.heard_s,
                    .position_m = meeting.site_m,
                    .has_vehicle = true,
                    .is_ready = one.is_ready});
    made->on_vehicle(landed);
    landed.time_s += 130.0;
    made->on_robot({.time_s = landed.time_s - one.heard_s,
                    .position_m = meeting.site_m,
                    .has_vehicle = true,
                    .is_ready = one.is_ready});
    EXPECT_TRUE(made->on_vehicle(landed));
    EXPECT_NE(made->plan().reason.find(one.holder), std::string::npos) << made->plan().reason;
    landed.time_s += 130.0;
    made->on_robot({.time_s = landed.time_s, .position_m = meeting.site_m, .has_vehicle = true});
    const std::string next = landed.mode == AircraftMode::kDocked ? "for the robot to let it go" : one.holder;
    EXPECT_EQ(made->on_vehicle(landed), next != one.holder) << "another holder is news, the same one is not";
    EXPECT_NE(made->plan().reason.find(next), std::string::npos) << made->plan().reason;
  }
}

TEST_F(Keeper, AStripThatCannotBeFlownIsGivenUpWithAReason) {
  KeeperParams params;
  params.gap_tries = 0;
  auto made = PlanKeeper::make(holed_task(), planner::Terrain::flat(0.0), params);
  ASSERT_TRUE(made.ok());
  AircraftView start;
  made->on_vehicle(start);
  const double length = (made->plan().legs[0].exit_m - made->plan().legs[0].entry_m).norm();
  for (int step = 0; step <= 100; ++step) {
    AircraftView beside = on_leg(made->plan(), 0, 0.01 * step);
    beside.position_m.z() += 10.0;
    made->on_vehicle(beside);
  }
  EXPECT_TRUE(made->complete());
  EXPECT_TRUE(made->on_vehicle(on_leg(made->plan(), 1, 0.0)));
  EXPECT_FALSE(made->complete());
  EXPECT_NE(made->plan().reason.find("given up"), std::string::npos) << made->plan().reason;
  EXPECT_NEAR(made->unflown_m(), length, 1.0);
  ASSERT_TRUE(break_battery(*made, 2, made->task().battery.reserve + 45.0));
  EXPECT_NE(made->plan().reason.find("given up"), std::string::npos) << made->plan().reason;
}

TEST_F(Keeper, WhatIsLeftOutIsSaidWithEveryReason) {
  Task task = holed_task();
  task.fields.push_back({7, "islet", {{{300, 0}, {304, 0}, {304, 4}, {300, 4}}, {}}, 20.0});
  auto made = PlanKeeper::make(task, planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok()) << made.error().message;
  ASSERT_FALSE(made->complete());
  ASSERT_NE(made->plan().reason.find("field 7"), std::string::npos) << made->plan().reason;
  ASSERT_TRUE(break_battery(*made, 1, made->task().battery.reserve + 45.0));
  EXPECT_NE(made->plan().reason.find("; field 7"), std::string::npos) << made->plan().reason;
  EXPECT_FALSE(made->complete());
}

TEST_F(Keeper, OfALegLeftOutInPartThePlanKeepsWhatWasFlown) {
  auto made = PlanKeeper::make(holed_task(), planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok());
  made->on_vehicle(AircraftView{});
  const Leg planned = made->plan().legs[0];
  ASSERT_EQ(planned.transfer, Transfer::kFF);
  for (int step = 0; step <= 100; ++step) {
    AircraftView view = on_leg(made->plan(), 0, 0.01 * step);
    view.covering = step < 60;
    made->on_vehicle(view);
  }
  made->on_vehicle(on_leg(made->plan(), 1, 0.0));
  const Leg& flown = made->plan().legs[0];
  const double length = (planned.exit_m - planned.entry_m).norm();
  EXPECT_EQ(flown.entry_m, planned.entry_m);
  EXPECT_NEAR((flown.exit_m - flown.entry_m).norm(), 0.6 * length, 0.02 * length);
}

TEST_F(Keeper, ALegThatThePlannerPassedOverIsFlownLater) {
  auto made = PlanKeeper::make(holed_task(), planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok());
  made->on_vehicle(AircraftView{});
  const Leg passed_over = made->plan().legs[0];
  ASSERT_EQ(passed_over.transfer, Transfer::kFF);
  for (int step = 0; step <= 100; ++step) {
    AircraftView view = on_leg(made->plan(), 1, 0.01 * step);
    view.legs_done = 0;
    made->on_vehicle(view);
  }
  made->on_vehicle(on_leg(made->plan(), 2, 0.0));
  EXPECT_EQ(made->plan().legs[0].kind, LegKind::kReposition) << "nothing of it is flown";
  EXPECT_EQ(made->plan().legs[1].kind, LegKind::kCover);
  EXPECT_FALSE(made->complete()) << "it is to be flown yet";
}

TEST_F(Keeper, ALegPassedOverInNoTimeIsFlownLater) {
  auto made = PlanKeeper::make(holed_task(), planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok());
  made->on_vehicle(AircraftView{});
  for (int step = 0; step <= 100; ++step) made->on_vehicle(on_leg(made->plan(), 0, 0.01 * step));
  AircraftView beyond = on_leg(made->plan(), 2, 0.0);
  beyond.time_s = made->plan().legs[0].end_s + 0.1;
  made->on_vehicle(beyond);
  EXPECT_EQ(made->plan().legs[0].kind, LegKind::kCover);
  EXPECT_EQ(made->plan().legs[1].kind, LegKind::kReposition) << "there was no time to fly it";
  EXPECT_FALSE(made->complete());
}

/// Metres of a new field's middle line that no leg of the plan passes within half a width.
double unplanned_m(const LivePlan& plan, const Vec2& from, const Vec2& to) {
  double out = 0.0;
  for (double share = 0.005; share < 1.0; share += 0.01) {
    const Vec2 p = from + share * (to - from);
    const bool seen = std::any_of(plan.legs.begin(), plan.legs.end(), [&](const Leg& leg) {
      const Vec2 way = (leg.exit_m - leg.entry_m).head<2>();
      if (way.norm() < 1e-9) return false;
      const double t = std::clamp((p - leg.entry_m.head<2>()).dot(way) / way.squaredNorm(), 0.0, 1.0);
      return (p - leg.entry_m.head<2>() - t * way).norm() <= 0.5 * leg.width_m + 0.2;
    });
    if (!seen) out += 0.01 * (to - from).norm();
  }
  return out;
}

TEST_F(Keeper, ChangedFieldsInFlightKeepWhatIsFlownAndPlanTheRest) {
  auto made = PlanKeeper::make(holed_task(), planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok());
  break_battery(*made, 2, 200.0);
  const LivePlan before = made->plan();
  Task wider = holed_task();
  wider.revision = 2;
  wider.fields[0].polygon.outline = {{0, 0}, {300, 0}, {300, 120}, {0, 120}};
  const Status changed = made->change_task(wider);
  ASSERT_TRUE(changed.ok()) << changed.error().message;
  const LivePlan& after = made->plan();
  EXPECT_GT(after.revision, before.revision);
  EXPECT_NE(after.reason.find("fields were changed"), std::string::npos) << after.reason;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after.legs[i].sub_cell_id, before.legs[i].sub_cell_id);
    EXPECT_EQ(after.legs[i].exit_m, before.legs[i].exit_m);
  }
  EXPECT_LT(unplanned_m(after, {270, 1}, {270, 119}), 1.5) << "the new part";
  EXPECT_LT(unplanned_m(after, {40, 1}, {40, 119}), 1.5) << "the old part";
  double seen_again_m = 0.0;
  for (std::size_t i = 3; i < after.legs.size(); ++i) {
    const Leg& leg = after.legs[i];
    for (std::size_t j = 0; j < 2; ++j) {
      const Leg& flown = after.legs[j];
      if (std::abs(leg.entry_m.y() - flown.entry_m.y()) > 1.0) continue;
      const double lo =
          std::max(std::min(leg.entry_m.x(), leg.exit_m.x()), std::min(flown.entry_m.x(), flown.exit_m.x()));
      const double hi =
          std::min(std::max(leg.entry_m.x(), leg.exit_m.x()), std::max(flown.entry_m.x(), flown.exit_m.x()));
      seen_again_m += std::max(0.0, hi - lo);
    }
  }
  EXPECT_LT(seen_again_m, 3.0) << "what is flown is not flown again";
}

TEST_F(Keeper, ChangedFieldsThatCannotBePlannedLeaveThePlanAsItIs) {
  auto made = PlanKeeper::make(holed_task(), planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(made.ok());
  break_battery(*made, 2, 200.0);
  const std::uint32_t revision = made->plan().revision;
  Task sliver = holed_task();
  sliver.fields[0].polygon = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}};
  EXPECT_FALSE(made->change_task(sliver).ok());
  Task other = holed_task();
  other.vehicle_id = 7;
  const Status refused = made->change_task(other);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("another aircraft"), std::string::npos);
  EXPECT_EQ(made->plan().revision, revision);
}

}  // namespace
}  // namespace swallowtail::coverage
