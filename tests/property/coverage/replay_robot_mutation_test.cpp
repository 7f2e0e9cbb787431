#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/property/coverage/spoilt_plans.hpp"

/// What the replay is good for as far as a robot with a battery of its own goes.
namespace swallowtail::coverage {
namespace {

using test::expect_caught;
using test::Planned;
using test::plans_with_weak_robots;

TEST(ReplayMutation, WeakRobotsFetchNewEnergyAndTheirPlansHold) {
  EXPECT_GE(plans_with_weak_robots().size(), 3U);
  for (const Planned& planned : plans_with_weak_robots()) {
    SCOPED_TRACE("seed " + std::to_string(planned.seed));
    const auto verdict =
        test_support::replay(planned.random.task, planned.plan, test::question_of(planned.random));
    EXPECT_THAT(verdict.faults, testing::IsEmpty());
  }
}

TEST(ReplayMutation, ARobotThatDoesNotFetchNewEnergy) {
  expect_caught(
      [](Plan& plan, const Task&) {
        plan.depot_visits.clear();
        return true;
      },
      "the robot's energy", plans_with_weak_robots());
}

TEST(ReplayMutation, ARobotThatHoldsLessThanIsSaid) {
  expect_caught(
      [](Plan& plan, const Task&) {
        plan.rendezvous.back().robot_energy += 1.0;
        return true;
      },
      "robot's energy", plans_with_weak_robots());
  expect_caught(
      [](Plan& plan, const Task&) {
        plan.rendezvous.front().robot_energy_left += 1.0;
        return true;
      },
      "robot's energy left", plans_with_weak_robots());
}

TEST(ReplayMutation, ARendezvousThatDoesNotKnowOfTheDepot) {
  expect_caught(
      [](Plan& plan, const Task&) {
        plan.rendezvous.front().by_depot = !plan.rendezvous.front().by_depot;
        return true;
      },
      "the plan says otherwise", plans_with_weak_robots());
}

TEST(ReplayMutation, ARobotThatLeavesItsDepotTooSoon) {
  expect_caught(
      [](Plan& plan, const Task&) {
        plan.depot_visits.front().leaves_s -= 1.0;
        return true;
      },
      "departure from its depot", plans_with_weak_robots());
}

TEST(ReplayMutation, ARobotThatIsHomeTooSoon) {
  expect_caught(
      [](Plan& plan, const Task&) {
        plan.robot_home_s -= 1.0;
        return true;
      },
      "the robot's arrival at home", plans_with_weak_robots());
}

}  // namespace
}  // namespace swallowtail::coverage
