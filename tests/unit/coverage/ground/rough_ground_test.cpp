#include "coverage/ground/rough_ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/rng.hpp"

namespace swallowtail::coverage {
namespace {

using planner::Terrain;

RoughGroundParams plain() {
  RoughGroundParams out;
  out.hi_m = Vec2(100.0, 100.0);
  out.cell_m = 2.0;
  out.speed_mps = 1.0;
  return out;
}

Polygon box(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

TEST(RoughGround, WaysAreHardlyLongerThanStraightOnes) {
  const auto ground = *RoughGround::make(plain(), Terrain::flat(0.0));
  Rng rng(1);
  for (int i = 0; i < 300; ++i) {
    const Vec2 a(rng.uniform(0.0, 100.0), rng.uniform(0.0, 100.0));
    const Vec2 b(rng.uniform(0.0, 100.0), rng.uniform(0.0, 100.0));
    const double there = ground->drive_s(a, b);
    EXPECT_GE(there, (b - a).norm() * (1.0 - 1e-6));
    EXPECT_LE(there, 1.028 * (b - a).norm() + 4.0 * ground->cell_m());
    EXPECT_NEAR(there, ground->drive_s(b, a), 1e-9);
  }
}

TEST(RoughGround, GoesRoundWhatIsForbidden) {
  RoughGroundParams params = plain();
  params.forbidden = {box(40.0, -10.0, 60.0, 80.0)};
  const auto ground = *RoughGround::make(params, Terrain::flat(0.0));
  const Vec2 a(20.0, 20.0);
  const Vec2 b(80.0, 20.0);
  const double least = 2.0 * std::hypot(20.0, 60.0) + 20.0;
  EXPECT_GT(ground->drive_s(a, b), least);
  EXPECT_LT(ground->drive_s(a, b), 1.1 * least);
  std::vector<Vec2> way = ground->bends(a, b);
  way.insert(way.begin(), a);
  way.push_back(b);
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    length += (way[i] - way[i - 1]).norm();
    for (double t = 0.0; t <= 1.0; t += 0.05) {
      const Vec2 p = way[i - 1] + t * (way[i] - way[i - 1]);
      EXPECT_FALSE(p.x() > 40.0 && p.x() < 60.0 && p.y() < 80.0) << p.transpose();
    }
  }
  EXPECT_NEAR(length, ground->drive_s(a, b), 1e-3);
}

TEST(RoughGround, WhatIsShutOffIsNotReached) {
  RoughGroundParams params = plain();
  params.forbidden = {box(40.0, -10.0, 60.0, 110.0)};
  const auto ground = *RoughGround::make(params, Terrain::flat(0.0));
  EXPECT_TRUE(std::isinf(ground->drive_s({20, 20}, {80, 20})));
  EXPECT_TRUE(std::isinf(ground->drive_s({20, 20}, {50, 20}))) << "in the forbidden box";
  EXPECT_TRUE(std::isinf(ground->drive_s({20, 20}, {20, 200}))) << "outside the ground";
  EXPECT_TRUE(ground->bends({20, 20}, {80, 20}).empty());
  EXPECT_TRUE(std::isfinite(ground->drive_s({70, 20}, {80, 90})));
}

TEST(RoughGround, AFieldWallThinnerThanACellStillStops) {
  RoughGroundParams params = plain();
  params.forbidden = {box(50.2, -10.0, 50.4, 110.0)};
  const auto ground = *RoughGround::make(params, Terrain::flat(0.0));
  EXPECT_TRUE(std::isinf(ground->drive_s({20, 20}, {80, 20})));
}

TEST(RoughGround, KeepsOffSteepSlopes) {
  // A hill in the middle, as steep as 0.86 · height / √(spread / 2).
  const auto hill = *planner::mountains_terrain({{50.0, 50.0, 15.0, 200.0}}, Vec2(0, 0), Vec2(100, 100), 1.0);
  RoughGroundParams params = plain();
  params.slope_max_rad = 0.35;
  const auto ground = *RoughGround::make(params, hill);
  const Vec2 a(20.0, 50.0);
  const Vec2 b(80.0, 50.0);
  EXPECT_GT(ground->drive_s(a, b), 64.0) << "round the hill";
  EXPECT_LT(ground->drive_s(a, b), 100.0);
  for (const Vec2& p : ground->bends(a, b)) {
    const double dx = hill.height_at(p.x() + 0.1, p.y()) - hill.height_at(p.x() - 0.1, p.y());
    const double dy = hill.height_at(p.x(), p.y() + 0.1) - hill.height_at(p.x(), p.y() - 0.1);
    EXPECT_LE(std::atan(std::hypot(dx, dy) / 0.2), 0.35 + 1e-6);
  }
  params.slope_max_rad = 1.4;
  EXPECT_LT((*RoughGround::make(params, hill))->drive_s(a, b), 64.0) << "a robot that climbs goes over it";
}

TEST(RoughGround, LargeGroundHasWiderCells) {
  RoughGroundParams params = plain();
  params.hi_m = Vec2(10'000.0, 10'000.0);
  const auto ground = *RoughGround::make(params, Terrain::flat(0.0));
  EXPECT_NEAR(ground->cell_m(), 50.0, 1e-9);
}

TEST(RoughGround, RefusesWhatCannotBe) {
  const auto refused = [](auto spoil) {
    RoughGroundParams params = plain();
    spoil(params);
    return !RoughGround::make(params, Terrain::flat(0.0)).ok();
  };
  EXPECT_FALSE(refused([](RoughGroundParams&) {}));
  EXPECT_TRUE(refused([](RoughGroundParams& p) { p.hi_m = p.lo_m; }));
  EXPECT_TRUE(refused([](RoughGroundParams& p) { p.cell_m = 0.0; }));
  EXPECT_TRUE(refused([](RoughGroundParams& p) { p.speed_mps = -1.0; }));
  EXPECT_TRUE(refused([](RoughGroundParams& p) { p.slope_max_rad = std::nan(""); }));
}

}  // namespace
}  // namespace swallowtail::coverage
