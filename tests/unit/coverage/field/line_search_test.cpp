#include "coverage/field/detail/line_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "coverage/field/detail/geos.hpp"
#include "coverage/field/detail/line_tour.hpp"
#include "coverage/field/detail/patch.hpp"
#include "coverage/field/strips.hpp"
#include "planner/base/rng.hpp"
#include "tests/support/cover_oracle.hpp"
#include "tools/bench/cover/holed_field.hpp"

namespace swallowtail::coverage {
namespace {

using test_support::Ground;

Polygon field_of(std::uint64_t seed) { return clean(bench::holed_field(seed))->front(); }

Ground ground_of(const Polygon& polygon) {
  Ground out;
  const auto add = [&](const Ring& ring) {
    out.rings.emplace_back();
    for (const Vec2& p : ring) out.rings.back().emplace_back(p.x(), p.y());
  };
  add(polygon.outline);
  for (const Ring& hole : polygon.holes) add(hole);
  return out;
}

TEST(Patches, HaveTheAreaOfThePolygonTheyAreOf) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Polygon field = field_of(seed);
    EXPECT_NEAR(detail::area_m2(detail::patches_of(field)), area_m2(field), 1e-3) << seed;
  }
}

std::vector<detail::Patch> open_patches(const detail::OpenGround& ground) {
  std::vector<detail::Patch> out;
  for (std::size_t i = 0; i < ground.patches().size(); ++i) {
    if (ground.is_open(i)) out.push_back(ground.patches()[i]);
  }
  return out;
}

TEST(Patches, LoseWhatBandsSeeAsPolygonsDo) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Polygon field = field_of(seed);
    Rng rng(seed);
    detail::OpenGround left(detail::patches_of(field));
    std::vector<Ring> seen;
    for (int i = 0; i < 40; ++i) {
      const detail::Segment segment{{rng.uniform(-60, 60), rng.uniform(-60, 60)},
                                    {rng.uniform(-60, 60), rng.uniform(-60, 60)}};
      const detail::Band band = detail::band_of(segment, 5.0);
      const std::vector<detail::Patch> open = open_patches(left);
      double within_m2 = 0.0;
      for (const detail::Patch& patch : open) within_m2 += detail::part_in_band(patch, band).area_m2;
      const double before_m2 = left.area_m2();
      EXPECT_NEAR(detail::area_m2(detail::within(open, band)), within_m2, 1e-3);
      left.subtract(band);
      EXPECT_NEAR(before_m2 - left.area_m2(), within_m2, 1e-2);
      seen.push_back(detail::seen_from(segment, 5.0));
    }
    const detail::Shape rest = detail::Shape::of(field).minus(detail::Shape::of(seen));
    EXPECT_NEAR(left.area_m2(), rest.area_m2(), 0.05) << seed;
  }
}

/// Of a tour over all pieces, stops counted.
double tour_cost_m(const Polygon& field, const Strips& strips) {
  const detail::LinkCosts costs(field, {});
  detail::LineTour tour(costs);
  for (std::size_t i = 0; i < strips.pieces.size(); ++i)
    tour.insert(static_cast<int>(i), {strips.pieces[i].from_m, strips.pieces[i].to_m});
  tour.improve();
  return tour.cost_m();
}

double best_single_cost(const Polygon& field, StripParams params, const Strips& free) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = -1; i < 12; ++i) {
    params.sweep_rad = i < 0 ? free.sweep_rad : i * 3.14159 / 12.0;
    best = std::min(best, tour_cost_m(field, *cut_strips(field, params)));
  }
  return best;
}

