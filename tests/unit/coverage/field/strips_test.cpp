#include "coverage/field/strips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coverage/field/sweep.hpp"
#include "tests/support/cover_oracle.hpp"

namespace swallowtail::coverage {
namespace {

Ring rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

test_support::CoverVerdict judged(const Polygon& field, const Strips& strips, double width_m) {
  test_support::Ground ground;
  const auto add = [&](const Ring& ring) {
    ground.rings.emplace_back();
    for (const Vec2& p : ring) ground.rings.back().emplace_back(p.x(), p.y());
  };
  add(field.outline);
  for (const Ring& hole : field.holes) add(hole);
  std::vector<test_support::FlownLine> lines;
  for (const Piece& piece : strips.pieces)
    lines.push_back({{piece.from_m.x(), piece.from_m.y()}, {piece.to_m.x(), piece.to_m.y()}});
  return test_support::judge_cover(ground, lines, {.width_m = width_m});
}

TEST(Strips, ARectangleIsFlownAlongItsLengthWithNoStripMissing) {
  const auto strips = cut_strips({rectangle(0, 0, 100, 35), {}}, {.sensor_width_m = 10.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_NEAR(std::sin(strips->sweep_rad), 0.0, 1e-9);
  EXPECT_EQ(strips->count, 4);
  EXPECT_NEAR(strips->width_m, 8.75, 1e-9);
  ASSERT_EQ(strips->pieces.size(), 4U);
  for (const Piece& piece : strips->pieces) EXPECT_NEAR((piece.to_m - piece.from_m).norm(), 100.0, 3e-3);
}

TEST(Strips, AnExactMultipleOfTheSensorNeedsNoStripMore) {
  EXPECT_EQ(strip_count(30.0, 10.0), 3);
  EXPECT_EQ(strip_count(30.0 + 1e-7, 10.0), 3);
  EXPECT_EQ(strip_count(30.1, 10.0), 4);
  EXPECT_EQ(strip_count(1e-3, 10.0), 1);
}

TEST(Strips, ASlantedBorderIsCoveredToItsEndFromInside) {
  const Polygon triangle{{{0, 0}, {60, 0}, {0, 40}}, {}};
  const auto strips = cut_strips(triangle, {.sensor_width_m = 10.0, .sweep_rad = 0.0});
  ASSERT_TRUE(strips.ok());
  const auto verdict = judged(triangle, *strips, 10.0);
  EXPECT_GE(verdict.covered_share, 0.999);
  EXPECT_EQ(verdict.outside_m, 0.0);
  EXPECT_LE(strips->pieces.size(), 6U) << "four strips and the border, the strip at the tip left out";
}

TEST(Strips, ASlantedBorderIsOverflownWhereThatIsAllowed) {
  const Polygon triangle{{{0, 0}, {60, 0}, {0, 40}}, {}};
  const auto strips =
      cut_strips(triangle, {.sensor_width_m = 10.0, .sweep_rad = 0.0, .beyond = Beyond::kSlantedBorders});
  ASSERT_TRUE(strips.ok());
  EXPECT_EQ(strips->pieces.size(), 4U);
  EXPECT_NEAR(strips->pieces.front().to_m.x(), 60.0, 1e-6);
  const auto verdict = judged(triangle, *strips, 10.0);
  EXPECT_GE(verdict.covered_share, 0.9999);
  EXPECT_GT(verdict.outside_m, 0.0);
  EXPECT_LE(verdict.outside_m, 4 * 7.6) << "half a strip's width of a border that rises by two in three";
}

TEST(Strips, AHeadlandIsFlownAlongTheBorder) {
  const Polygon field{{{0, 0}, {100, 0}, {120, 80}, {0, 60}}, {}};
  const auto strips = cut_strips(field, {.sensor_width_m = 10.0, .headland_m = 20.0});
  ASSERT_TRUE(strips.ok());
  const auto verdict = judged(field, *strips, 10.0);
  EXPECT_GE(verdict.covered_share, 0.999);
  EXPECT_EQ(verdict.outside_m, 0.0);
  const auto along_border = [&](const Piece& piece) {
    return std::abs(piece.from_m.y() - 5.0) < 0.1 && std::abs(piece.to_m.y() - 5.0) < 0.1;
  };
  EXPECT_TRUE(std::any_of(strips->pieces.begin(), strips->pieces.end(), along_border));
}

/// In tips too, where a line may be the only one to see what lies farther aside than it is to overlap.
TEST(Strips, OverlappingStripsCoverTheFieldAllTheSame) {
  const Polygon field{{{-5.211, 8.498},
                       {-5.379, 19.575},
                       {-15.967, 20.536},
                       {-20.347, 19.787},
                       {-29.791, 15.758},
                       {-28.798, 8.747},
                       {-31.274, 2.914},
                       {-23.907, -1.722},
                       {-15.729, -9.749},
                       {-11.838, -5.641},
                       {-7.644, 3.301}},
                      {{{-16.321, 4.889},
                        {-20.421, 4.889},
                        {-22.471, 8.439},
                        {-20.421, 11.990},
                        {-16.321, 11.990},
                        {-14.270, 8.439}}}};
  for (const double overlap : {0.2, 0.360866, 0.5}) {
    const auto strips = cut_strips(field, {.sensor_width_m = 15.4288, .overlap = overlap});
    ASSERT_TRUE(strips.ok());
    EXPECT_GE(judged(field, *strips, 15.4288).covered_share, 0.999) << overlap;
  }
}

TEST(Strips, OverlappingStripsLieNearer) {
  const Polygon field{rectangle(0, 0, 100, 30), {}};
  EXPECT_EQ(cut_strips(field, {.sensor_width_m = 10.0, .overlap = 0.25})->count, 4);
  EXPECT_FALSE(cut_strips(field, {.sensor_width_m = 10.0, .overlap = 1.0}).ok());
  const Strips twice = *cut_strips(field, {.sensor_width_m = 10.0, .overlap = 0.5});
  EXPECT_EQ(twice.count, 6);
  EXPECT_EQ(twice.pieces.size(), 6u) << "a line that its neighbours make up for is flown all the same";
}

TEST(Strips, AHoleThatSpansStripsSplitsThem) {
  const Polygon field{rectangle(0, 0, 100, 30), {rectangle(40, 8, 60, 22)}};
  const auto strips = cut_strips(field, {.sensor_width_m = 10.0, .sweep_rad = 0.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_EQ(strips->pieces.size(), 4U)
      << "the middle strip in two, the others brush the hole without their line crossing it";
  EXPECT_GE(judged(field, *strips, 10.0).covered_share, 0.999);
  EXPECT_EQ(judged(field, *strips, 10.0).outside_m, 0.0);
}

TEST(Strips, AHoleOnTheLineThatLeavesARimGetsTheRimFlownOnItsOwn) {
  const Polygon field{rectangle(0, 0, 100, 30), {rectangle(40, 11, 60, 18)}};
  const auto strips = cut_strips(field, {.sensor_width_m = 10.0, .sweep_rad = 0.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_EQ(strips->pieces.size(), 6U)
      << "left and right of the hole, the rims above and below, two whole strips";
  EXPECT_GE(judged(field, *strips, 10.0).covered_share, 0.999);
  EXPECT_EQ(judged(field, *strips, 10.0).outside_m, 0.0);
}

TEST(Strips, ARoundHoleIsPassedWithNoLineThroughIt) {
  Ring circle;
  for (int i = 0; i < 24; ++i)
    circle.emplace_back(50 + 14 * std::cos(-i * std::numbers::pi / 12),
                        25 + 14 * std::sin(-i * std::numbers::pi / 12));
  const Polygon field{rectangle(0, 0, 100, 50), {circle}};
  const auto strips = cut_strips(field, {.sensor_width_m = 10.0, .sweep_rad = 0.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_GE(judged(field, *strips, 10.0).covered_share, 0.999);
  EXPECT_EQ(judged(field, *strips, 10.0).outside_m, 0.0);
}

TEST(Strips, AUShapeIsFlownInItsArms) {
  const Polygon u{{{0, 0}, {60, 0}, {60, 50}, {40, 50}, {40, 20}, {20, 20}, {20, 50}, {0, 50}}, {}};
  const auto strips = cut_strips(u, {.sensor_width_m = 10.0, .sweep_rad = 0.0});
  ASSERT_TRUE(strips.ok());
  EXPECT_EQ(strips->pieces.size(), 2U + 3U * 2U);
  EXPECT_EQ(judged(u, *strips, 10.0).covered_share, 1.0);
  EXPECT_EQ(judged(u, *strips, 10.0).outside_m, 0.0);
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
