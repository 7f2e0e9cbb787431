#include "coverage/field/ways.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
  EXPECT_TRUE(ways.corners(Vec2(1, 1), Vec2(99, 99))->empty());
  EXPECT_TRUE(Ways().corners(Vec2(0, 0), Vec2(1, 1))->empty());
}

TEST(Ways, RoundAHoleByItsCorners) {
  const Polygon field{rectangle(0, 0, 100, 100), {hole(rectangle(40, 20, 60, 90))}};
  const Ways ways({&field, 1}, {});
  const Vec2 from(10, 50);
  const Vec2 to(90, 50);
  const std::vector<Vec2> corners = ways.corners(from, to).value();
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
  EXPECT_EQ(ways.corners(Vec2(10, 45), Vec2(50, 45))->size(), 2U) << "round the notch";
  EXPECT_TRUE(ways.corners(Vec2(10, 45), Vec2(140, 45))->empty()) << "to the other field straight";
}

TEST(Ways, StraightToAPlaceBesideAcrossTheBorder) {
  const Polygon field{{{0, 0}, {100, 0}, {100, 100}, {50, 50}, {0, 100}}, {}};
  const Ways ways({&field, 1}, {});
  EXPECT_TRUE(ways.corners(Vec2(30, -0.002), Vec2(30.04, -0.002))->empty()) << "both just outside";
  EXPECT_TRUE(ways.is_free(Vec2(30, -0.002), Vec2(30.04, 0.0)));
}

/// Whichever of the two fields comes first.
TEST(Ways, FromACommonBorderStayOnTheFieldOfTheOtherEnd) {
  const Polygon left{{{0, 0}, {50, 0}, {50, 40}, {0, 40}}, {}};
  const Polygon right{{{50, 0}, {90, 0}, {60, 20}, {90, 40}, {50, 40}}, {}};
  for (const auto& fields : {std::vector<Polygon>{left, right}, std::vector<Polygon>{right, left}}) {
    const Ways ways(fields, {});
    EXPECT_EQ(ways.corners(Vec2(85, 2), Vec2(85, 38))->size(), 1U);
    EXPECT_EQ(ways.corners(Vec2(50, 1), Vec2(88, 39))->size(), 1U);
    EXPECT_TRUE(ways.corners(Vec2(50, 1), Vec2(1, 39))->empty());
  }
}

/// A no-fly area cuts the left field in two where it reaches over the border; from one part to the other,
/// both ends a hair's breadth off the right field, the way runs over that.
TEST(Ways, AlongACommonBorderRoundANoFlyArea) {
  const Polygon below{{{0, 0}, {50, 0}, {50, 20}, {0, 20}}, {}};
  const Polygon above{{{0, 30}, {50, 30}, {50, 50}, {0, 50}}, {}};
  const Polygon right{{{50, 0}, {90, 0}, {90, 50}, {50, 50}, {50, 30}, {52, 30}, {52, 20}, {50, 20}}, {}};
  const Polygon no_fly{{{-10, 20}, {52, 20}, {52, 30}, {-10, 30}}, {}};
  const Ways ways(std::vector<Polygon>{below, above, right}, {&no_fly, 1});
  const auto corners = ways.corners(Vec2(49.999, 5), Vec2(49.999, 45)).value();
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_GT(corners[0].x(), 52.0);
}

TEST(Ways, BetweenFieldsRoundANoFlyArea) {
  const std::vector<Polygon> fields = {{rectangle(0, 0, 40, 40), {}}, {rectangle(100, 0, 140, 40), {}}};
  const std::vector<Polygon> no_fly = {{rectangle(60, -10, 80, 60), {}}, {rectangle(70, 50, 90, 100), {}}};
  const Ways ways(fields, no_fly);
  const auto corners = ways.corners(Vec2(20, 20), Vec2(120, 20)).value();
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_LT(corners[0].y(), -10.0);
}

TEST(Ways, AFieldInAHoleOfAnotherIsReached) {
  const std::vector<Polygon> fields = {{rectangle(0, 0, 100, 100), {hole(rectangle(30, 30, 70, 70))}},
                                       {rectangle(40, 40, 60, 60), {}}};
  EXPECT_TRUE(Ways(fields, {}).corners(Vec2(10, 50), Vec2(50, 50))->empty());
}

