#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/property/coverage/replay_task.hpp"

/// What the replay is good for: plans that hold are spoilt one way after another, and each must be caught.
namespace swallowtail::coverage {
namespace {

using testing::HasSubstr;

/// Spoils a plan; false where it has nothing to spoil.
using Spoil = std::function<bool(Plan&, const Task&)>;

std::size_t leg_after(const Rendezvous& meeting) { return legs_before(meeting.id); }

/// Everything from a rendezvous' departure on happens earlier.
void hasten(Plan& plan, std::size_t first, double by_s) {
  plan.rendezvous[first].depart_s -= by_s;
  for (std::size_t i = leg_after(plan.rendezvous[first]); i < plan.legs.size(); ++i) {
    plan.legs[i].start_s -= by_s;
    plan.legs[i].end_s -= by_s;
  }
  for (std::size_t k = first + 1; k < plan.rendezvous.size(); ++k) {
    for (double* time : {&plan.rendezvous[k].robot_arrives_s, &plan.rendezvous[k].land_s,
                         &plan.rendezvous[k].arrive_by_s, &plan.rendezvous[k].depart_s})
      *time -= by_s;
  }
  plan.makespan_s -= by_s;
  plan.cost -= by_s;
}

/// Less energy from a rendezvous' departure to the next landing, wherever the plan speaks of it.
void weaken(Plan& plan, std::size_t at, double by) {
  const bool last = at + 1 == plan.rendezvous.size();
  const std::size_t past = last ? plan.legs.size() : leg_after(plan.rendezvous[at + 1]);
  for (std::size_t i = leg_after(plan.rendezvous[at]); i < past; ++i) {
    plan.legs[i].energy_before -= by;
    plan.legs[i].energy_after -= by;
  }
  if (!last) plan.rendezvous[at + 1].energy_from -= by;
  plan.rendezvous[at].charge_to -= by;
}

struct Planned {
  std::uint64_t seed = 0;
  test::ReplayTask random;
  Plan plan;
};

/// Made once for all tests here.
const std::vector<Planned>& plans() {
  static const std::vector<Planned> kPlans = [] {
    std::vector<Planned> out;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      Planned one{seed, test::random_replay_task(seed), {}};
      auto plan = plan_coverage(one.random.task, one.random.terrain, one.random.options);
      if (!plan) continue;
      one.plan = std::move(*plan);
      out.push_back(std::move(one));
    }
    return out;
  }();
  return kPlans;
}

/// The same over open ground, with a robot whose own battery does for the greatest charge and little more.
const std::vector<Planned>& plans_with_weak_robots() {
  static const std::vector<Planned> kPlans = [] {
    std::vector<Planned> out;
    for (const Planned& planned : plans()) {
      if (planned.plan.rendezvous.size() < 2 || planned.random.task.charger.travel) continue;
      Planned one = planned;
      double most = 0.0;
      for (const Rendezvous& r : one.plan.rendezvous) most = std::max(most, r.charge_to - r.energy_from);
      one.random.task.charger.battery = {1.1 * most + 20.0, 0.02, 1.0, 20.0};
      auto plan = plan_coverage(one.random.task, one.random.terrain, one.random.options);
      if (!plan || plan->depot_visits.empty()) continue;
      one.plan = std::move(*plan);
      out.push_back(std::move(one));
    }
    return out;
  }();
  return kPlans;
}

/// Spoils up to five plans and expects each to be caught.
void expect_caught(const Spoil& spoil, const std::string& fault,
                   const std::vector<Planned>& sound = plans()) {
  int spoilt = 0;
  for (const Planned& planned : sound) {
    SCOPED_TRACE("seed " + std::to_string(planned.seed));
    Plan plan = planned.plan;
    if (!spoil(plan, planned.random.task)) continue;
    const auto verdict = test_support::replay(planned.random.task, plan, test::question_of(planned.random));
    EXPECT_THAT(verdict.faults, testing::Contains(HasSubstr(fault)));
    if (++spoilt == 5) break;
  }
  EXPECT_GT(spoilt, 0) << "no plan to spoil";
}

TEST(ReplayMutation, ALowerChargeBreaksTheReserve) {
  expect_caught(
      [](Plan& plan, const Task& task) {
        if (plan.rendezvous.empty()) return false;
        weaken(plan, 0, 0.2 * task.battery.capacity);
        return true;
      },
      "energy on landing");
}

TEST(ReplayMutation, AChargeBeyondTheCapacity) {
  expect_caught(
      [](Plan& plan, const Task& task) {
        if (plan.rendezvous.empty()) return false;
        weaken(plan, 0, plan.rendezvous[0].charge_to - task.battery.capacity - 1.0);
        return true;
      },
      "capacity");
}

TEST(ReplayMutation, ADepartureBeforeTheChargeIsIn) {
  expect_caught(
      [](Plan& plan, const Task&) {
        if (plan.rendezvous.empty()) return false;
        hasten(plan, 0, 2.0);
        return true;
      },
      "departure");
}

TEST(ReplayMutation, ACarriageFasterThanTheRobot) {
  int slowed = 0;
  for (const Planned& planned : plans()) {
    const auto& meetings = planned.plan.rendezvous;
    if (std::none_of(meetings.begin(), meetings.end(), [](const Rendezvous& r) { return r.carry; })) continue;
    Task task = planned.random.task;
    task.battery.charge_s_per_unit = 0.0;
    task.charger.speed_mps *= 1e-3;
    test_support::ReplayQuestion question = test::question_of(planned.random);
    question.robot.road_speed_mps *= 1e-3;
    question.robot.off_road_speed_mps *= 1e-3;
    const auto verdict = test_support::replay(task, planned.plan, question);
    EXPECT_THAT(verdict.faults, testing::Contains(HasSubstr("departure"))) << "seed " << planned.seed;
    ++slowed;
  }
  EXPECT_GT(slowed, 0) << "no plan to spoil";
}

TEST(ReplayMutation, ARobotThatArrivesTooSoon) {
  expect_caught(
      [](Plan& plan, const Task&) {
        for (Rendezvous& r : plan.rendezvous) {
          if (r.wait_s < 5.0) continue;
          r.robot_arrives_s -= 3.0;
          return true;
        }
        return false;
      },
      "robot's arrival");
}

TEST(ReplayMutation, ALegThatIsLeftOut) {
  expect_caught(
      [](Plan& plan, const Task&) {
        if (plan.legs.size() < 3) return false;
        plan.legs.erase(plan.legs.begin() + 1);
        return true;
      },
      "is not flown once");
}

TEST(ReplayMutation, ALegCutShort) {
  expect_caught(
      [](Plan& plan, const Task&) {
        plan.legs.back().exit_m = 0.5 * (plan.legs.back().entry_m + plan.legs.back().exit_m);
        return true;
      },
      "not flown from end to end");
}

TEST(ReplayMutation, AShiftedTime) {
  expect_caught(
      [](Plan& plan, const Task&) {
        plan.legs.back().start_s -= 0.5;
        return true;
      },
      "start: the plan says");
}

TEST(ReplayMutation, AnEnergyThatIsTooHigh) {
  expect_caught(
      [](Plan& plan, const Task&) {
        plan.legs.front().energy_after += 0.5;
        return true;
      },
      "energy after: the plan says");
}

TEST(ReplayMutation, ARendezvousElsewhere) {
  expect_caught(
      [](Plan& plan, const Task&) {
        if (plan.rendezvous.empty()) return false;
        plan.rendezvous.back().site_m.x() += 1.0;
        return true;
      },
      "not on the ground below");
}

TEST(ReplayMutation, ARendezvousThatNobodyAsksFor) {
  expect_caught(
      [](Plan& plan, const Task&) {
        if (plan.rendezvous.empty()) return false;
        plan.rendezvous.push_back(plan.rendezvous.back());
        return true;
      },
      "no transfer asks for");
}

TEST(ReplayMutation, ALandingLeftOut) {
  expect_caught(
      [](Plan& plan, const Task&) {
        if (plan.rendezvous.empty()) return false;
        plan.legs[leg_after(plan.rendezvous[0]) - 1].transfer = Transfer::kFF;
        return true;
      },
      "");
}

TEST(ReplayMutation, AWayOverAHole) {
  expect_caught(
      [](Plan& plan, const Task& task) {
        bool any = false;
        for (Leg& leg : plan.legs) {
          any = any || (leg.transfer_m.size() > 1 && !task.fields.front().polygon.holes.empty());
          leg.transfer_m.clear();
        }
        return any;
      },
      "crosses a hole");
}

TEST(ReplayMutation, ALegAtTheWrongHeight) {
  expect_caught(
      [](Plan& plan, const Task& task) {
        if (plan.fields.front().beyond_tolerance > 0) return false;
        for (Leg& leg : plan.legs) {
          leg.entry_m.z() += 2.0 * task.height_tolerance_m + 1.0;
          leg.exit_m.z() = leg.entry_m.z();
        }
        return true;
      },
      "leaves its height");
}

TEST(ReplayMutation, TotalsThatAreNotTheSums) {
  using Total = double Plan::*;
  for (const auto& [total, name] : {std::pair<Total, const char*>{&Plan::makespan_s, "the makespan"},
                                    {&Plan::cost, "the cost"},
                                    {&Plan::flight_s, "the time in flight"},
                                    {&Plan::flight_m, "the length of flight"},
                                    {&Plan::energy_used, "the energy used"},
                                    {&Plan::energy_min, "the least energy on landing"},
                                    {&Plan::wait_s, "the waiting time"}}) {
    SCOPED_TRACE(name);
    expect_caught(
        [total = total](Plan& plan, const Task&) {
          plan.*total += 20.0;
          return plan.rendezvous.size() < 8;
        },
        name);
  }
  expect_caught(
      [](Plan& plan, const Task&) {
        ++plan.recharges;
        return true;
      },
      "the number of recharges");
}

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
