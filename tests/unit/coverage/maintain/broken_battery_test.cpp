#include <gtest/gtest.h>

#include <algorithm>

#include "coverage/maintain/plan_keeper.hpp"
#include "planner/base/rng.hpp"
#include "tests/unit/coverage/maintain/on_leg.hpp"

/// A battery state that breaks the plan: whatever it holds, all that is left is planned anew.
namespace swallowtail::coverage {
namespace {

constexpr int kBreaksPerTask = 8;

Task random_task(Rng& rng) {
  Task task;
  const double side_m = rng.uniform(100.0, 300.0);
  task.fields.push_back({1,
                         "field",
                         {{{0, 0}, {side_m, 0}, {side_m, 0.6 * side_m}, {0, 0.6 * side_m}}, {}},
                         rng.uniform(8.0, 40.0)});
  task.sensor_width_m = rng.uniform(8.0, 15.0);
  task.battery.capacity = rng.uniform(120.0, 300.0);
  task.battery.reserve = rng.uniform(0.05, 0.15) * task.battery.capacity;
  task.battery.charge_s_per_unit = rng.uniform(0.2, 2.0);
  task.charger.speed_mps = rng.uniform(1.0, 4.0);
  task.start_m = Vec3(-10.0, -10.0, 0.0);
  task.charger.start_m = task.start_m;
  return task;
}

/// The lowest energy that a landing planned after a state of flight leaves.
double least_landing(const LivePlan& plan) {
  double out = plan.legs.back().energy_after;
  for (const Rendezvous& meeting : plan.rendezvous) out = std::min(out, meeting.energy_from);
  return out;
}

TEST(BrokenBattery, AllThatIsLeftIsPlannedAnewWhateverTheBatteryHolds) {
  int broken = 0;
  int kept = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    const Task task = random_task(rng);
    const auto made = PlanKeeper::make(task, planner::Terrain::flat(0.0), {});
    if (!made.ok()) continue;
    for (int sample = 0; sample < kBreaksPerTask; ++sample) {
      PlanKeeper keeper = *made;
      const LivePlan before = keeper.plan();
      const std::size_t leg = rng.below(before.legs.size());
      const double share = rng.uniform(0.1, 0.9);
      const AircraftView view = on_leg(before, leg, share, task.vehicle.cruise_speed_mps);
      keeper.on_vehicle(view);
      const double planned = before.legs[leg].energy_before +
                             share * (before.legs[leg].energy_after - before.legs[leg].energy_before);
      const double energy = planned - rng.uniform(0.05, 0.3) * task.battery.capacity;
      if (!keeper.on_battery({view.time_s, energy, task.battery.capacity})) continue;
      ++broken;
      const LivePlan& after = keeper.plan();
      EXPECT_TRUE(keeper.complete()) << after.reason;
      EXPECT_NEAR(cover_m(after, leg), cover_m(before, leg), 1e-6) << after.reason;
      EXPECT_EQ(after.legs_done, leg);
      const bool keeps = least_landing(after) >= task.battery.reserve - 1e-6;
      kept += keeps ? 1 : 0;
      if (!keeps) {
        EXPECT_NE(after.reason.find("lands at once"), std::string::npos) << after.reason;
      }
    }
  }
  RecordProperty("broken", broken);
  RecordProperty("reserve_kept", kept);
  EXPECT_GT(broken, 40);
  EXPECT_GT(kept, broken / 2);
}

}  // namespace
}  // namespace swallowtail::coverage