TEST(Ways, AHoleRoundAFieldIsCrossedOnItsAccountAlone) {
  const std::vector<Polygon> fields = {{rectangle(0, 0, 100, 100), {hole(rectangle(30, 30, 70, 70))}},
                                       {rectangle(40, 40, 60, 60), {}}};
  const Ways ways(fields, {});
  EXPECT_EQ(ways.corners(Vec2(-10, 50), Vec2(90, 50))->size(), 2U);
  EXPECT_TRUE(ways.corners(Vec2(-10, 50), Vec2(50, 50))->empty());
  // A field that fills the hole leaves nothing to go round.
  const std::vector<Polygon> filled = {fields[0], {rectangle(30, 30, 70, 70), {}}};
  EXPECT_TRUE(Ways(filled, {}).corners(Vec2(-10, 50), Vec2(90, 50))->empty());
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
      const auto corners = ways.corners(from, to).value();
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
      const auto back = ways.corners(to, from).value();
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
    auto way = ways.corners(at, to).value();
    EXPECT_FALSE(way.empty()) << row;
    way.push_back(to);
    for (const Vec2& next : way) {
      EXPECT_TRUE(ways.is_free(at, next)) << row;
      at = next;
    }
  }
}

/// How much of a stretch lies in a convex hole, clockwise: by its half-planes, one after the other.
double length_in_m(const Ring& hole, const Vec2& from, const Vec2& to) {
  double enters = 0.0;
  double leaves = 1.0;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const Vec2& a = hole[i];
    const Vec2 edge = hole[(i + 1) % hole.size()] - a;
    const Vec2 right(edge.y(), -edge.x());
    const double before = right.dot(from - a);
    const double after = right.dot(to - a);
    if (before <= 0.0 && after <= 0.0) return 0.0;
    if (before < 0.0) enters = std::max(enters, before / (before - after));
    if (after < 0.0) leaves = std::min(leaves, before / (before - after));
  }
  return std::max(0.0, leaves - enters) * (to - from).norm();
}

/// Trees of six corners, one somewhere in every square.
Polygon orchard(int columns, int rows, double side_m, Rng& rng) {
  Polygon out{rectangle(0, 0, columns * side_m, rows * side_m), {}};
  for (int i = 0; i < columns * rows; ++i) {
    const double radius = rng.uniform(0.5, 0.12 * side_m);
    const double room = side_m / 2.0 - radius - 0.2;
    const Vec2 middle((i % columns + 0.5) * side_m + rng.uniform(-room, room),
                      (i / columns + 0.5) * side_m + rng.uniform(-room, room));
    Ring tree;
    for (int k = 0; k < 6; ++k) {
      const double angle = -k * std::numbers::pi / 3.0;
      tree.emplace_back(middle.x() + radius * std::cos(angle), middle.y() + radius * std::sin(angle));
    }
    out.holes.push_back(std::move(tree));
  }
  return out;
}

/// So many corners that not all of them are looked at first.
TEST(Ways, CrossNoneOfAThousandTrees) {
  Rng rng(1);
  const Polygon field = orchard(40, 25, 12.0, rng);
  const Ways ways({&field, 1}, {});
  int bent = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Vec2 from(rng.uniform(1.0, 479.0), rng.uniform(1.0, 299.0));
    const double reach = trial % 3 == 0 ? 400.0 : 60.0;
    const Vec2 to(std::clamp(from.x() + rng.uniform(-reach, reach), 1.0, 479.0),
                  std::clamp(from.y() + rng.uniform(-reach, reach), 1.0, 299.0));
    if (!contains(field, from) || !contains(field, to)) continue;
    const auto corners = ways.corners(from, to);
    ASSERT_TRUE(corners.has_value());
    bent += corners->empty() ? 0 : 1;
    EXPECT_LE(length_m(from, *corners, to), 1.1 * (to - from).norm() + 10.0);
    Vec2 at = from;
    std::vector<Vec2> way = *corners;
    way.push_back(to);
    for (const Vec2& next : way) {
      for (const Ring& tree : field.holes) ASSERT_LE(length_in_m(tree, at, next), 5e-3) << "trial " << trial;
      at = next;
    }
  }
  EXPECT_GT(bent, 50);
}

