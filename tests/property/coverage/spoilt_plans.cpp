#include "tests/property/coverage/spoilt_plans.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace swallowtail::coverage::test {

using testing::HasSubstr;

const std::vector<Planned>& plans() {
  static const std::vector<Planned> kPlans = [] {
    std::vector<Planned> out;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      Planned one{seed, random_replay_task(seed), {}};
      auto plan = plan_coverage(one.random.task, one.random.terrain, one.random.options);
      if (!plan) continue;
      one.plan = std::move(*plan);
      out.push_back(std::move(one));
    }
    return out;
  }();
  return kPlans;
}

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

void expect_caught(const Spoil& spoil, const std::string& fault, const std::vector<Planned>& sound) {
  int spoilt = 0;
  for (const Planned& planned : sound) {
    SCOPED_TRACE("seed " + std::to_string(planned.seed));
    Plan plan = planned.plan;
    Task task = planned.random.task;
    if (!spoil(plan, task)) continue;
    const auto verdict = test_support::replay(task, plan, question_of(planned.random));
    EXPECT_THAT(verdict.faults, testing::Contains(HasSubstr(fault)));
    if (++spoilt == 5) break;
  }
  EXPECT_GT(spoilt, 0) << "no plan to spoil";
}

}  // namespace swallowtail::coverage::test
