#include "coverage/schedule/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <string>

#include "coverage/ground/road_network.hpp"

namespace swallowtail::coverage {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Field rectangle(std::uint32_t id, double x, double height_m) {
  return {id, "f" + std::to_string(id), {{{x, 0}, {x + 120, 0}, {x + 120, 60}, {x, 60}}, {}}, height_m};
}

Task two_heights() {
  Task task;
  task.fields = {rectangle(1, 0, 20.0), rectangle(2, 150, 35.0)};
  return task;
}

TEST(Plan, FieldsOfTwoHeightsAreFlownAtTheirHeights) {
  const auto plan = plan_coverage(two_heights(), planner::Terrain::flat(5.0), {});
  ASSERT_TRUE(plan.ok()) << plan.error().message;
  EXPECT_EQ(plan->status, PlanStatus::kComplete);
  EXPECT_EQ(plan->legs.size(), 12U);
  for (const Leg& leg : plan->legs) EXPECT_EQ(leg.entry_m.z(), leg.field_id == 1 ? 25.0 : 40.0);
  EXPECT_GE(plan->covered_percent, 99.99);
  EXPECT_GE(plan->energy_min, 25.0);
}

TEST(Plan, ARefusedFieldLeavesTheOthersPlanned) {
  Task task = two_heights();
  task.fields[1].polygon.outline = {{0, 0}, {10, 10}, {10, 0}, {0, 12}};
  const auto plan = plan_coverage(task, planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->status, PlanStatus::kPartial);
  EXPECT_EQ(plan->fields[1].status, FieldStatus::kRefused);
  EXPECT_THAT(plan->fields[1].reason, HasSubstr("Self-intersection"));
  EXPECT_EQ(plan->legs.size(), 6U);
}

TEST(Plan, BadTasksAreRefusedWithTheRule) {
  const auto why = [](const Task& task) {
    const auto plan = plan_coverage(task, planner::Terrain::flat(0.0), {});
    return plan.ok() ? std::string("planned") : plan.error().message;
  };
  Task task = two_heights();
  task.sensor_width_m = 0.0;
  EXPECT_THAT(why(task), HasSubstr("sensor width"));
  task = two_heights();
  task.battery.reserve = 600.0;
  EXPECT_THAT(why(task), HasSubstr("reserve"));
  task = two_heights();
  task.charger.speed_mps = 0.0;
  EXPECT_THAT(why(task), HasSubstr("speed"));
  task = two_heights();
  task.battery.capacity = 30.0;
  EXPECT_THAT(why(task), HasSubstr("battery"));
  EXPECT_THAT(why(Task{}), HasSubstr("no field"));
}

/// A meadow that one battery does not cover.
Task meadow() {
  Task task;
  task.fields = {{7, "meadow", {{{0, 0}, {300, 0}, {300, 150}, {0, 150}}, {}}, 20.0}};
  task.battery.capacity = 150.0;
  task.battery.reserve = 10.0;
  return task;
}

std::string refusal(const Task& task) {
  const auto plan = plan_coverage(task, planner::Terrain::flat(0.0), {});
  if (!plan.ok()) return plan.error().message;
  return plan->status == PlanStatus::kComplete ? "planned" : plan->fields.back().reason;
}

TEST(Plan, ARobotThatReachesNothingIsNamedWithItsPlace) {
  RoadParams far;
  far.lines = {{Vec2(5000, 5000), Vec2(5100, 5000)}};
  far.speed_mps = 2.0;
  Task task = meadow();
  EXPECT_EQ(refusal(task), "planned");
  task.charger.start_m = Vec3(3.0, 4.0, 0.0);
  task.charger.travel = *RoadNetwork::make(far);
  EXPECT_THAT(refusal(task), HasSubstr("from (3.00, 4.00) m the ground robot reaches none of"));
  task.battery.capacity = 2000.0;
  EXPECT_EQ(refusal(task), "planned") << "one battery does: nobody needs the robot";
}

TEST(Plan, AStartTooFarForTheBatteryIsNamedWithItsPlace) {
  Task task = meadow();
  task.start_m = task.charger.start_m = Vec3(20000, 0, 0);
  EXPECT_THAT(refusal(task), HasSubstr("does not reach the first sub-cell from (20000.00, 0.00) m"));
}

TEST(Plan, ABadFieldIsNamedWithItsPlaceAndTheRule) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto spoilt = [](const auto& spoil) {
    Task task = meadow();
    spoil(task);
    return refusal(task);
  };
  const auto expect = [&](const auto& spoil, const char* rule) {
    EXPECT_THAT(spoilt(spoil), AllOf(HasSubstr("Field 'meadow' near"), HasSubstr(rule)));
  };
  expect([&](Task& t) { t.fields[0].polygon.outline[1].x() = kNaN; }, "Vertex 1 of the outline");
  expect(
      [&](Task& t) {
        t.fields[0].polygon.holes = {{{10, 10}, {20, kNaN}, {20, 20}}};
      },
      "Vertex 1 of hole 0");
  expect([&](Task& t) { t.fields[0].height_m = kNaN; }, "height above ground must be a positive number");
  expect([](Task& t) { t.sensor_width_m = 400.0; }, "sensor is wider (400 m)");
  expect([](Task& t) { t.rules.ceiling_m = 15.0; }, "above the legal ceiling of 15 m");
  expect([](Task& t) { t.fields[0].height_m = 1.0; }, "below the vehicle's clearance");
  expect([](Task& t) { t.battery.capacity = 20.0; }, "does not lift the vehicle");
  expect([](Task& t) { t.battery.capacity = 31.0; }, "it cannot cross the field");
}

