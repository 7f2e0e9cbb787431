#include "coverage/field/ways.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/base/rng.hpp"
#include "tests/support/cover_oracle.hpp"

namespace swallowtail::coverage {
namespace {

Ring rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}
Ring hole(Ring ring) { return {ring.rbegin(), ring.rend()}; }

double length_m(const Vec2& from, const std::vector<Vec2>& corners, const Vec2& to) {
  double out = 0.0;
  Vec2 at = from;
  for (const Vec2& corner : corners) {
    out += (corner - at).norm();
    at = corner;
  }
  return out + (to - at).norm();
}

TEST(Ways, StraightWhereNothingIsInTheWay) {
  const Polygon field{rectangle(0, 0, 100, 100), {}};
  const Ways ways({&field, 1}, {});
  EXPECT_TRUE(ways.corners(Vec2(1, 1), Vec2(99, 99)).empty());
  EXPECT_TRUE(Ways().corners(Vec2(0, 0), Vec2(1, 1)).empty());
}

TEST(Ways, RoundAHoleByItsCorners) {
  const Polygon field{rectangle(0, 0, 100, 100), {hole(rectangle(40, 20, 60, 90))}};
  const Ways ways({&field, 1}, {});
  const Vec2 from(10, 50);
  const Vec2 to(90, 50);
  const std::vector<Vec2> corners = ways.corners(from, to);
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_NEAR((corners[0] - Vec2(40, 20)).norm(), 0.0, 0.05);
  EXPECT_NEAR((corners[1] - Vec2(60, 20)).norm(), 0.0, 0.05);
  EXPECT_NEAR(length_m(from, corners, to), 20.0 + 2.0 * std::hypot(30.0, 30.0), 0.1);
  EXPECT_FALSE(ways.is_free(from, to));
}

TEST(Ways, InsideAConcaveFieldButAcrossOpenGroundBetweenFields) {
  const std::vector<Polygon> fields = {
      {{{0, 0}, {60, 0}, {60, 50}, {40, 50}, {40, 20}, {20, 20}, {20, 50}, {0, 50}}, {}},
      {rectangle(100, 0, 150, 50), {}}};
  const Ways ways(fields, {});
  EXPECT_EQ(ways.corners(Vec2(10, 45), Vec2(50, 45)).size(), 2U) << "round the notch";
  EXPECT_TRUE(ways.corners(Vec2(10, 45), Vec2(140, 45)).empty()) << "to the other field straight";
}

TEST(Ways, StraightToAPlaceBesideAcrossTheBorder) {
  const Polygon field{{{0, 0}, {100, 0}, {100, 100}, {50, 50}, {0, 100}}, {}};
  const Ways ways({&field, 1}, {});
  EXPECT_TRUE(ways.corners(Vec2(30, -0.002), Vec2(30.04, -0.002)).empty()) << "both just outside";
  EXPECT_TRUE(ways.is_free(Vec2(30, -0.002), Vec2(30.04, 0.0)));
}

TEST(Ways, BetweenFieldsRoundANoFlyArea) {
  const std::vector<Polygon> fields = {{rectangle(0, 0, 40, 40), {}}, {rectangle(100, 0, 140, 40), {}}};
  const std::vector<Polygon> no_fly = {{rectangle(60, -10, 80, 60), {}}, {rectangle(70, 50, 90, 100), {}}};
  const Ways ways(fields, no_fly);
  const auto corners = ways.corners(Vec2(20, 20), Vec2(120, 20));
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_LT(corners[0].y(), -10.0);
}

TEST(Ways, AFieldInAHoleOfAnotherIsReached) {
  const std::vector<Polygon> fields = {{rectangle(0, 0, 100, 100), {hole(rectangle(30, 30, 70, 70))}},
                                       {rectangle(40, 40, 60, 60), {}}};
  EXPECT_TRUE(Ways(fields, {}).corners(Vec2(10, 50), Vec2(50, 50)).empty());
}

/// Among random holes the way stays on the ground and is no longer than one found on a fine grid.
TEST(Ways, StayOnTheGroundAmongRandomHoles) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    Polygon field{rectangle(0, 0, 100, 100), {}};
    test_support::Ground ground{{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}}};
    for (int i = 0; i < 9; ++i) {
      const Vec2 middle(20.0 + 30.0 * (i % 3), 20.0 + 30.0 * (i / 3));
      Ring ring;
      for (int k = 0; k < 6; ++k) {
        const double angle = -k * std::numbers::pi / 3.0;
        const double radius = rng.uniform(6.0, 13.0);
        ring.emplace_back(middle.x() + radius * std::cos(angle), middle.y() + radius * std::sin(angle));
      }
      field.holes.push_back(ring);
      ground.rings.emplace_back();
      for (const Vec2& p : ring) ground.rings.back().emplace_back(p.x(), p.y());
    }
    const Ways ways({&field, 1}, {});
    for (int trial = 0; trial < 20; ++trial) {
      const Vec2 from(rng.uniform(0.5, 99.5), rng.uniform() < 0.5 ? 2.0 : 35.0);
      const Vec2 to(rng.uniform(0.5, 99.5), rng.uniform() < 0.5 ? 98.0 : 65.0);
      if (!test_support::is_on(ground, {from.x(), from.y()}) ||
          !test_support::is_on(ground, {to.x(), to.y()}))
        continue;
      const auto corners = ways.corners(from, to);
      Vec2 at = from;
      std::vector<test_support::FlownLine> lines;
      for (const Vec2& corner : corners) {
        lines.push_back({{at.x(), at.y()}, {corner.x(), corner.y()}});
        at = corner;
      }
      lines.push_back({{at.x(), at.y()}, {to.x(), to.y()}});
      const auto verdict = test_support::judge_cover(ground, lines, {.cell_m = 10.0});
      EXPECT_EQ(verdict.outside_m, 0.0) << "seed " << seed << ", trial " << trial;
      EXPECT_LE(length_m(from, corners, to), 1.6 * (to - from).norm() + 15.0) << "seed " << seed;
      const auto back = ways.corners(to, from);
      EXPECT_NEAR(length_m(from, corners, to), length_m(to, back, from), 1e-6) << "seed " << seed;
    }
  }
}

TEST(Ways, GoRoundEachOfHundredsOfTrees) {
  Polygon field{{{0, 0}, {400, 0}, {400, 400}, {0, 400}}, {}};
  for (int i = 0; i < 200; ++i) {
    const Vec2 at(10.0 + 28.0 * (i % 14), 10.0 + 26.0 * (i / 14));
    field.holes.push_back({at, at + Vec2(0, 5), at + Vec2(5, 5), at + Vec2(5, 0)});
  }
  const Ways ways({&field, 1}, {});
  for (int row = 0; row < 14; ++row) {
    Vec2 at(1.0, 12.0 + 26.0 * row);
    const Vec2 to(399.0, at.y() + 1.0);
    auto way = ways.corners(at, to);
    EXPECT_FALSE(way.empty()) << row;
    way.push_back(to);
    for (const Vec2& next : way) {
      EXPECT_TRUE(ways.is_free(at, next)) << row;
      at = next;
    }
  }
}

}  // namespace
}  // namespace swallowtail::coverage
