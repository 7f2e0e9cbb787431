#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/property/coverage/replay_task.hpp"

namespace swallowtail::coverage {
namespace {

using testing::IsEmpty;

/// In the quick suite; the slow one asks for more.
std::uint64_t task_count() {
  const char* asked = std::getenv("SWALLOWTAIL_REPLAY_TASKS");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 120;
}

/// To look again at one that failed.
std::uint64_t first_seed() {
  const char* asked = std::getenv("SWALLOWTAIL_REPLAY_FIRST");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 1;
}

TEST(ReplayProperty, PlansOfRandomTasksHoldWhenTheyAreFlownStepByStep) {
  const std::uint64_t tasks = task_count();
  const std::uint64_t first = first_seed();
  std::uint64_t planned = 0;
  std::uint64_t with_recharge = 0;
  std::uint64_t carried = 0;
  std::uint64_t short_of = 0;
  std::uint64_t fetched = 0;
  for (std::uint64_t seed = first; seed < first + tasks; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const test::ReplayTask random = test::random_replay_task(seed);
    const auto plan = plan_coverage(random.task, random.terrain, random.options);
    if (!plan) {
      ASSERT_EQ(plan.error().code, Error::Code::kInfeasible) << plan.error().message;
      continue;
    }
    ++planned;
    const auto verdict = test_support::replay(random.task, *plan, test::question_of(random));
    EXPECT_THAT(verdict.faults, IsEmpty());
    EXPECT_GE(verdict.least_energy, random.task.battery.reserve);
    fetched += plan->depot_visits.size();
    with_recharge += plan->recharges > 0 ? 1 : 0;
    for (const Rendezvous& r : plan->rendezvous) carried += r.carry ? 1 : 0;
    for (const FieldReport& field : plan->fields) short_of += field.status == FieldStatus::kPartly ? 1 : 0;
  }
  EXPECT_GE(planned, tasks * 3 / 4) << "too many tasks are infeasible to say much";
  EXPECT_GE(with_recharge, tasks / 4) << "the tasks are too easy to say anything";
  EXPECT_GE(carried, tasks / 50);
  EXPECT_GE(fetched, tasks / 60);
  EXPECT_LE(short_of, 1 + tasks / 1000) << "fields that are planned with less than 99.9 % covered";
  RecordProperty("planned", static_cast<int>(planned));
}

}  // namespace
}  // namespace swallowtail::coverage
