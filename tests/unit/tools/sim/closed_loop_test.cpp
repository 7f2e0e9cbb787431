// A whole mission in one process: simulator, charger, coverage and planner on one in-memory network, stepped
// by one manual clock. No wall time enters, so a failure can be replayed.
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "charger/participant/charger_participant.hpp"
#include "coverage/participant/coverage_participant.hpp"
#include "planner/participant/planner_participant.hpp"
#include "planner/scenario/read.hpp"
#include "qos/memory/bus.hpp"
#include "tools/mission/check/flight_check.hpp"
#include "tools/mission/check/rules_of.hpp"
#include "tools/sim/sim_participant.hpp"

namespace swallowtail::sim {
namespace {

constexpr double kTick_s = 0.005;
constexpr double kLongest_s = 4000.0;  // mission time; the missions take about a third of it

struct Flight {
  nlohmann::json end;
  double reserve = 0.0;
  std::vector<check::Finding> findings;  ///< of the robot's energy
  int depot_stops = 0;                   ///< of the first plan, but for the one at the end
  int refills = 0;
  int takeovers = 0;  ///< by another aircraft, as coverage tells of them
};

/// Listens to the robot.
class RobotWatch {
 public:
  explicit RobotWatch(Bus& bus) {
    (void)bus.subscribe<data::ChargerState>({.on_sample = [this](const data::ChargerState& state) {
      if (!log_.chargers.empty() && state.energy > log_.chargers.back().energy) ++refills_;
      log_.chargers.push_back(state);
    }});
    (void)bus.subscribe<data::CoveragePlan>({.on_sample = [this](const data::CoveragePlan& plan) {
      takeovers_ += plan.reason.find("another aircraft") != std::string::npos ? 1 : 0;
    }});
    (void)bus.subscribe<data::ChargerPlan>({.on_sample = [this](const data::ChargerPlan& plan) {
      if (depot_stops_ >= 0) return;
      depot_stops_ = -1;
      for (const data::Rendezvous& stop : plan.rendezvous)
        depot_stops_ += stop.kind == data::StopKind::kDepot ? 1 : 0;
    }});
  }
  void tell(const planner::Scenario& scenario, Flight& flight) const {
    flight.depot_stops = depot_stops_;
    flight.refills = refills_;
    flight.takeovers = takeovers_;
    const auto rules = check::rules_of(scenario);
    ASSERT_TRUE(rules.ok());
    for (check::Finding& finding : check::check_flight(log_, *rules).violations)
      if (finding.kind == "robot_energy") flight.findings.push_back(std::move(finding));
  }

 private:
  check::FlightLog log_;
  int depot_stops_ = -1;
  int refills_ = 0;
  int takeovers_ = 0;
};

std::vector<charger::Delay> delays_of(const planner::Scenario& scenario) {
  std::vector<charger::Delay> delays;
  for (const auto& event : scenario.events) {
    if (const auto* delay = std::get_if<planner::ChargerDelay>(&event.what)) {
      delays.push_back({event.at_s, delay->delay_s});
    }
  }
  return delays;
}

std::vector<charger::Loss> losses_of(const planner::Scenario& scenario) {
  std::vector<charger::Loss> losses;
  for (const auto& event : scenario.events) {
    if (const auto* loss = std::get_if<planner::ChargerLoss>(&event.what))
      losses.push_back({event.at_s, loss->energy});
  }
  return losses;
}

Flight fly(const std::string& file, std::uint64_t seed, double rate) {
  const auto scenario =
      planner::read_scenario(std::string(SWALLOWTAIL_SOURCE_DIR) + "/tests/data/missions/" + file);
  EXPECT_TRUE(scenario.ok()) << scenario.errors().text();
  ManualClock clock;
  MemoryNetwork network;
  const auto sim_bus = network.make_bus();
  const auto charger_bus = network.make_bus();
  const auto coverage_bus = network.make_bus();
  const auto planner_bus = network.make_bus();
  const auto charger = charger::ChargerParticipant::make(
                           *charger_bus, clock,
                           {.charger_id = 1, .delays = delays_of(*scenario), .losses = losses_of(*scenario)})
                           .value();
  const auto coverage = coverage::CoverageParticipant::make(*coverage_bus, clock, {}).value();
  const auto planner = planner::PlannerParticipant::make(*planner_bus, clock, {}).value();
  const auto sim =
      SimParticipant::make(*sim_bus, clock, *scenario,
                           {.rate = rate, .await = {1, 2, 3}, .max_time_s = kLongest_s, .seed = seed})
          .value();
  const auto watch_bus = network.make_bus();
  const auto watch = std::make_unique<RobotWatch>(*watch_bus);
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
  Flight flight{nlohmann::json::parse(sim->summary()), scenario->coverage->battery.reserve, {}};
  watch->tell(*scenario, flight);
  return flight;
}

class ClosedLoop : public ::testing::TestWithParam<std::tuple<const char*, double>> {};

/// The same mission under other weather, noise and orders of search. What holds for one seed must hold for
/// all.
TEST_P(ClosedLoop, IsFlownWholeAndSafely) {
  const auto [file, rate] = GetParam();
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Flight flight = fly(file, seed, rate);
    const auto& end = flight.end;
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + end.dump());
    EXPECT_EQ(end["status"], "completed");
    EXPECT_EQ(end["violations"], 0);
    EXPECT_EQ(end["collisions"], 0);
    EXPECT_EQ(end["legs_done"], end["legs_total"]);
    EXPECT_GE(end["covered_percent"].get<double>(), 99.5);
    EXPECT_GE(end["recharges"].get<int>(), 1);
    EXPECT_GE(end["energy_min"].get<double>(), flight.reserve);
    for (const check::Finding& finding : flight.findings)
      ADD_FAILURE() << "at " << finding.time_s << " s: " << finding.detail;
    EXPECT_EQ(flight.takeovers, std::string(file) == "other_aircraft.yaml" ? 2 : 0);
    if (std::string(file) == "robot_battery.yaml") {
      EXPECT_GE(flight.depot_stops, 1);
      EXPECT_GT(flight.refills, flight.depot_stops) << "it loses energy on the way";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Missions, ClosedLoop,
                         ::testing::Combine(::testing::Values("two_heights.yaml",
                                                              "hills_moving_obstacle.yaml",
                                                              "battery_fault_late_robot.yaml", "pond.yaml",
                                                              "robot_battery.yaml", "other_aircraft.yaml"),
                                            ::testing::Values(5.0, 20.0)));

}  // namespace
}  // namespace swallowtail::sim
