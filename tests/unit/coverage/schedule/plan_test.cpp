#include "coverage/schedule/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

namespace swallowtail::coverage {
namespace {

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

}  // namespace
}  // namespace swallowtail::coverage
