#include "coverage/energy/consumption.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swallowtail::coverage {
namespace {

constexpr double kSpeed_mps = 8.0;
const Vec3 kEast(kSpeed_mps, 0.0, 0.0);
const Vec3 kUp(0.0, 0.0, 3.0);

/// Flies and learns second by second what flying takes in truth.
void fly(Consumption& known, const Vec3& velocity_mps, double seconds, double per_s) {
  for (int i = 0; i < static_cast<int>(seconds); ++i) {
    known.fly(EnergyModel{}, velocity_mps, 20.0, 1.0);
    known.learn(per_s);
  }
}

EnergyModel learnt(const Consumption& known) {
  EnergyModel out;
  out.correction = known.correction();
  return out;
}

TEST(Consumption, ExpectsWhatTheModelSaysBeforeItHasFlown) {
  const Consumption known;
  EXPECT_EQ(base_power(learnt(known), kEast), base_power(EnergyModel{}, kEast));
  EXPECT_EQ(base_power(learnt(known), kUp), base_power(EnergyModel{}, kUp));
}

TEST(Consumption, LearnsThatAllFlightTakesMore) {
  Consumption known;
  fly(known, kUp, 20, 1.3);
  for (int lap = 0; lap < 4; ++lap) {
    fly(known, kEast, 15, 1.3);
    fly(known, -kEast, 15, 1.3);
  }
  EXPECT_NEAR(base_power(learnt(known), kEast), 1.3, 0.04);
  EXPECT_NEAR(base_power(learnt(known), Vec3(0.0, -kSpeed_mps, 0.0)), 1.3, 0.1);
  EXPECT_NEAR(base_power(learnt(known), -kUp), 1.3, 0.1);
}

TEST(Consumption, LearnsWindFromTwoDirections) {
  Consumption known;
  for (int lap = 0; lap < 3; ++lap) {
    fly(known, kEast, 20, 1.4);
    fly(known, -kEast, 20, 0.7);
  }
  EXPECT_NEAR(base_power(learnt(known), kEast), 1.4, 0.07);
  EXPECT_NEAR(base_power(learnt(known), -kEast), 0.7, 0.1);
  EXPECT_GT(base_power(learnt(known), Vec3::Zero()), 1.15) << "standing in it takes more as well";
}

TEST(Consumption, IsNeverTakenToBeLessThanTheModelInStillAir) {
  Consumption known;
  fly(known, kEast, 60, 0.8);
  fly(known, -kEast, 60, 0.8);
  EXPECT_EQ(known.correction().all, 1.0);
  EXPECT_GE(base_power(learnt(known), kUp), 1.0);
}

TEST(Consumption, KnowsTheDescentBetterTheMoreItHasFlown) {
  Consumption known;
  const FlightCost descent{10.0, 10.0, 30.0};
  const double before = known.upright_deviation(descent);
  fly(known, kUp, 30, 1.2);
  EXPECT_LT(known.upright_deviation(descent), 0.8 * before);
  EXPECT_GT(known.upright_deviation(descent), 0.5) << "gusts stay";
}

TEST(Consumption, WhatIsTakenBackOrForgottenTeachesNothing) {
  Consumption known;
  known.fly(EnergyModel{}, kEast, 20.0, 5.0);
  known.fly(EnergyModel{}, kEast, 20.0, -5.0);
  known.learn(50.0);
  known.fly(EnergyModel{}, kEast, 20.0, 5.0);
  known.forget();
  known.learn(50.0);
  EXPECT_EQ(known.correction().all, 1.0);
  EXPECT_EQ(known.correction().along, Vec2(0.0, 0.0));
}

TEST(Consumption, AFlightCostsWhatItsDirectionsTake) {
  const auto ground = planner::Terrain::flat(0.0);
  EnergyModel windy;
  windy.correction = {1.1, Vec2(0.3, 0.0), 0.2};
  const FlightModel model(planner::VehicleLimits{}, windy, ground);
  EXPECT_NEAR(model.level({0, 0, 20}, {80, 0, 20}).energy, 14.0, 1e-9);
  EXPECT_NEAR(model.level({80, 0, 20}, {0, 0, 20}).energy, 8.0, 1e-9);
  EXPECT_NEAR(model.level({0, 0, 20}, {0, 80, 20}).energy, 11.0, 1e-9);
  EXPECT_NEAR(model.vertical(0.0, 30.0).energy, 13.0, 1e-9);
  EXPECT_NEAR(greatest_level_power(windy, 8.0), 1.4, 1e-12);
}

}  // namespace
}  // namespace swallowtail::coverage
