#include "planner/world/terrain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace swallowtail::planner {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Terrain make(TerrainGrid grid) {
  auto terrain = Terrain::from_grid(std::move(grid));
  EXPECT_TRUE(terrain.ok()) << (terrain.ok() ? "" : terrain.error().message);
  return *terrain;
}

/// One cell, twisted: 0 at three corners, 10 at the north-east.
Terrain twisted() { return make({Vec2(0.0, 0.0), 10.0, 2, 2, {0.0F, 0.0F, 0.0F, 10.0F}}); }

TEST(Terrain, FlatIsAPlane) {
  const Terrain terrain = Terrain::flat(12.5);
  EXPECT_TRUE(terrain.is_flat());
  EXPECT_EQ(terrain.grid(), nullptr);
  EXPECT_EQ(terrain.height_at(1e6, -3.0), 12.5);
  EXPECT_EQ(terrain.max_in(Vec2(0, 0), Vec2(1, 1)), 12.5);
  EXPECT_EQ(terrain.max_slope(), 0.0);
  EXPECT_DOUBLE_EQ(terrain.min_height_above(Vec3(0, 0, 20), Vec3(9, 9, 15)), 2.5);
}

TEST(Terrain, RowsGoNorthAndSamplesAreHit) {
  const Terrain terrain = make({Vec2(100.0, 200.0), 2.0, 2, 3, {1, 2, 3, 4, 5, 6}});
  EXPECT_EQ(terrain.height_at(100, 200), 1);
  EXPECT_EQ(terrain.height_at(104, 200), 3);
  EXPECT_EQ(terrain.height_at(100, 202), 4);
  EXPECT_EQ(terrain.height_at(104, 202), 6);
  EXPECT_DOUBLE_EQ(terrain.height_at(101, 201), 3.0);
}

TEST(Terrain, EdgeIsContinuedOutside) {
  const Terrain terrain = make({Vec2(100.0, 200.0), 2.0, 2, 3, {1, 2, 3, 4, 5, 6}});
  EXPECT_EQ(terrain.height_at(-1e9, 200), 1);
  EXPECT_EQ(terrain.height_at(kInf, kInf), 6);
  EXPECT_EQ(terrain.max_in(Vec2(-1e6, -1e6), Vec2(-1e5, 1e6)), 4);
  EXPECT_DOUBLE_EQ(terrain.min_height_above(Vec3(-50, 202, 10), Vec3(-10, 202, 10)), 6.0);
}

TEST(Terrain, LeastHeightInsideATwistedCellIsExact) {
  // Along the diagonal the ground is 10·s²; the flight climbs 10·s: the gap 2 + 10 s (1 − s) is least at the
  // ends.
  EXPECT_DOUBLE_EQ(twisted().min_height_above(Vec3(0, 0, 2), Vec3(10, 10, 12)), 2.0);
  // Across it the ground is 10·s·(1 − s), highest in the middle: 2.5.
  EXPECT_DOUBLE_EQ(twisted().min_height_above(Vec3(0, 10, 5), Vec3(10, 0, 5)), 2.5);
}

TEST(Terrain, LengthBelowTheGroundIsExact) {
  const Terrain flat = Terrain::flat(10.0);
  EXPECT_DOUBLE_EQ(flat.length_below(Vec3(0, 0, 5), Vec3(8, 0, 11)), 10.0 * 5.0 / 6.0);
  EXPECT_EQ(flat.length_below(Vec3(0, 0, 10), Vec3(3, 4, 10)), 5.0) << "at the ground counts";
  EXPECT_EQ(flat.length_below(Vec3(0, 0, 10.5), Vec3(3, 4, 11)), 0.0);
  // Across the twisted cell the ground is 10·s·(1 − s): above 1.6 from s = 0.2 to 0.8.
  EXPECT_NEAR(twisted().length_below(Vec3(0, 10, 1.6), Vec3(10, 0, 1.6)), 0.6 * std::sqrt(200.0), 1e-12);
  // Beyond the north edge the edge is continued: 10 at x ≥ 10, so 0.5 m of the climb from 9.5 lies below.
  EXPECT_NEAR(twisted().length_below(Vec3(10, 20, 9.5), Vec3(10, 20, 12)), 0.5, 1e-12);
}

TEST(Terrain, NoPeakIsSteppedOver) {
  TerrainGrid grid{Vec2::Zero(), 1.0, 401, 401, std::vector<float>(401 * 401, 0.0F)};
  grid.elevation_m[200 * 401 + 200] = 90.0F;
  const Terrain terrain = make(grid);
  EXPECT_NEAR(terrain.min_height_above(Vec3(-1000, 200, 100), Vec3(1400, 200, 100)), 10.0, 1e-9);
  EXPECT_NEAR(terrain.min_height_above(Vec3(0, 201, 100), Vec3(400, 201, 100)), 100.0, 1e-9);
  EXPECT_EQ(terrain.max_in(Vec2(0, 0), Vec2(400, 400)), 90.0);
  EXPECT_EQ(terrain.max_in(Vec2(0, 0), Vec2(199, 400)), 0.0);
  EXPECT_DOUBLE_EQ(terrain.max_in(Vec2(0, 0), Vec2(199.5, 400)), 45.0);
}

