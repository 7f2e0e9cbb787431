#include "tools/sim/simulation.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "path_fixture.hpp"
#include "scenario_fixture.hpp"
#include "tools/sim/progress.hpp"

namespace swallowtail::sim {
namespace {

std::unique_ptr<Simulation> simulation(const std::string& more = {}, SimulationOptions options = {}) {
  auto made = Simulation::make(scenario_with(more), options);
  EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
  return std::move(made).value();
}

void run(Simulation& sim, double until_s) {
  while (sim.time_s() < until_s - 1e-9 && !sim.outcome()) sim.step();
}

/// Both strips of the test field, from the start at (−20, 5) and to the ground at the second strip's end.
data::PathPlan both_strips(double time_s) {
  return PathBuilder(1, time_s, {-20, 5, 0})
      .to({-20, 5, 20}, 5.0, PathPhase::kTakeOff)
      .to({0, 5, 20}, 2.0, PathPhase::kTransfer)
      .to({100, 5, 20}, 10.0, PathPhase::kCover)
      .to({100, 15, 20}, 1.0, PathPhase::kTransfer, 1)
      .to({0, 15, 20}, 10.0, PathPhase::kCover, 1)
      .to({0, 15, 0}, 5.0, PathPhase::kLanding, 1)
      .plan;
}

data::CoveragePlan two_legs() {
  return plan_of({strip({0, 5, 20}, {100, 5, 20}), strip({100, 15, 20}, {0, 15, 20})});
}

TEST(Simulation, FliesAMissionToItsEnd) {
  const auto sim = simulation();
  sim->see(two_legs());
  ASSERT_EQ(sim->offer(both_strips(1.0)), Offer::kAccepted);
  run(*sim, 100.0);
  ASSERT_TRUE(sim->outcome());
  EXPECT_TRUE(sim->outcome()->completed) << sim->outcome()->reason;
  EXPECT_NEAR(sim->time_s(), 1.0 + 33.0 + 5.0, 0.1);
  EXPECT_EQ(sim->motion().legs_done, 2U);
  EXPECT_EQ(sim->covered_percent(), 100.0);
  EXPECT_NEAR(sim->battery()->energy(), 100.0 - 33.0, 0.1);
  EXPECT_NEAR(sim->tally().flown_s, 33.0, 0.1);
  EXPECT_EQ(sim->safety().violations(), 0U);
}

TEST(Simulation, ObstaclesAndLossesOfEventsAreReal) {
  const auto sim = simulation(R"(
events:
  - {at_s: 9, obstacle: {id: 9, shape: sphere, center_m: [50, 5, 20], radius_m: 3}}
  - {at_s: 10, battery_loss: 40}
)");
  sim->see(two_legs());
  ASSERT_EQ(sim->offer(both_strips(1.0)), Offer::kAccepted);
  run(*sim, 11.0);
  EXPECT_NEAR(sim->battery()->energy(), 100.0 - 10.0 - 40.0, 0.1);
  run(*sim, 100.0);
  EXPECT_EQ(sim->safety().collisions(), 1U);
  EXPECT_TRUE(sim->outcome()->completed);
}

TEST(Simulation, EndsWhenTheBatteryRunsOutAloft) {
  const auto sim = simulation("events:\n  - {at_s: 10, battery_loss: 85}\n");
  sim->see(two_legs());
  ASSERT_EQ(sim->offer(both_strips(1.0)), Offer::kAccepted);
  run(*sim, 100.0);
  ASSERT_TRUE(sim->outcome());
  EXPECT_FALSE(sim->outcome()->completed);
  EXPECT_NE(sim->outcome()->reason.find("battery"), std::string::npos);
}

TEST(Simulation, ChargesOnBoard) {
  const auto sim = simulation("events:\n  - {at_s: 1, battery_loss: 50}\n");
  run(*sim, 2.0);
  data::ChargerState charger;
  charger.charger_id = 1;
  charger.position = {-20, 5, 0};
  charger.docked_vehicle_id = 1;
  charger.charge_rate = 2.0;
  for (charger.time_s = 2.0; charger.time_s < 12.0; charger.time_s += 2.0) {
    sim->see(charger);
    run(*sim, charger.time_s + 2.0);
  }
  EXPECT_NEAR(sim->battery()->energy(), 70.0, 0.2);
  EXPECT_EQ(sim->tally().recharges, 1U);
}

TEST(Simulation, TheSameSeedAndInputsGiveTheSameWorldToTheBit) {
  const auto line = [](std::uint64_t seed) {
    const auto sim = simulation("battery_noise: 0.1\nwind: {speed_mps: 3, direction_deg: 90, gust_mps: 2}\n",
                                {.seed = seed});
    sim->see(two_legs());
    EXPECT_EQ(sim->offer(both_strips(1.0)), Offer::kAccepted);
    run(*sim, 30.0);
    return sim->battery()->energy();
  };
  EXPECT_EQ(line(3), line(3));
  EXPECT_NE(line(3), line(4));
}

TEST(Simulation, AMissionForAGoalHasNoBattery) {
  const auto scenario = planner::parse_scenario(R"(swallowtail: 1
name: goal
bounds_m: {min: [0, 0, 0], max: [100, 100, 100]}
terrain: {kind: flat, elevation_m: 0}
vehicle: {radius_m: 0.5, margin_m: 2, cruise_speed_mps: 10}
start_m: [5, 5, 30]
goal_m: [80, 5, 30]
)",
                                                "goal.yaml", ".");
  ASSERT_TRUE(scenario.ok()) << scenario.errors().text();
  auto sim = Simulation::make(*scenario, {}).value();
  EXPECT_EQ(sim->battery(), nullptr);
  ASSERT_TRUE(sim->mission().goal);
  ASSERT_EQ(sim->offer(PathBuilder(1, 0.0, {5, 5, 30}).to({80, 5, 30}, 8.0, PathPhase::kTransfer).plan),
            Offer::kAccepted);
  run(*sim, 2000.0);
  ASSERT_TRUE(sim->outcome());
  EXPECT_TRUE(sim->outcome()->completed) << sim->outcome()->reason;
  EXPECT_NEAR(sim->time_s(), 8.0, 0.2);
}

TEST(Progress, LinesAreJsonThatSaysWhatTheMissionCommandShows) {
  const auto sim = simulation();
  sim->see(two_legs());
  const auto line = nlohmann::json::parse(progress_line(*sim, {}));
  for (const char* key : {"time_s", "covered_percent", "energy", "capacity", "replans", "coverage_revision",
                          "legs_done", "legs_total", "clearance_m", "charger_activity", "position", "mode",
                          "recharges", "verdict", "state", "violations"}) {
    EXPECT_TRUE(line.contains(key)) << key;
  }
  EXPECT_EQ(line["state"], "waiting");
  EXPECT_EQ(line["legs_total"], 2);
  EXPECT_TRUE(line["verdict"].is_null());
  EXPECT_FALSE(line.contains("status"));
  sim->end({.completed = false, .reason = "interrupted"});
  const auto last = nlohmann::json::parse(summary_line(*sim, {.state = data::ClockState::kEnded}));
  EXPECT_EQ(last["status"], "interrupted");
  EXPECT_EQ(last["completed"], false);
  EXPECT_EQ(last["final"], true);
}

}  // namespace
}  // namespace swallowtail::sim
