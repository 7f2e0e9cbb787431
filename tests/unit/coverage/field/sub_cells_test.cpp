#include "coverage/field/sub_cells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coverage/field/swath.hpp"

namespace swallowtail::coverage {
namespace {

using testing::HasSubstr;

Field square_field(double height_m = 20.0) {
  return {7, "square", {{{0, 0}, {100, 0}, {100, 40}, {0, 40}}, {}}, height_m};
}

planner::Terrain slope(double rise) {
  planner::TerrainGrid grid;
  grid.origin_m = Vec2(-20, -20);
  grid.cell_size_m = 5.0;
  grid.rows = 20;
  grid.cols = 30;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.cols; ++c)
      grid.elevation_m.push_back(static_cast<float>(rise * (grid.origin_m.x() + c * 5.0)));
  }
  return planner::Terrain::from_grid(grid).value();
}

TEST(SubCells, OverFlatGroundEachStripIsOneAtTheFieldsHeight) {
  const FieldCut cut = cut_field(square_field(), planner::Terrain::flat(12.0), {});
  ASSERT_EQ(cut.status, FieldStatus::kPlanned) << cut.reason;
  EXPECT_EQ(cut.sub_cells.size(), 4U);
  for (const SubCell& cell : cut.sub_cells) {
    EXPECT_EQ(cell.alpha_m.z(), 32.0);
    EXPECT_EQ(cell.field_id, 7U);
  }
  EXPECT_NEAR(cut.area_m2, 4000.0, 1e-6);
  EXPECT_NEAR(cut.covered_m2, 4000.0, 0.1);
  EXPECT_NEAR(cut.outside_m2, 0.0, 1e-3);
}

TEST(SubCells, OverASlopeTheyStayWithinTheHeightBand) {
  const planner::Terrain terrain = slope(0.2);
  CutParams params;
  params.sweep_rad = 0.0;
  params.height_tolerance_m = 2.0;
  const FieldCut cut = cut_field(square_field(), terrain, params);
  ASSERT_EQ(cut.status, FieldStatus::kPlanned) << cut.reason;
  EXPECT_EQ(cut.cells, 4);
  EXPECT_GE(cut.sub_cells.size(), 4U * 5U) << "20 m of rise in bands of 4 m";
  EXPECT_EQ(cut.beyond_tolerance, 0);
  for (const SubCell& cell : cut.sub_cells) {
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Vec3 p = cell.alpha_m + share * (cell.beta_m - cell.alpha_m);
      EXPECT_NEAR(p.z() - terrain.height_at(p.x(), p.y()), 20.0, 2.05);
    }
  }
  EXPECT_GE(cut.covered_m2, 0.999 * cut.area_m2);
}

TEST(SubCells, NoneIsLongerThanABattery) {
  CutParams params;
  params.max_length_m = 30.0;
  const FieldCut cut = cut_field(square_field(), planner::Terrain::flat(0.0), params);
  ASSERT_EQ(cut.status, FieldStatus::kPlanned);
  EXPECT_EQ(cut.sub_cells.size(), 4U * 4U);
  for (const SubCell& cell : cut.sub_cells) EXPECT_LE(cell.length_m(), 30.0 + 1e-9);
}

TEST(SubCells, NoFlyAreasAreNeitherCoveredNorCrossed) {
  CutParams params;
  params.no_fly = {{{{40, -5}, {60, -5}, {60, 45}, {40, 45}}, {}}};
  const FieldCut cut = cut_field(square_field(), planner::Terrain::flat(0.0), params);
  ASSERT_EQ(cut.status, FieldStatus::kPlanned) << cut.reason;
  EXPECT_EQ(cut.polygons.size(), 2U) << "cut in two";
  EXPECT_NEAR(cut.area_m2, 3200.0, 1e-6);
  EXPECT_GE(cut.covered_m2, 0.999 * cut.area_m2);
  for (const SubCell& cell : cut.sub_cells)
    EXPECT_EQ(cell.alpha_m.x() < 40.0, cell.beta_m.x() < 40.0) << "a line runs through the no-fly area";
  params.no_fly = {{{{-1, -1}, {101, -1}, {101, 41}, {-1, 41}}, {}}};
  EXPECT_THAT(cut_field(square_field(), planner::Terrain::flat(0.0), params).reason, HasSubstr("no-fly"));
}

