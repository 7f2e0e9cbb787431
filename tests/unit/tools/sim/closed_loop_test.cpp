// A whole mission in one process: simulator, charger, coverage and planner on one in-memory network, stepped
// by one manual clock. No wall time enters, so a failure can be replayed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "charger/participant/charger_participant.hpp"
#include "coverage/participant/coverage_participant.hpp"
#include "planner/participant/planner_participant.hpp"
#include "planner/scenario/read.hpp"
#include "qos/memory/bus.hpp"
#include "tools/sim/sim_participant.hpp"

namespace swallowtail::sim {
namespace {

constexpr double kTick_s = 0.005;
constexpr double kRate = 20.0;
constexpr double kLongest_s = 4000.0;  // mission time; the missions take about a third of it

nlohmann::json fly(const std::string& file) {
  const auto scenario =
      planner::read_scenario(std::string(SWALLOWTAIL_SOURCE_DIR) + "/tests/data/missions/" + file);
  EXPECT_TRUE(scenario.ok()) << scenario.errors().text();
  ManualClock clock;
  MemoryNetwork network;
  const auto sim_bus = network.make_bus();
  const auto charger_bus = network.make_bus();
  const auto coverage_bus = network.make_bus();
  const auto planner_bus = network.make_bus();
  const auto charger = charger::ChargerParticipant::make(*charger_bus, clock, {.charger_id = 1}).value();
  const auto coverage = coverage::CoverageParticipant::make(*coverage_bus, clock, {}).value();
  const auto planner = planner::PlannerParticipant::make(*planner_bus, clock, {}).value();
  const auto sim = SimParticipant::make(*sim_bus, clock, *scenario,
                                        {.rate = kRate, .await = {1, 2, 3}, .max_time_s = kLongest_s})
                       .value();
  for (bool more = true; more;) {
    clock.advance(kTick_s);
    const auto stepped = sim->step();
    EXPECT_TRUE(stepped.ok());
    more = stepped.ok() && *stepped;
    EXPECT_TRUE(charger->step());
    EXPECT_TRUE(coverage->step());
    EXPECT_TRUE(planner->step());
    EXPECT_TRUE(planner->beat());
  }
  return nlohmann::json::parse(sim->summary());
}

TEST(ClosedLoop, TwoHeightsIsFlownWholeAndSafely) {
  const nlohmann::json end = fly("two_heights.yaml");
  SCOPED_TRACE(end.dump());
  EXPECT_EQ(end["status"], "completed");
  EXPECT_EQ(end["violations"], 0);
  EXPECT_EQ(end["collisions"], 0);
  EXPECT_EQ(end["legs_done"], end["legs_total"]);
  EXPECT_GE(end["covered_percent"].get<double>(), 98.0);
  EXPECT_GE(end["recharges"].get<int>(), 1);
  EXPECT_GT(end["energy_min"].get<double>(), 0.0);
}

}  // namespace
}  // namespace swallowtail::sim
