#include "tools/sim/battery.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace swallowtail::sim {
namespace {

planner::Scenario calm() {
  planner::Scenario scenario;
  scenario.vehicle.limits.cruise_speed_mps = 10.0;
  return scenario;
}

const Load kLevel{.on_ground = false, .velocity_mps = Vec3(10, 0, 0)};

double drawn_in(Battery& battery, const Load& load, double duration_s) {
  const double before = battery.energy();
  for (double t = 0; t < duration_s - 1e-9; t += 0.05) battery.advance(load, 0.05);
  return before - battery.energy();
}

TEST(Battery, DrawsOneUnitPerSecondAloftByTheDocumentsModel) {
  Battery battery(calm(), 500.0, 1);
  EXPECT_NEAR(drawn_in(battery, kLevel, 10.0), 10.0, 1e-9);
  EXPECT_NEAR(battery.power(), 1.0, 1e-9);
  EXPECT_NEAR(drawn_in(battery, {.on_ground = false}, 10.0), 10.0, 1e-9) << "hovering";
  EXPECT_NEAR(drawn_in(battery, {.on_ground = true}, 10.0), 0.0, 1e-9);
}

TEST(Battery, DrawsByPhase) {
  planner::Scenario scenario = calm();
  scenario.vehicle.energy = {
      .level_per_s = 1, .climb_per_s = 2, .descent_per_s = 0.5, .hover_per_s = 1.2, .landed_per_s = 0.1};
  Battery battery(scenario, 500.0, 1);
  EXPECT_NEAR(drawn_in(battery, {.on_ground = false, .velocity_mps = Vec3(0, 0, 3)}, 10.0), 20.0, 1e-9);
  EXPECT_NEAR(drawn_in(battery, {.on_ground = false, .velocity_mps = Vec3(0, 0, -3)}, 10.0), 5.0, 1e-9);
  EXPECT_NEAR(drawn_in(battery, {.on_ground = false, .velocity_mps = Vec3(3, 0, 3)}, 10.0), 15.0, 1e-9);
  EXPECT_NEAR(drawn_in(battery, {.on_ground = false}, 10.0), 12.0, 1e-9);
  EXPECT_NEAR(drawn_in(battery, {.on_ground = true}, 10.0), 1.0, 1e-9);
}

TEST(Battery, DrawsMoreHighUp) {
  planner::Scenario scenario = calm();
  scenario.vehicle.energy.altitude_per_m = 0.01;
  scenario.vehicle.energy.altitude_from_m = 100.0;
  Battery battery(scenario, 500.0, 1);
  Load load = kLevel;
  load.altitude_m = 90.0;
  EXPECT_NEAR(drawn_in(battery, load, 10.0), 10.0, 1e-9);
  load.altitude_m = 120.0;
  EXPECT_NEAR(drawn_in(battery, load, 10.0), 12.0, 1e-9);
}

TEST(Battery, AMultirotorsPowerIsThatOfItsSpeedThroughTheAir) {
  planner::Scenario scenario = calm();
  scenario.vehicle.multirotor.emplace();
  scenario.wind = {.speed_mps = 4.0, .direction_rad = std::numbers::pi / 2};  // blows to the east
  Battery in_wind(scenario, 500.0, 1);
  const double against = drawn_in(in_wind, {.on_ground = false, .velocity_mps = Vec3(-10, 0, 0)}, 10.0);
  scenario.wind = {};
  Battery calm_air(scenario, 500.0, 1);
  EXPECT_NEAR(drawn_in(calm_air, {.on_ground = false, .velocity_mps = Vec3(14, 0, 0)}, 10.0), against, 1e-9);
  EXPECT_LT(drawn_in(calm_air, kLevel, 10.0), against);
  EXPECT_NEAR(drawn_in(calm_air, {.on_ground = false}, 3600.0 / 10.0) * 10.0,
              coverage::power_w(coverage::Multirotor{}, Vec3::Zero()), 1e-6)
      << "a unit is a Wh";
}

TEST(Battery, ChargesUpToItsCapacityAndNotAbove) {
  Battery battery(calm(), 100.0, 1);
  battery.lose(30.0);
  EXPECT_NEAR(battery.energy(), 70.0, 1e-9);
  EXPECT_NEAR(drawn_in(battery, {.on_ground = true, .velocity_mps = Vec3::Zero(), .charge_rate = 0.5}, 20.0),
              -10.0, 1e-9);
  EXPECT_NEAR(battery.power(), -0.5, 1e-9);
  drawn_in(battery, {.on_ground = true, .velocity_mps = Vec3::Zero(), .charge_rate = 0.5}, 100.0);
  EXPECT_EQ(battery.energy(), 100.0);
  EXPECT_NEAR(battery.least_energy(), 70.0, 1e-9);
}

TEST(Battery, IsNeverBelowNothing) {
  Battery battery(calm(), 5.0, 1);
  drawn_in(battery, kLevel, 10.0);
  battery.lose(3.0);
  EXPECT_EQ(battery.energy(), 0.0);
  EXPECT_TRUE(battery.empty());
  battery.lose(-50.0);
  EXPECT_EQ(battery.energy(), 0.0);
}

TEST(Battery, DrawsMoreAgainstTheWind) {
  planner::Scenario scenario = calm();
  scenario.wind = {.speed_mps = 4.0, .direction_rad = std::numbers::pi / 2};  // blows to the east
  Battery battery(scenario, 500.0, 1);
  EXPECT_LT((battery.wind_mps() - Vec3(4, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR(drawn_in(battery, kLevel, 10.0), 6.0, 1e-9);
  EXPECT_NEAR(drawn_in(battery, {.on_ground = false, .velocity_mps = Vec3(-10, 0, 0)}, 10.0), 14.0, 1e-9);
  EXPECT_NEAR(drawn_in(battery, {.on_ground = true}, 10.0), 0.0, 1e-9);
}

TEST(Battery, GustsStayWithinTheirBound) {
  planner::Scenario scenario = calm();
  scenario.wind = {.speed_mps = 6.0, .direction_rad = 0.0, .gust_mps = 2.0};
  Battery battery(scenario, 1e9, 5);
  double least = 1e9;
  double most = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    battery.advance(kLevel, 0.05);
    least = std::min(least, battery.wind_mps().norm());
    most = std::max(most, battery.wind_mps().norm());
  }
  EXPECT_GE(least, 4.0 - 1e-9);
  EXPECT_LE(most, 8.0 + 1e-9);
  EXPECT_LT(least, 4.5);
  EXPECT_GT(most, 7.5);
}

TEST(Battery, NoiseHasTheSpreadThatWasAskedFor) {
  planner::Scenario scenario = calm();
  scenario.battery_noise = 0.1;
  Battery battery(scenario, 1e9, 3);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 2'000'000;
  for (int i = 0; i < kCount; ++i) {
    battery.advance(kLevel, 0.05);
    sum += battery.power();
    squares += battery.power() * battery.power();
  }
  const double mean = sum / kCount;
  EXPECT_NEAR(mean, 1.0, 0.01);
  EXPECT_NEAR(std::sqrt(squares / kCount - mean * mean), 0.1, 0.01);
}

TEST(Battery, TheWeatherIsTheSeedsWhateverTheAircraftDoes) {
  planner::Scenario scenario = calm();
  scenario.battery_noise = 0.1;
  scenario.wind = {.speed_mps = 6.0, .direction_rad = 1.0, .gust_mps = 2.0};
  Battery flying(scenario, 500.0, 9);
  Battery standing(scenario, 500.0, 9);
  Battery other(scenario, 500.0, 10);
  drawn_in(flying, kLevel, 60.0);
  drawn_in(standing, {.on_ground = true}, 60.0);
  drawn_in(other, kLevel, 60.0);
  EXPECT_EQ(flying.wind_mps(), standing.wind_mps());
  EXPECT_NE(flying.wind_mps(), other.wind_mps());
  flying.advance(kLevel, 0.05);
  standing.advance(kLevel, 0.05);
  EXPECT_NEAR(flying.power(), standing.power(), 1e-9);
}

}  // namespace
}  // namespace swallowtail::sim
