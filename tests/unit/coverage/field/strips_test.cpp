#include "coverage/field/strips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coverage/field/sweep.hpp"

namespace swallowtail::coverage {
namespace {

Ring rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// Share of a fine grid of points of the field that lie within half a sensor of a line, between its ends.
double seen_share(const Polygon& field, const Strips& strips, double width_m) {
  const Box box = bounds_of(field.outline);
  const Vec2 along(std::cos(strips.sweep_rad), std::sin(strips.sweep_rad));
  const Vec2 across(-along.y(), along.x());
  int inside = 0;
  int seen = 0;
  for (double x = box.lo.x() + 0.05; x < box.hi.x(); x += 0.4) {
    for (double y = box.lo.y() + 0.05; y < box.hi.y(); y += 0.4) {
      const Vec2 p(x, y);
      if (!contains(field, p)) continue;
      ++inside;
      seen += std::any_of(strips.pieces.begin(), strips.pieces.end(),
                          [&](const Piece& piece) {
                            const double s = (p - piece.from_m).dot(along);
                            return std::abs((p - piece.from_m).dot(across)) <= width_m / 2 + 1e-6 &&
                                   s >= -1e-6 && s <= (piece.to_m - piece.from_m).norm() + 1e-6;
                          })
                  ? 1
                  : 0;
    }
  }
  return static_cast<double>(seen) / inside;
}

/// Metres of lines inside holes, more than `depth_m` from the hole's border along the line.
double over_holes_m(const Polygon& field, const Strips& strips) {
  double out = 0.0;
  for (const Piece& piece : strips.pieces) {
    const double length = (piece.to_m - piece.from_m).norm();
    for (double s = 0.05; s < length; s += 0.1) {
      const Vec2 p = piece.from_m + (piece.to_m - piece.from_m) * (s / length);
      if (std::any_of(field.holes.begin(), field.holes.end(),
                      [&](const Ring& hole) { return contains(hole, p); }))
        out += 0.1;
    }
  }
  return out;
}

TEST(Strips, ARectangleIsFlownAlongItsLengthWithNoStripMissing) {
  const auto strips = cut_strips({rectangle(0, 0, 100, 35), {}}, {.sensor_width_m = 10.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_NEAR(std::sin(strips->sweep_rad), 0.0, 1e-9);
  EXPECT_EQ(strips->count, 4);
  EXPECT_NEAR(strips->width_m, 8.75, 1e-9);
  ASSERT_EQ(strips->pieces.size(), 4U);
  for (const Piece& piece : strips->pieces) EXPECT_NEAR((piece.to_m - piece.from_m).norm(), 100.0, 1e-6);
}

TEST(Strips, AnExactMultipleOfTheSensorNeedsNoStripMore) {
  EXPECT_EQ(strip_count(30.0, 10.0), 3);
  EXPECT_EQ(strip_count(30.0 + 1e-7, 10.0), 3);
  EXPECT_EQ(strip_count(30.1, 10.0), 4);
  EXPECT_EQ(strip_count(1e-3, 10.0), 1);
}

TEST(Strips, ASlantedBorderIsCoveredToItsEnd) {
  const Polygon triangle{{{0, 0}, {60, 0}, {0, 40}}, {}};
  const auto strips = cut_strips(triangle, {.sensor_width_m = 10.0, .sweep_rad = 0.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_NEAR(strips->pieces.front().to_m.x(), 60.0, 1e-6);
  EXPECT_EQ(seen_share(triangle, *strips, 10.0), 1.0);
}

TEST(Strips, AHoleThatSpansStripsSplitsThem) {
  const Polygon field{rectangle(0, 0, 100, 30), {rectangle(40, 8, 60, 22)}};
  const auto strips = cut_strips(field, {.sensor_width_m = 10.0, .sweep_rad = 0.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_EQ(strips->pieces.size(), 4U)
      << "the middle strip in two, the others brush the hole without their line crossing it";
  EXPECT_EQ(seen_share(field, *strips, 10.0), 1.0);
  EXPECT_EQ(over_holes_m(field, *strips), 0.0);
}

TEST(Strips, AHoleOnTheLineThatLeavesARimGetsTheRimFlownOnItsOwn) {
  const Polygon field{rectangle(0, 0, 100, 30), {rectangle(40, 11, 60, 18)}};
  const auto strips = cut_strips(field, {.sensor_width_m = 10.0, .sweep_rad = 0.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_EQ(strips->pieces.size(), 6U)
      << "left and right of the hole, the rims above and below, two whole strips";
  EXPECT_EQ(seen_share(field, *strips, 10.0), 1.0);
  EXPECT_EQ(over_holes_m(field, *strips), 0.0);
}

TEST(Strips, ARoundHoleIsPassedWithNoLineThroughIt) {
  Ring circle;
  for (int i = 0; i < 24; ++i)
    circle.emplace_back(50 + 14 * std::cos(-i * std::numbers::pi / 12),
                        25 + 14 * std::sin(-i * std::numbers::pi / 12));
  const Polygon field{rectangle(0, 0, 100, 50), {circle}};
  const auto strips = cut_strips(field, {.sensor_width_m = 10.0, .sweep_rad = 0.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_GE(seen_share(field, *strips, 10.0), 0.9999);
  // Over its slanted border only, and by less than a sensor's width at each of the ends.
  EXPECT_LE(over_holes_m(field, *strips), 6 * 5.0);
}

TEST(Strips, AUShapeIsFlownInItsArms) {
  const Polygon u{{{0, 0}, {60, 0}, {60, 50}, {40, 50}, {40, 20}, {20, 20}, {20, 50}, {0, 50}}, {}};
  const auto strips = cut_strips(u, {.sensor_width_m = 10.0, .sweep_rad = 0.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_EQ(strips->pieces.size(), 2U + 3U * 2U);
  EXPECT_EQ(seen_share(u, *strips, 10.0), 1.0);
}

TEST(Strips, ASensorWiderThanTheFieldMakesOneStripAndATinyOneIsRefused) {
  const auto wide = cut_strips({rectangle(0, 0, 20, 5), {}}, {.sensor_width_m = 50.0});
  ASSERT_TRUE(wide.ok());
  EXPECT_EQ(wide->pieces.size(), 1U);
  EXPECT_FALSE(cut_strips({rectangle(0, 0, 1e5, 1e5), {}}, {.sensor_width_m = 1.0}).ok());
  EXPECT_FALSE(cut_strips({rectangle(0, 0, 10, 10), {}}, {.sensor_width_m = 0.0}).ok());
}

}  // namespace
}  // namespace swallowtail::coverage