TEST(LineSearch, SavesAgainstTheBestSingleDirectionBetweenHoles) {
  double sum = 0.0;
  constexpr int kFields = 4;
  for (std::uint64_t seed = 1; seed <= kFields; ++seed) {
    const Polygon field = field_of(seed);
    StripParams params;
    params.sensor_width_m = 10.0;
    params.piece_cost_m = 26.0;
    const auto strips = cut_strips(field, params);
    ASSERT_TRUE(strips.ok());
    std::vector<test_support::FlownLine> lines;
    for (const Piece& piece : strips->pieces)
      lines.push_back({{piece.from_m.x(), piece.from_m.y()}, {piece.to_m.x(), piece.to_m.y()}});
    const auto verdict = test_support::judge_cover(ground_of(field), lines, {.width_m = 10.0});
    EXPECT_GE(verdict.covered_share, 0.999) << seed;
    EXPECT_EQ(verdict.outside_m, 0.0) << seed;
    sum += 1.0 - tour_cost_m(field, *strips) / best_single_cost(field, params, *strips);
  }
  EXPECT_GE(sum / kFields, 0.08);
}

/// Lines along a border graze its corners, where rounding takes them for broken: one that was drawn on from
/// such a corner once lost what it had seen before it.
TEST(LineSearch, LosesNoGroundByLinesThatGrazeCorners) {
  const Polygon with_hole{{{172.82457896500654, 43.970187923335217},
                           {130.61528562879369, 65.142374273169821},
                           {117.833541849748, -0.12638742902764477},
                           {163.27371374623516, -9.9779235256085173}},
                          {{{149.85674955824308, 26.193360936017861},
                            {140.67881987214312, 35.371290622117812},
                            {131.50089018604316, 26.193360936017861},
                            {140.67881987214312, 17.01543124991791}}}};
  const auto field = clean(with_hole);
  ASSERT_TRUE(field.ok());
  StripParams params;
  params.sensor_width_m = 10.570225210487743;
  params.piece_cost_m = params.sensor_width_m + 2.0 * 7.1977976190415873;
  const auto strips = cut_strips(field->front(), params);
  ASSERT_TRUE(strips.ok());
  std::vector<Ring> seen;
  for (const Piece& piece : strips->pieces)
    seen.push_back(detail::seen_from({piece.from_m, piece.to_m}, params.sensor_width_m));
  const double open_m2 = detail::Shape::of(with_hole).minus(detail::Shape::of(seen)).area_m2();
  EXPECT_LE(open_m2, strips->uncovered_m2 + 0.05);
}

TEST(LineSearch, KeepsTheDirectionOfARectanglesStrips) {
  const Polygon field{{{0, 0}, {100, 0}, {100, 35}, {0, 35}}, {}};
  std::vector<detail::Segment> pieces;
  for (int s = 0; s < 4; ++s) pieces.push_back({{0.001, 4.375 + 8.75 * s}, {99.999, 4.375 + 8.75 * s}, s});
  EXPECT_EQ(detail::search_lines(field, {.width_m = 10.0, .piece_cost_m = 26.0, .rounds = 100}, pieces), 0.0);
  ASSERT_EQ(pieces.size(), 4U);
  // To and fro, moved together by as much as they need not be apart.
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_EQ(pieces[i].from_m.y(), pieces[i].to_m.y());
    EXPECT_NEAR(pieces[i].length_m(), 99.998, 1e-9);
    if (i == 0) continue;
    EXPECT_EQ(pieces[i].from_m.x(), pieces[i - 1].to_m.x());
    EXPECT_LE(std::abs(pieces[i].from_m.y() - pieces[i - 1].to_m.y()), 10.0);
  }
}

TEST(LineSearch, IsTheSameForASeed) {
  const Polygon field = field_of(7);
  const auto once = cut_strips(field, {.sensor_width_m = 10.0});
  const auto again = cut_strips(field, {.sensor_width_m = 10.0});
  ASSERT_EQ(once->pieces.size(), again->pieces.size());
  for (std::size_t i = 0; i < once->pieces.size(); ++i) {
    EXPECT_EQ(once->pieces[i].from_m, again->pieces[i].from_m);
    EXPECT_EQ(once->pieces[i].to_m, again->pieces[i].to_m);
  }
}

}  // namespace
}  // namespace swallowtail::coverage
