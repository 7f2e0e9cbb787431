#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/property/coverage/spoilt_plans.hpp"

/// What the replay is good for as far as the aircraft goes.
namespace swallowtail::coverage {
namespace {

using test::expect_caught;
using test::Planned;
using test::plans;
using testing::HasSubstr;

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
        if (task.fields.size() != 1 || task.fields.front().polygon.holes.size() != 1) return false;
        Vec3 middle = Vec3::Zero();
        const Ring& hole = task.fields.front().polygon.holes.front();
        for (const Vec2& p : hole) middle += Vec3(p.x(), p.y(), 0.0) / static_cast<double>(hole.size());
        for (Leg& leg : plan.legs) {
          if (leg.transfer == Transfer::kFF) leg.transfer_m = {middle};
        }
        return plan.legs.front().transfer == Transfer::kFF;
      },
      "crosses a hole");
}

TEST(ReplayMutation, ALineOverANoFlyArea) {
  expect_caught(
      [](Plan& plan, Task& task) {
        const Leg& leg = plan.legs.front();
        const Vec2 middle = ((leg.entry_m + leg.exit_m) / 2.0).head<2>();
        task.no_fly.push_back({{middle + Vec2(-1, -1), middle + Vec2(1, -1), middle + Vec2(0, 1)}, {}});
        return true;
      },
      "a line of field 1 crosses a no-fly area");
}

TEST(ReplayMutation, AHeadlandThatIsFlown) {
  expect_caught(
      [](Plan&, Task& task) {
        if (task.rules.headland == Headland::kSkip || task.rules.beyond != Beyond::kNever) return false;
        task.rules.headland = Headland::kSkip;
        task.rules.headland_m = task.sensor_width_m;
        return true;
      },
      "is in its headland");
}

TEST(ReplayMutation, LinesTooNearToTheGround) {
  expect_caught(
      [](Plan&, Task& task) {
        task.vehicle.margin_m += 2.0 * task.fields.front().height_m;
        return true;
      },
      "does not keep its clearance");
}

TEST(ReplayMutation, AWayOutOfItsField) {
  expect_caught(
      [](Plan& plan, const Task& task) {
        if (!task.no_fly.empty() || task.rules.beyond != Beyond::kNever) return false;
        for (std::size_t i = 0; i + 1 < plan.legs.size(); ++i) {
          Leg& leg = plan.legs[i];
          if (leg.transfer != Transfer::kFF || leg.field_id != plan.legs[i + 1].field_id) continue;
          leg.transfer_m = {leg.exit_m + Vec3(500.0, 0.0, 0.0)};
          return true;
        }
        return false;
      },
      "a flight leaves field");
}

TEST(ReplayMutation, AStatusThatTheFieldsBelie) {
  expect_caught(
      [](Plan& plan, const Task&) {
        plan.status = plan.status == PlanStatus::kComplete ? PlanStatus::kPartial : PlanStatus::kComplete;
        return true;
      },
      "says that it is complete");
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

}  // namespace
}  // namespace swallowtail::coverage