/// The corners that are left when near ones are taken together do not see one another here.
TEST(Ways, FindTheirWayThroughAMazeOfManyCorners) {
  Polygon field{rectangle(0, 0, 401, 60), {}};
  const double gap = 0.4;  // at the ends of walls, above and below in turn
  for (int wall = 0; wall < 100; ++wall) {
    const double x = 2.0 + 4.0 * wall;
    const double low = wall % 2 == 0 ? gap : 0.05;
    const double high = wall % 2 == 0 ? 59.95 : 60.0 - gap;
    Ring left;
    Ring right;
    for (int k = 0; k <= 20; ++k) {
      const double y = low + (high - low) * k / 20.0;
      left.emplace_back(x + (k % 2 == 0 ? 0.0 : 0.5), y);
      right.emplace_back(x + 1.0 + (k % 2 == 0 ? 0.0 : 0.5), y);
    }
    left.insert(left.end(), right.rbegin(), right.rend());
    field.holes.push_back(left);
    if (signed_area_m2(left) > 0.0) std::reverse(field.holes.back().begin(), field.holes.back().end());
  }
  const Ways ways({&field, 1}, {});
  const auto corners = ways.corners(Vec2(0.5, 30.0), Vec2(400.5, 30.0));
  ASSERT_TRUE(corners.has_value());
  Vec2 at(0.5, 30.0);
  std::vector<Vec2> way = *corners;
  way.emplace_back(400.5, 30.0);
  test_support::Ground ground{{{{0, 0}, {401, 0}, {401, 60}, {0, 60}}}};
  for (const Ring& hole : field.holes) {
    ground.rings.emplace_back();
    for (const Vec2& p : hole) ground.rings.back().emplace_back(p.x(), p.y());
  }
  for (const Vec2& next : way) {
    const int steps = static_cast<int>((next - at).norm() / 0.25) + 1;
    for (int i = 0; i < steps; ++i) {
      const Vec2 p = at + (next - at) * (static_cast<double>(i) / steps);
      EXPECT_TRUE(test_support::is_on(ground, {p.x(), p.y()}) ||
                  test_support::distance_to_border(ground, {p.x(), p.y()}) < 5e-3);
    }
    at = next;
  }
}

TEST(Ways, ThereIsNoneIntoWhatIsBarredAllAround) {
  const std::vector<Polygon> fields = {{rectangle(0, 0, 40, 40), {}}, {rectangle(100, 0, 140, 40), {}}};
  const std::vector<Polygon> no_fly = {{rectangle(80, -20, 160, 60), {hole(rectangle(95, -5, 145, 45))}}};
  const Ways ways(fields, no_fly);
  EXPECT_FALSE(ways.corners(Vec2(20, 20), Vec2(120, 20)).has_value());
  EXPECT_FALSE(ways.corners(Vec2(120, 20), Vec2(20, 20)).has_value());
  EXPECT_TRUE(ways.corners(Vec2(105, 5), Vec2(135, 35)).has_value());
}

TEST(Ways, LeadOutOfANoFlyAreaByTheNearestBorder) {
  const std::vector<Polygon> fields = {{rectangle(0, 0, 40, 40), {}}};
  const std::vector<Polygon> no_fly = {{rectangle(60, 0, 100, 40), {}}};
  const Ways ways(fields, no_fly);
  const auto corners = ways.corners(Vec2(80, 38), Vec2(20, 20));
  ASSERT_TRUE(corners.has_value());
  ASSERT_EQ(corners->size(), 2U);
  EXPECT_NEAR((corners->front() - Vec2(80, 40.02)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((corners->back() - Vec2(60, 40)).norm(), 0.0, 0.05);
}

/// However little within: along the border nothing is free then.
TEST(Ways, LeadOutFromAHairsBreadthWithin) {
  const Vec2 along = Vec2(1.0, 0.0031).normalized();
  const Vec2 up(-along.y(), along.x());
  const auto at = [&](double x, double y) -> Vec2 { return Vec2(30.0, 30.0) + x * along + y * up; };
  const std::vector<Polygon> no_fly = {{{at(0, 0), at(14, 0), at(14, 14), at(0, 14)}, {}}};
  const Ways ways({}, no_fly);
  for (const double depth_m : {1e-7, 1e-5, 1e-3, 2e-3, 2.4e-3, 2.6e-3, 1e-2, 0.1}) {
    for (const Vec2& place : {at(5.0, depth_m), at(14.0 - depth_m, 5.0), at(5.0, 14.0 - depth_m)}) {
      for (const Vec2& other : {at(-20.0, 0.0), at(40.0, 0.001), at(7.0, 30.0), at(7.0, -20.0)}) {
        const auto out = ways.corners(place, other);
        ASSERT_TRUE(out.has_value()) << depth_m;
        EXPECT_EQ(ways.corners(other, place).has_value(), true) << depth_m;
        EXPECT_LE(out->size(), 4U);
      }
    }
  }
}

}  // namespace
}  // namespace swallowtail::coverage