// GEOS' difference off a grid left the whole field.
TEST(SubCells, ANoFlyAreaDrawnAlongASlantedBorderIsTakenOff) {
  const Vec2 a(-18.0, -32.0);
  const Vec2 b(-35.0, 12.0);
  const Vec2 side = Vec2(-(b - a).y(), (b - a).x()).normalized() * 6.0;
  const Vec2 from = a + (b - a) * 0.5;
  const Vec2 to = a + (b - a) * 0.9;
  CutParams params;
  params.sensor_width_m = 3.0;
  params.no_fly = {{{from, to, to + side, from + side}, {}}};
  const FieldCut cut =
      cut_field({1, "slanted", {{a, b, b + side, a + side}, {}}, 20.0}, planner::Terrain::flat(0.0), params);
  ASSERT_EQ(cut.status, FieldStatus::kPlanned) << cut.reason;
  EXPECT_NEAR(cut.area_m2, 0.6 * (b - a).norm() * 6.0, 1e-3);
}

/// What a no-fly area leaves of the field along its border is slanted there like any border.
TEST(SubCells, NoLineGoesBeyondABorderIntoANoFlyAreaOrAHoleThatOneOpens) {
  CutParams params;
  params.sweep_rad = 0.0;
  params.rules.beyond = Beyond::kSlantedBorders;
  params.no_fly = {{{{60, -10}, {110, -10}, {110, 60}}, {}}};
  Field field = square_field();
  field.polygon.holes = {{{70, 14}, {70, 26}, {90, 26}, {90, 14}}};
  const FieldCut cut = cut_field(field, planner::Terrain::flat(0.0), params);
  ASSERT_NE(cut.status, FieldStatus::kRefused) << cut.reason;
  const Polygon& no_fly = params.no_fly.front();
  for (const SubCell& cell : cut.sub_cells) {
    for (int i = 0; i <= 100; ++i) {
      const Vec2 p = (cell.alpha_m + (cell.beta_m - cell.alpha_m) * (i / 100.0)).head<2>();
      EXPECT_FALSE(contains(no_fly, p) && border_distance_m(no_fly, p) > 0.01) << p.transpose();
      const Polygon hole{field.polygon.holes.front(), {}};
      EXPECT_FALSE(contains(hole, p) && border_distance_m(hole, p) > 0.01) << p.transpose();
    }
  }
}

/// Round a hole's corners too, the band that is skipped is no wider than asked.
TEST(SubCells, BeyondASkippedHeadlandTheCornersRoundAHoleAreAskedFor) {
  CutParams params;
  params.rules.headland = Headland::kSkip;
  params.rules.headland_m = 6.0;
  Field field = square_field();
  field.polygon.holes = {{{46, 16}, {46, 24}, {54, 24}, {54, 16}}};
  const FieldCut cut = cut_field(field, planner::Terrain::flat(0.0), params);
  ASSERT_EQ(cut.status, FieldStatus::kPlanned) << cut.reason;
  EXPECT_NEAR(cut.area_m2, 88.0 * 28.0 - (8.0 * 8.0 + 4.0 * 8.0 * 6.0 + std::numbers::pi * 36.0), 0.5);
}

/// A ditch along one line of the raster, the bottom of which even steps of half a cell miss.
TEST(SubCells, GroundBetweenEvenStepsCountsForTheHeightToo) {
  planner::TerrainGrid grid;
  grid.origin_m = Vec2(-20.0, -20.0);
  grid.cell_size_m = 3.0;
  grid.rows = 30;
  grid.cols = 50;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.cols; ++c) grid.elevation_m.push_back(c == 20 ? -4.4F : 0.0F);
  }
  const auto terrain = planner::Terrain::from_grid(grid).value();
  CutParams params;
  params.sweep_rad = 0.0;
  const FieldCut cut = cut_field(square_field(), terrain, params);
  ASSERT_EQ(cut.status, FieldStatus::kPlanned) << cut.reason;
  int beyond = 0;
  for (const SubCell& cell : cut.sub_cells) {
    bool within = true;
    for (int i = 0; i <= 1000; ++i) {
      const Vec3 p = cell.alpha_m + (cell.beta_m - cell.alpha_m) * (i / 1000.0);
      within = within && std::abs(p.z() - terrain.height_at(p.x(), p.y()) - 20.0) <=
                             1.01 * params.height_tolerance_m + 1e-6;
    }
    beyond += within ? 0 : 1;
  }
  EXPECT_EQ(cut.beyond_tolerance, beyond);
}

