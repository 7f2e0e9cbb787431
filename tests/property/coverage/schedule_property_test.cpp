#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coverage/schedule/plan.hpp"
#include "tests/property/coverage/random_task.hpp"
#include "tests/property/coverage/validate_schedule.hpp"

namespace swallowtail::coverage {
namespace {

using testing::IsEmpty;

constexpr int kTasks = 40;

TEST(ScheduleProperty, RandomTasksArePlannedWholeAndHoldUnderAnIndependentJudge) {
  int with_recharge = 0;
  int carried = 0;
  for (std::uint64_t seed = 1; seed <= kTasks; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    const Task task = test::random_task(rng);
    PlanOptions options;
    const auto plan = plan_coverage(task, planner::Terrain::flat(rng.uniform(-5.0, 5.0)), options);
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    EXPECT_EQ(plan->status, PlanStatus::kComplete);
    EXPECT_GE(plan->covered_percent, 99.9);
    EXPECT_THAT(test::faults_of(*plan, task, options.lead_s), IsEmpty());
    with_recharge += plan->recharges > 0 ? 1 : 0;
    for (const Rendezvous& r : plan->rendezvous) carried += r.carry ? 1 : 0;
  }
  EXPECT_GT(with_recharge, kTasks / 4) << "the tasks are too easy to say anything";
  EXPECT_GT(carried, 0);
}

TEST(ScheduleProperty, TheSameSeedGivesTheSamePlan) {
  for (std::uint64_t seed = 100; seed < 104; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    const Task task = test::random_task(rng);
    const auto first = plan_coverage(task, planner::Terrain::flat(0.0), {});
    const auto second = plan_coverage(task, planner::Terrain::flat(0.0), {});
    ASSERT_TRUE(first.ok() && second.ok());
    ASSERT_EQ(first->legs.size(), second->legs.size());
    for (std::size_t i = 0; i < first->legs.size(); ++i) {
      EXPECT_EQ(first->legs[i].sub_cell_id, second->legs[i].sub_cell_id);
      EXPECT_EQ(first->legs[i].entry_m, second->legs[i].entry_m);
      EXPECT_EQ(first->legs[i].energy_before, second->legs[i].energy_before);
    }
  }
}

TEST(ScheduleProperty, ALargerBatteryNeverTakesMuchLonger) {
  // The order search is a heuristic: a little slack, but never a different league.
  for (std::uint64_t seed = 200; seed < 210; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    Task task = test::random_task(rng);
    const auto small = plan_coverage(task, planner::Terrain::flat(0.0), {});
    ASSERT_TRUE(small.ok());
    task.battery.capacity *= 2.0;
    const auto large = plan_coverage(task, planner::Terrain::flat(0.0), {});
    ASSERT_TRUE(large.ok());
    EXPECT_LE(large->makespan_s, 1.02 * small->makespan_s);
  }
}

}  // namespace
}  // namespace swallowtail::coverage