TEST(Plan, NarrowArmsSliversAndSpikesAreCovered) {
  const Ring narrow_arm = {{0, 0},      {100, 0},  {100, 40}, {60, 40}, {60, 41.5},
                           {160, 41.5}, {160, 42}, {59, 42},  {59, 40}, {0, 40}};
  const Ring needle = {{0, 0}, {300, 0}, {150, 1}};
  const Ring sliver = {{0, 0}, {300, 0}, {300, 0.05}, {0, 0.05}};
  const Ring spike = {{0, 0}, {100, 0}, {100, 50}, {300, 50.001}, {100, 50.002}, {100, 100}, {0, 100}};
  for (const Ring& outline : {narrow_arm, needle, sliver, spike}) {
    Task task = meadow();
    task.fields[0].polygon = {outline, {}};
    const auto plan = plan_coverage(task, planner::Terrain::flat(0.0), {});
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    EXPECT_EQ(plan->status, PlanStatus::kComplete);
    EXPECT_GE(plan->covered_percent, 99.9);
  }
}

TEST(Plan, ALayeredTourIsComparedWithTheFullGraphWhenAsked) {
  PlanOptions options;
  options.full_graph = FullGraph::kCompare;
  const auto plan = plan_coverage(two_heights(), planner::Terrain::flat(0.0), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_GT(plan->statistics.gtsp_cost, 0.0);
  EXPECT_GE(plan->statistics.full_graph_gap_percent, -0.5);
  EXPECT_LT(plan->statistics.full_graph_gap_percent, 10.0);
  EXPECT_EQ(plan->statistics.vertices, 1 + 12 * 20);
}

TEST(Plan, ADeadlineInThePastStillGivesAPlan) {
  const ManualClock clock;
  PlanOptions options;
  options.clock = &clock;
  options.stop = {.clock = &clock, .deadline_s = 0.0};
  const auto plan = plan_coverage(two_heights(), planner::Terrain::flat(0.0), options);
  ASSERT_TRUE(plan.ok());
  EXPECT_EQ(plan->legs.size(), 12U);
}

TEST(Plan, WhereNoWayLeadsTheAircraftIsCarriedOrThePlanRefused) {
  Task task = two_heights();
  const Ring around{{130, -20}, {290, -20}, {290, 80}, {130, 80}};
  task.no_fly = {{around, {{{140, -10}, {140, 70}, {280, 70}, {280, -10}}}}};
  const auto carried = plan_coverage(task, planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(carried.ok()) << carried.error().message;
  for (std::size_t i = 0; i + 1 < carried->legs.size(); ++i) {
    if (carried->legs[i].field_id != carried->legs[i + 1].field_id) {
      EXPECT_EQ(carried->legs[i].transfer, Transfer::kFDTU);
    }
  }
  task.fields.erase(task.fields.begin());
  const auto refused = plan_coverage(task, planner::Terrain::flat(0.0), {});
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, AllOf(HasSubstr("no way"), HasSubstr("'f2'"), HasSubstr("no-fly")));
}

TEST(WaysOf, GoRoundAHoleThatANoFlyAreaJoinsToTheOutside) {
  Task task;
  task.fields = {
      {1, "holed", {{{0, 0}, {100, 0}, {100, 50}, {0, 50}}, {{{40, 5}, {40, 20}, {60, 20}, {60, 5}}}}, 20.0}};
  task.no_fly = {{{{45, -20}, {55, -20}, {55, 10}, {45, 10}}, {}}};
  const std::vector<Polygon> cut{{{{0, 0},
                                   {45, 0},
                                   {45, 5},
                                   {40, 5},
                                   {40, 20},
                                   {60, 20},
                                   {60, 5},
                                   {55, 5},
                                   {55, 0},
                                   {100, 0},
                                   {100, 50},
                                   {0, 50}},
                                  {}}};
  const Ways ways = ways_of(task, cut);
  EXPECT_FALSE(ways.is_free({30, -5}, {58, 15}));
  EXPECT_FALSE(ways.is_free({57, -5}, {57, 60}));
  EXPECT_TRUE(ways.is_free({65, -5}, {65, 60}));
}

/// With the document's energy model a unit is a second aloft, to the last digit.
TEST(Plan, WhatIsCarriedAcrossANoFlyAreaAddsUpLikeAnyOther) {
  Task task;
  task.fields = {{1, "moated", {{{0, 0}, {100, 0}, {100, 40}, {0, 40}}, {}}, 20.0}};
  task.no_fly = {{{{20, 5}, {60, 5}, {60, 35}, {20, 35}}, {{{30, 10}, {30, 30}, {50, 30}, {50, 10}}}}};
  const auto plan = plan_coverage(task, planner::Terrain::flat(0.0), {});
  ASSERT_TRUE(plan.ok()) << plan.error().message;
  EXPECT_GE(plan->rendezvous.size(), 1U);
  EXPECT_NEAR(plan->energy_used, plan->flight_s, 1e-9);
}

/// A field that is refused is not flown, and its holes are not flown over.
TEST(Plan, HolesOfARefusedFieldAreGoneRound) {
  Task task;
  task.fields = {
      {1, "low", {{{0, 0}, {100, 0}, {100, 50}, {0, 50}}, {{{40, 10}, {40, 40}, {60, 40}, {60, 10}}}}, 1.0},
      {2, "beside", {{{0, 60}, {100, 60}, {100, 90}, {0, 90}}, {}}, 20.0}};
  const FieldsCut cut = cut_fields(task, planner::Terrain::flat(0.0), {});
  ASSERT_EQ(cut.reports.front().status, FieldStatus::kRefused);
  EXPECT_FALSE(ways_of(task, cut.polygons).is_free({50, -10}, {50, 70}));
}

/// Such a hole is a notch of the clean field's outline.
TEST(Plan, AHoleThatSticksOutOfItsFieldIsGoneRoundAllTheSame) {
  Task task;
  task.fields = {{1,
                  "holed",
                  {{{0, 0}, {100, 0}, {100, 50}, {0, 50}}, {{{40, -1}, {40, 20}, {60, 20}, {60, -1}}}},
                  20.0}};
  const FieldsCut cut = cut_fields(task, planner::Terrain::flat(0.0), {});
  ASSERT_EQ(cut.polygons.size(), 1U) << cut.reports.front().reason;
  EXPECT_TRUE(cut.polygons.front().holes.empty());
  const Ways ways = ways_of(task, cut.polygons);
  EXPECT_FALSE(ways.is_free({50, -10}, {50, 60}));
  EXPECT_TRUE(ways.is_free({65, -10}, {65, 60}));
}

}  // namespace
}  // namespace swallowtail::coverage