TEST(SubCells, ASkippedHeadlandIsNotAskedFor) {
  CutParams params;
  params.rules.headland = Headland::kSkip;
  params.rules.headland_m = 5.0;
  const FieldCut cut = cut_field(square_field(), planner::Terrain::flat(0.0), params);
  ASSERT_EQ(cut.status, FieldStatus::kPlanned) << cut.reason;
  EXPECT_NEAR(cut.area_m2, 90.0 * 30.0, 1e-6);
  for (const SubCell& cell : cut.sub_cells) EXPECT_GE(cell.alpha_m.head<2>().minCoeff(), 5.0);
  params.rules.headland_m = 25.0;
  EXPECT_THAT(cut_field(square_field(), planner::Terrain::flat(0.0), params).reason, HasSubstr("headland"));
}

TEST(SubCells, WhatCannotBePlannedComesBackRefusedWithItsReason) {
  const auto why = [](const Field& field, const CutParams& params) {
    return cut_field(field, planner::Terrain::flat(0.0), params).reason;
  };
  EXPECT_THAT(why(square_field(1.0), {}), HasSubstr("clearance"));
  EXPECT_THAT(why(square_field(1.0), {}), HasSubstr("Field 'square' near (0.00, 0.00) m"));
  CutParams strict;
  strict.rules.ceiling_m = 15.0;
  EXPECT_THAT(why(square_field(), strict), HasSubstr("ceiling"));
  CutParams wide;
  wide.sensor_width_m = 120.0;
  EXPECT_THAT(why(square_field(), wide), HasSubstr("sensor is wider"));
  CutParams weak;
  weak.max_length_m = 3.0;
  EXPECT_THAT(why(square_field(), weak), HasSubstr("cannot cross"));
  Field bow_tie = square_field();
  bow_tie.polygon.outline = {{0, 0}, {10, 10}, {10, 0}, {0, 12}};
  const FieldCut cut = cut_field(bow_tie, planner::Terrain::flat(0.0), {});
  EXPECT_EQ(cut.status, FieldStatus::kRefused);
  EXPECT_THAT(cut.reason, HasSubstr("Self-intersection"));
  EXPECT_TRUE(cut.sub_cells.empty());
  CutParams params;
  params.max_length_m = -1.0;
  EXPECT_THAT(cut_field(square_field(), planner::Terrain::flat(0.0), params).reason, HasSubstr("battery"));
}

TEST(SubCells, TheLargestGapIsFoundWithAPlaceInIt) {
  const std::vector<Polygon> field = {square_field().polygon};
  std::vector<SubCell> cells;
  const auto fly = [&](double y, double width_m) {
    SubCell cell;
    cell.alpha_m = Vec3(0, y, 20);
    cell.beta_m = Vec3(100, y, 20);
    cell.width_m = width_m;
    cells.push_back(cell);
  };
  fly(5.0, 10.0);
  fly(17.0, 10.0);
  fly(35.0, 10.0);
  const auto gap = largest_gap(field, cells);
  ASSERT_TRUE(gap.has_value());
  EXPECT_NEAR(gap->area_m2, 800.0, 1e-6);
  EXPECT_GT(gap->place_m.y(), 22.0);
  EXPECT_LT(gap->place_m.y(), 30.0);
  EXPECT_TRUE(contains(field[0], gap->place_m));
  fly(20.0, 40.0);
  EXPECT_FALSE(largest_gap(field, cells).has_value());
}

}  // namespace
}  // namespace swallowtail::coverage
