#include "coverage/energy/model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coverage/energy/flight.hpp"

namespace swallowtail::coverage {
namespace {

EnergyModel multirotor(const Vec2& wind_mps = Vec2::Zero()) {
  EnergyModel out;
  out.multirotor.emplace();
  out.wind_mps = wind_mps;
  out.unit_j = 1.0;
  return out;
}

TEST(Multirotor, HoversAtThePowerOfMomentumTheory) {
  // 3 kg on four discs of 0.2 m: all figures by hand.
  const double weight = 3.0 * 9.80665;
  const double area = 4.0 * std::numbers::pi * 0.04;
  const double induced = weight * std::sqrt(weight / (2.0 * 1.225 * area));
  const double blades = 1.225 * area * 80.0 * 80.0 * 80.0 * 0.1 * 0.012 / 8.0;
  EXPECT_NEAR(power_w({}, Vec3::Zero()), (1.15 * induced + blades) / 0.75 + 10.0, 1e-9);
  EXPECT_NEAR(hover_induced_velocity_mps({}), 4.888, 1e-3);
}

TEST(Multirotor, PayloadCosts) {
  const double empty = power_w({}, Vec3::Zero());
  const double loaded = power_w({.payload_kg = 1.0}, Vec3::Zero());
  EXPECT_DOUBLE_EQ(loaded, power_w({.mass_kg = 4.0}, Vec3::Zero())) << "a load is mass";
  EXPECT_GT(loaded, empty * 1.2);
}

TEST(Multirotor, LevelFlightIsCheapestInBetween) {
  const auto level = [](double speed) { return power_w({}, Vec3(speed, 0.0, 0.0)); };
  EXPECT_LT(level(8.0), level(0.0)) << "translation unloads the discs";
  EXPECT_GT(level(20.0), level(8.0)) << "drag grows with the cube of the speed";
  double before = level(0.0);
  bool rises = false;
  for (double speed = 0.5; speed <= 30.0; speed += 0.5) {
    const double now = level(speed);
    EXPECT_TRUE(!rises || now > before) << "falls again at " << speed;
    rises = now > before;
    before = now;
  }
}

TEST(Multirotor, ClimbingTakesThePotentialEnergyBesidesAndDescentGivesNoneBack) {
  const double hover = power_w({}, Vec3::Zero());
  const double climb = power_w({}, Vec3(0.0, 0.0, 3.0));
  // The discs' own work falls as air streams through them: more than the weight's lifting is never saved.
  EXPECT_GT(climb, hover);
  EXPECT_LT(climb, hover + 3.0 * 9.80665 * 3.0 / 0.75 + 5.0);
  EXPECT_DOUBLE_EQ(power_w({}, Vec3(0.0, 0.0, -3.0)), hover);
}

/// Vertical climb has a closed form: v = −c/2 + √(c²/4 + h²).
TEST(Multirotor, SolvesTheInducedVelocityOfAClimb) {
  const double c = 4.0;
  Multirotor craft;
  craft.drag_area_m2 = 0.0;
  const double h = hover_induced_velocity_mps(craft);
  const double v = -c / 2.0 + std::sqrt(c * c / 4.0 + h * h);
  const double weight = 3.0 * 9.80665;
  const double blades = (power_w(craft, Vec3::Zero()) - 10.0) * 0.75 - 1.15 * weight * h;
  EXPECT_NEAR(power_w(craft, Vec3(0.0, 0.0, c)), (1.15 * weight * v + weight * c + blades) / 0.75 + 10.0,
              1e-9);
}

TEST(EnergyModel, AStripAgainstTheWindCostsMoreAtCruiseSpeed) {
  const planner::Terrain ground = planner::Terrain::flat(0.0);
  planner::VehicleLimits limits;
  limits.cruise_speed_mps = 12.0;
  const FlightModel model(limits, multirotor(Vec2(5.0, 0.0)), ground);
  const Vec3 west(0.0, 0.0, 20.0);
  const Vec3 east(100.0, 0.0, 20.0);
  const Vec3 north(0.0, 100.0, 20.0);
  const FlightCost with = model.level(west, east);
  const FlightCost against = model.level(east, west);
  EXPECT_EQ(with.time_s, against.time_s) << "it keeps its speed over ground";
  EXPECT_GT(against.energy, 1.15 * with.energy);
  EXPECT_GT(against.energy, model.level(west, north).energy);
  EXPECT_NEAR(greatest_level_power(model.energy_model(), 12.0) * against.time_s, against.energy, 1e-9);
  const FlightModel calm(limits, multirotor(), ground);
  EXPECT_DOUBLE_EQ(calm.level(west, east).energy, calm.level(east, west).energy);
}

TEST(EnergyModel, NoDirectionTakesMoreThanTheGreatestLevelPower) {
  for (const double wind : {0.0, 2.0, 6.0, 12.0}) {
    for (const double speed : {3.0, 8.0, 15.0}) {
      const EnergyModel model = multirotor(Vec2(wind * 0.6, -wind * 0.8));
      const double greatest = greatest_level_power(model, speed);
      double most = 0.0;
      for (int i = 0; i < 720; ++i) {
        const double a = i * std::numbers::pi / 360.0;
        most = std::max(most, base_power(model, Vec3(speed * std::cos(a), speed * std::sin(a), 0.0)));
      }
      EXPECT_LE(most, greatest + 1e-9);
      EXPECT_GE(most, greatest * 0.999);
    }
  }
}

TEST(EnergyModel, ThinAirCostsMoreAndIsIntegratedExactly) {
  EnergyModel model;
  model.altitude_per_m = 0.01;
  model.altitude_from_m = 50.0;
  EXPECT_EQ(altitude_factor(model, 30.0), 1.0);
  EXPECT_DOUBLE_EQ(altitude_factor(model, 80.0), 1.3);
  EXPECT_DOUBLE_EQ(mean_altitude_factor(model, 60.0, 100.0), 1.3);
  EXPECT_DOUBLE_EQ(mean_altitude_factor(model, 100.0, 60.0), 1.3);
  EXPECT_DOUBLE_EQ(mean_altitude_factor(model, 0.0, 40.0), 1.0);
  // Half the way below, then up to 1.5: mean 1.125.
  EXPECT_DOUBLE_EQ(mean_altitude_factor(model, 0.0, 100.0), 1.125);
  const planner::Terrain ground = planner::Terrain::flat(0.0);
  const FlightModel flight({}, model, ground);
  const double climb = flight.vertical(0.0, 100.0).energy;
  EXPECT_DOUBLE_EQ(climb, flight.vertical(0.0, 50.0).energy + flight.vertical(50.0, 100.0).energy);
  EXPECT_DOUBLE_EQ(flight.level(Vec3(0, 0, 80), Vec3(80, 0, 80)).energy, 13.0);
  EXPECT_DOUBLE_EQ(flight.stop(80.0).energy, 1.3);
}

TEST(EnergyModel, RefusesWhatCannotBe) {
  const planner::VehicleLimits limits;
  EXPECT_TRUE(validate(EnergyModel{}, limits));
  const auto message = [&](auto spoil) {
    EnergyModel model = multirotor();
    spoil(model);
    const Status status = validate(model, limits);
    return status ? std::string() : status.error().message;
  };
  using testing::HasSubstr;
  EXPECT_EQ(message([](EnergyModel&) {}), "");
  EXPECT_THAT(message([](EnergyModel& m) { m.level_per_s = 0.0; }), HasSubstr("rates"));
  EXPECT_THAT(message([](EnergyModel& m) { m.altitude_per_m = -1.0; }), HasSubstr("altitude factor"));
  EXPECT_THAT(message([](EnergyModel& m) { m.altitude_from_m = std::nan(""); }), HasSubstr("altitude"));
  EXPECT_THAT(message([](EnergyModel& m) { m.wind_mps.x() = std::nan(""); }), HasSubstr("wind"));
  EXPECT_THAT(message([](EnergyModel& m) { m.wind_mps.x() = 15.0; }), HasSubstr("against the wind"));
  EXPECT_THAT(message([](EnergyModel& m) { m.unit_j = 0.0; }), HasSubstr("joules"));
  EXPECT_THAT(message([](EnergyModel& m) { m.multirotor->mass_kg = -1.0; }), HasSubstr("mass"));
  EXPECT_THAT(message([](EnergyModel& m) { m.multirotor->rotors = 0; }), HasSubstr("rotors"));
  EXPECT_THAT(message([](EnergyModel& m) { m.multirotor->efficiency = 1.5; }), HasSubstr("efficiency"));
}

}  // namespace
}  // namespace swallowtail::coverage