TEST(Terrain, PointAndVerticalSegmentsWork) {
  EXPECT_DOUBLE_EQ(twisted().min_height_above(Vec3(10, 10, 15), Vec3(10, 10, 15)), 5.0);
  EXPECT_DOUBLE_EQ(twisted().min_height_above(Vec3(5, 5, 30), Vec3(5, 5, 2)), -0.5);
}

TEST(Terrain, SlopeIsTheSteepestGradient) {
  EXPECT_NEAR(twisted().max_slope(), std::sqrt(2.0), 1e-6);
  EXPECT_GE(twisted().max_slope(), std::sqrt(2.0));
  const Terrain plane = make({Vec2::Zero(), 5.0, 2, 3, {0, 3, 6, 4, 7, 10}});
  EXPECT_NEAR(plane.max_slope(), std::hypot(0.6, 0.8), 1e-6);
  EXPECT_NEAR(plane.max_slope_in(Vec2(1, 1), Vec2(2, 2)), 1.0, 1e-6);
}

TEST(Terrain, NotANumberInGivesNotANumberOut) {
  EXPECT_TRUE(std::isnan(twisted().height_at(kNan, 0)));
  EXPECT_TRUE(std::isnan(twisted().min_height_above(Vec3(0, kNan, 0), Vec3::Zero())));
  EXPECT_TRUE(std::isnan(twisted().min_height_above(Vec3(0, 0, kInf), Vec3::Zero())));
  EXPECT_TRUE(std::isnan(twisted().max_in(Vec2(kNan, 0), Vec2::Zero())));
  EXPECT_TRUE(std::isnan(twisted().max_slope_in(Vec2(kNan, 0), Vec2::Zero())));
}

TEST(Terrain, RefusesWhatIsNotARaster) {
  const auto message = [](TerrainGrid grid) {
    auto terrain = Terrain::from_grid(std::move(grid));
    return terrain.ok() ? std::string("accepted") : terrain.error().message;
  };
  EXPECT_THAT(message({Vec2::Zero(), 1.0, 1, 5, std::vector<float>(5)}), HasSubstr("at least 2 × 2"));
  EXPECT_THAT(message({Vec2::Zero(), 1.0, -3, -3, std::vector<float>(9)}), HasSubstr("at least 2 × 2"));
  EXPECT_THAT(message({Vec2::Zero(), 1.0, 2, 2, std::vector<float>(3)}), HasSubstr("need 4"));
  EXPECT_THAT(message({Vec2::Zero(), 0.0, 2, 2, std::vector<float>(4)}), HasSubstr("cell size"));
  EXPECT_THAT(message({Vec2::Zero(), kNan, 2, 2, std::vector<float>(4)}), HasSubstr("cell size"));
  EXPECT_THAT(message({Vec2(kInf, 0), 1.0, 2, 2, std::vector<float>(4)}), HasSubstr("origin"));
  EXPECT_THAT(message({Vec2::Zero(), 1.0, 2, 2, {0, 0, std::nanf(""), 0}}), HasSubstr("row 1, column 0"));
  EXPECT_THAT(message({Vec2::Zero(), 1.0, 2, 2, {0, -3.4e38F, 0, 0}}), HasSubstr("row 0, column 1"));
}

TEST(Mountains, AreSampledOverTheWholeArea) {
  const auto terrain =
      mountains_terrain({{10.0, 20.0, 30.0, 50.0}, {40.0, 20.0, 5.0, 50.0}}, Vec2(0, 0), Vec2(50.5, 40), 1.0);
  ASSERT_TRUE(terrain.ok());
  EXPECT_NEAR(terrain->height_at(10, 20), 30.0, 1e-5);
  EXPECT_NEAR(terrain->height_at(15, 20), 30.0 * std::exp(-0.5), 1e-4);
  EXPECT_NEAR(terrain->max_in(Vec2(0, 0), Vec2(50, 40)), 30.0, 1e-5);
  EXPECT_EQ(terrain->grid()->cols, 52);
  EXPECT_EQ(terrain->grid()->rows, 41);
}

TEST(Mountains, RefuseBadNumbers) {
  const Vec2 lo(0, 0);
  const Vec2 hi(10, 10);
  EXPECT_FALSE(mountains_terrain({}, lo, hi, 0.0).ok());
  EXPECT_FALSE(mountains_terrain({}, hi, lo, 1.0).ok());
  EXPECT_FALSE(mountains_terrain({}, lo, hi, 1e-9).ok());
  EXPECT_FALSE(mountains_terrain({{0, 0, kNan, 20}}, lo, hi, 1.0).ok());
  EXPECT_FALSE(mountains_terrain({{0, 0, 5, 0.0}}, lo, hi, 1.0).ok());
}

}  // namespace
}  // namespace swallowtail::planner
