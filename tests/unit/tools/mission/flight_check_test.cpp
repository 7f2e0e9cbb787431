#include "tools/mission/check/flight_check.hpp"

#include "tools/mission/check/refly.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace swallowtail::check {
namespace {

/// A clean mission: up at (0, 5), east along a field strip 100 m long at 8 m/s and 20 m, down, with states
/// every 0.1 s and a battery that falls by one unit per second.
struct Mission {
  FlightLog log;
  Rules rules;
};

data::VehicleMode mode_of(data::PathPhase phase) {
  switch (phase) {
    case data::PathPhase::kTakeOff:
      return data::VehicleMode::kTakingOff;
    case data::PathPhase::kCover:
      return data::VehicleMode::kCovering;
    case data::PathPhase::kLanding:
      return data::VehicleMode::kLanding;
    default:
      return data::VehicleMode::kTransfer;
  }
}

Mission clean_mission() {
  Mission m;
  m.rules.has_coverage = true;
  m.rules.fields = {{"f", 20.0, {{{0, 0}, {100, 0}, {100, 10}, {0, 10}}}}};
  m.rules.sensor_width_m = 10.0;
  m.rules.height_tolerance_m = 1.0;
  m.rules.battery_capacity = 100.0;
  m.rules.battery_reserve = 10.0;
  m.rules.charger_speed_mps = 2.0;
  data::PathPlan plan;
  plan.vehicle_id = 1;
  plan.revision = 1;
  plan.verdict = data::PathVerdict::kCertified;
  plan.waypoints = {
      {1.0, {0, 5, 0}, data::PathPhase::kTakeOff, 0},  {11.0, {0, 5, 20}, data::PathPhase::kTakeOff, 0},
      {12.0, {0, 5, 20}, data::PathPhase::kHold, 0},   {24.5, {100, 5, 20}, data::PathPhase::kCover, 0},
      {25.5, {100, 5, 20}, data::PathPhase::kHold, 0}, {35.5, {100, 5, 0}, data::PathPhase::kLanding, 0}};
  m.log.plans = {plan};
  for (int i = 10; i <= 355; ++i) {
    const double t = i * 0.1;
    const P3 p = plan_position(plan, t);
    data::VehicleState s;
    s.vehicle_id = 1;
    s.time_s = t;
    s.position = {p.x, p.y, p.z};
    s.path_revision = 1;
    const auto next = std::find_if(plan.waypoints.begin(), plan.waypoints.end(),
                                   [t](const auto& w) { return w.time_s >= t; });
    s.mode = mode_of(next == plan.waypoints.end() ? data::PathPhase::kLanding : next->phase);
    m.log.states.push_back(s);
  }
  m.log.states.back().mode = data::VehicleMode::kLanded;
  for (int t = 1; t <= 35; ++t)
    m.log.batteries.push_back({1, static_cast<double>(t), 101.0 - t, 100.0, 1.0, 1.0});
  return m;
}

bool finds(const Mission& m, const std::string& kind) {
  const auto report = check_flight(m.log, m.rules);
  return std::any_of(report.violations.begin(), report.violations.end(),
                     [&](const Finding& f) { return f.kind == kind; });
}

std::string all_of(const FlightReport& report) {
  std::string text;
  for (const auto& v : report.violations) text += v.kind + " by " + v.by + ": " + v.detail + "\n";
  return text;
}

TEST(FlightCheck, CleanMissionPassesAndIsCovered) {
  const Mission m = clean_mission();
  const auto report = check_flight(m.log, m.rules);
  EXPECT_TRUE(report.ok()) << all_of(report);
  EXPECT_DOUBLE_EQ(report.covered_percent, 100.0);
  EXPECT_NEAR(report.flight_s, 34.5, 0.2);
  EXPECT_DOUBLE_EQ(report.energy_min, 66.0);
  EXPECT_NEAR(report.clearance_min_m, 20.0, 1e-6);
}

TEST(FlightCheck, FindsObstacleTooNearOnlyWhileItIsThere) {
  Mission m = clean_mission();
  Solid ball;
  ball.id = 4;
  ball.at = {50, 8, 20};
  ball.radius_m = 1.0;
  m.rules.solids = {ball};
  EXPECT_TRUE(finds(m, "clearance"));
  m.rules.solids[0].vanishes_s = 17.0;
  EXPECT_FALSE(finds(m, "clearance"));
  m.rules.solids[0].vanishes_s = 1e9;
  m.rules.solids[0].appears_s = 20.0;
  EXPECT_FALSE(finds(m, "clearance"));
}

TEST(FlightCheck, FindsTheAircraftInsideANoFlyAreaAtAnyHeight) {
  Mission m = clean_mission();
  m.rules.no_fly = {{{{40, 4.9}, {60, 4.9}, {60, 30}, {40, 30}}}};
  EXPECT_TRUE(finds(m, "no_fly"));
  m.rules.no_fly[0].push_back({{40.01, 4.92}, {59.99, 4.92}, {59.99, 20}, {40.01, 20}});
  EXPECT_FALSE(finds(m, "no_fly")) << "its hole is open";
  m.rules.no_fly = {{{{40, 5.0}, {60, 5.0}, {60, 30}, {40, 30}}}};
  EXPECT_FALSE(finds(m, "no_fly")) << "along its border";
}

TEST(FlightCheck, WhatIsNotAskedForNeedNotBeSeen) {
  Mission m = clean_mission();
  m.rules.fields[0].rings = {{{-50, 0}, {100, 0}, {100, 10}, {-50, 10}}};
  EXPECT_LT(check_flight(m.log, m.rules).covered_percent, 70.0);
  m.rules.no_fly = {{{{-50, 0}, {-0.2, 0}, {-0.2, 10}, {-50, 10}}}};
  EXPECT_DOUBLE_EQ(check_flight(m.log, m.rules).covered_percent, 100.0);
  m.rules.no_fly.clear();
  m.rules.fields[0].rings = {{{-3, -3}, {103, -3}, {103, 13}, {-3, 13}}};
  EXPECT_LT(check_flight(m.log, m.rules).covered_percent, 70.0);
  m.rules.skipped_border_m = 3.0;
  EXPECT_DOUBLE_EQ(check_flight(m.log, m.rules).covered_percent, 100.0);
}

TEST(FlightCheck, FindsTheRobotOffItsRoadsAndOnClosedGround) {
  Mission m = clean_mission();
  for (int t = 0; t <= 30; ++t) {
    data::ChargerState robot;
    robot.charger_id = 1;
    robot.time_s = t;
    robot.position = {t * 1.0, -20, 0};
    m.log.chargers.push_back(robot);
  }
  m.rules.roads = {{{0, -20}, {50, -20}}};
  EXPECT_TRUE(check_flight(m.log, m.rules).ok());
  m.rules.roads = {{{0, -20}, {10, -20}, {10, 0}}};
  EXPECT_TRUE(finds(m, "off_road"));
  m.rules.off_road_m = 20.0;
  EXPECT_FALSE(finds(m, "off_road"));
  m.rules.no_drive = {{{{12, -25}, {18, -25}, {18, -15}, {12, -15}}}};
  EXPECT_TRUE(finds(m, "closed_ground"));
}

/// East at 1 m/s for 20 s by 0.1 units per second, then ten units given at two for each.
Mission with_robot_battery() {
  Mission m = clean_mission();
  m.rules.robot_battery = RobotBattery{100.0, 20.0, 0.1, 2.0, {0, -20}, {}};
  for (int t = 0; t <= 30; ++t) {
    data::ChargerState robot;
    robot.charger_id = 1;
    robot.time_s = t;
    robot.position = {std::min(t, 20) * 1.0, -20, 0};
    robot.speed_mps = t < 20 ? 1.0 : 0.0;
    robot.energy_delivered = std::max(0, t - 20) * 1.0;
    robot.energy = 100.0 - 0.1 * std::min(t, 20) - 2.0 * robot.energy_delivered;
    m.log.chargers.push_back(robot);
  }
  return m;
}

void from(Mission& m, std::size_t first, double more) {
  for (std::size_t i = first; i < m.log.chargers.size(); ++i) m.log.chargers[i].energy += more;
}

TEST(FlightCheck, FollowsTheRobotsOwnEnergy) {
  Mission m = with_robot_battery();
  EXPECT_TRUE(check_flight(m.log, m.rules).ok()) << all_of(check_flight(m.log, m.rules));
  from(m, 10, 0.5);
  EXPECT_TRUE(finds(m, "robot_energy")) << "it rises on the way";
  m = with_robot_battery();
  from(m, 10, 0.1);
  EXPECT_TRUE(finds(m, "robot_energy")) << "a second's drive for nothing";
  m = with_robot_battery();
  from(m, 25, 2.0);
  EXPECT_TRUE(finds(m, "robot_energy")) << "a unit given for nothing";
  m = with_robot_battery();
  from(m, 25, -5.0);
  EXPECT_TRUE(finds(m, "robot_energy")) << "energy vanishes";
  m.rules.robot_battery->losses = {{24.5, 5.0}};
  EXPECT_FALSE(finds(m, "robot_energy")) << "the scenario says so";
  m = with_robot_battery();
  from(m, 0, 1.0);
  EXPECT_TRUE(finds(m, "robot_energy")) << "more than it holds";
  m = with_robot_battery();
  from(m, 0, -60.0);
  EXPECT_TRUE(finds(m, "robot_energy")) << "below its reserve";
}

TEST(FlightCheck, LetsTheRobotsEnergyRiseAtItsDepot) {
  Mission m = with_robot_battery();
  m.rules.robot_battery->depot = {20, -20};
  from(m, 25, 12.0);
  EXPECT_FALSE(finds(m, "robot_energy"));
  m.rules.robot_battery->depot = {20, -21.4};
  EXPECT_FALSE(finds(m, "robot_energy")) << "there and back between two states";
  m.rules.robot_battery->depot = {20, -22};
  EXPECT_TRUE(finds(m, "robot_energy"));
}

TEST(FlightCheck, FindsMovingObstacleWhereItMeetsTheFlight) {
  Mission m = clean_mission();
  Solid ball;
  ball.id = 9;
  ball.at = {50, -40, 20};
  ball.velocity_mps = {0, 2.5, 0};
  ball.radius_m = 1.0;
  m.rules.solids = {ball};
  const auto report = check_flight(m.log, m.rules);
  ASSERT_EQ(report.violations.size(), 1U) << all_of(report);
  EXPECT_EQ(report.violations[0].by, "obstacle 9");
  EXPECT_NEAR(report.violations[0].time_s, 18.25, 0.6);
}

TEST(FlightCheck, FindsStateOffThePlan) {
  Mission m = clean_mission();
  m.log.states[200].position.y_m += 1.0;
  EXPECT_TRUE(finds(m, "off_plan"));
}

TEST(FlightCheck, FindsFlightWithoutAPublishedPlan) {
  Mission m = clean_mission();
  for (auto& s : m.log.states) s.path_revision = 2;
  EXPECT_TRUE(finds(m, "uncertified_plan"));
  m = clean_mission();
  m.log.plans[0].verdict = data::PathVerdict::kNoSafePath;
  EXPECT_TRUE(finds(m, "uncertified_plan"));
}

TEST(FlightCheck, LetsAFlightBeginInTheAirButNotMoveWithoutAPlan) {
  Mission m = clean_mission();
  data::VehicleState waits = m.log.states.front();
  waits.mode = data::VehicleMode::kHolding;
  waits.path_revision = 0;
  waits.time_s = 0.9;
  waits.position.z_m += 5.0;
  m.log.states = {waits, waits};
  m.log.states[1].time_s = 1.0;
  EXPECT_FALSE(finds(m, "uncertified_plan"));
  m.log.states[1].position.x_m += 0.5;
  EXPECT_TRUE(finds(m, "uncertified_plan"));
}

TEST(FlightCheck, FindsBrokenLimits) {
  Mission m = clean_mission();
  m.rules.vehicle.cruise_speed_mps = 7.0;
  EXPECT_TRUE(finds(m, "speed"));
  m = clean_mission();
  m.rules.vehicle.climb_speed_mps = 1.5;
  EXPECT_TRUE(finds(m, "climb"));
  m = clean_mission();
  m.rules.bounds_max.z = 15.0;
  EXPECT_TRUE(finds(m, "bounds"));
}

TEST(FlightCheck, FindsTurnWithoutAStop) {
  Mission m = clean_mission();
  auto& w = m.log.plans[0].waypoints;
  w = {{1.0, {0, 5, 20}, data::PathPhase::kTransfer, 0},
       {11.0, {70, 5, 20}, data::PathPhase::kTransfer, 0},
       {20.0, {70, 60, 20}, data::PathPhase::kTransfer, 0}};
  m.log.states.clear();
  for (int i = 10; i <= 200; ++i) {
    const P3 p = plan_position(m.log.plans[0], i * 0.1);
    data::VehicleState s;
    s.time_s = i * 0.1;
    s.position = {p.x, p.y, p.z};
    s.path_revision = 1;
    s.mode = data::VehicleMode::kTransfer;
    m.log.states.push_back(s);
  }
  EXPECT_TRUE(finds(m, "turn"));
}

TEST(FlightCheck, FindsGroundTooNear) {
  Mission m = clean_mission();
  m.rules.ground.z_m = {18.5F};
  EXPECT_TRUE(finds(m, "terrain"));
}

TEST(FlightCheck, FindsReserveBrokenAndEnergyFromNowhere) {
  Mission m = clean_mission();
  m.log.batteries[20].energy = 9.0;
  EXPECT_TRUE(finds(m, "reserve"));
  EXPECT_TRUE(finds(m, "charge"));
}

TEST(FlightCheck, AnotherAircraftBringsItsOwnEnergyWhenTheScenarioSaysSo) {
  Mission m = clean_mission();
  m.log.states.back().legs_done = 1;
  data::VehicleState other = m.log.states.back();
  other.time_s += 0.1;
  other.position = {0, 5, 0};
  other.legs_done = 0;
  m.log.states.push_back(other);
  m.log.batteries.push_back({1, 36.0, 90.0, 95.0, 0.0, 1.0});
  EXPECT_TRUE(finds(m, "charge"));
  m.rules.replacements = {{30.0, 90.0}};
  EXPECT_FALSE(finds(m, "charge"));
  m.rules.replacements = {{30.0, 80.0}};
  EXPECT_TRUE(finds(m, "charge")) << "more than it was to hold";
  m.rules.replacements = {{40.0, 90.0}};
  EXPECT_TRUE(finds(m, "charge")) << "too early";
}

TEST(FlightCheck, FindsDockingFarFromTheRobot) {
  Mission m = clean_mission();
  data::VehicleState docked = m.log.states.back();
  docked.time_s += 0.1;
  docked.mode = data::VehicleMode::kDocked;
  m.log.states.push_back(docked);
  m.log.chargers = {
      {1, docked.time_s, {120, 5, 0}, 0.0, 1, 0.0, 0.0, data::ChargerActivity::kCharging, 0, 0, 1}};
  EXPECT_TRUE(finds(m, "dock"));
  m.log.chargers[0].position = {100.5, 5, 0};
  EXPECT_FALSE(finds(m, "dock"));
}

TEST(FlightCheck, FindsHoleInTheRecording) {
  Mission m = clean_mission();
  m.log.states.erase(m.log.states.begin() + 100, m.log.states.begin() + 140);
  EXPECT_TRUE(finds(m, "gap"));
  m.log.states.clear();
  EXPECT_TRUE(finds(m, "no_data"));
}

TEST(FlightCheck, WrongHeightDoesNotCover) {
  Mission m = clean_mission();
  m.rules.fields[0].height_m = 12.0;
  EXPECT_DOUBLE_EQ(check_flight(m.log, m.rules).covered_percent, 0.0);
}

}  // namespace
}  // namespace swallowtail::check
