#include "tools/sim/coverage_raster.hpp"

#include <gtest/gtest.h>

namespace swallowtail::sim {
namespace {

coverage::Field rectangle(double width_m, double depth_m, double height_m = 20.0) {
  coverage::Field field;
  field.id = 1;
  field.height_m = height_m;
  field.polygon.outline = {Vec2(0, 0), Vec2(width_m, 0), Vec2(width_m, depth_m), Vec2(0, depth_m)};
  return field;
}

const planner::Terrain kFlat = planner::Terrain::flat(0.0);

TEST(CoverageRaster, SeesWhatIsUnderTheSwath) {
  const std::vector<coverage::Field> fields = {rectangle(100, 20)};
  CoverageRaster raster(fields, kFlat, {.sensor_width_m = 10.0});
  EXPECT_EQ(raster.covered_percent(), 0.0);
  raster.stamp(Vec3(0, 5, 20), Vec3(100, 5, 20));
  EXPECT_NEAR(raster.covered_percent(), 50.0, 1e-9);
  raster.stamp(Vec3(0, 5, 20), Vec3(100, 5, 20));
  EXPECT_NEAR(raster.covered_percent(), 50.0, 1e-9) << "twice is not more";
  raster.stamp(Vec3(100, 15, 20), Vec3(50, 15, 20));
  EXPECT_NEAR(raster.covered_percent(), 75.0, 1e-9);
}

TEST(CoverageRaster, SmallSteppedStampsLeaveNoGaps) {
  coverage::Field field;
  field.id = 1;
  field.height_m = 20.0;
  field.polygon.outline = {Vec2(0, 0), Vec2(100, 50), Vec2(90, 70), Vec2(-10, 20)};
  const std::vector<coverage::Field> fields = {field};
  CoverageRaster raster(fields, kFlat, {.sensor_width_m = 23.0});
  const Vec3 from(-5, 10, 20);
  const Vec3 to(95, 60, 20);
  for (int i = 0; i < 280; ++i)
    raster.stamp(from + (to - from) * (i / 280.0), from + (to - from) * ((i + 1) / 280.0));
  EXPECT_NEAR(raster.covered_percent(), 100.0, 1e-9);
}

TEST(CoverageRaster, SeesNothingFromTheWrongHeight) {
  const std::vector<coverage::Field> fields = {rectangle(100, 20, 30.0)};
  CoverageRaster raster(fields, kFlat, {.sensor_width_m = 10.0, .height_tolerance_m = 2.0});
  raster.stamp(Vec3(0, 5, 27.5), Vec3(100, 5, 27.5));
  EXPECT_EQ(raster.covered_percent(), 0.0);
  raster.stamp(Vec3(0, 5, 28.5), Vec3(100, 5, 28.5));
  EXPECT_NEAR(raster.covered_percent(), 50.0, 1e-9);
}

TEST(CoverageRaster, LeavesHolesOut) {
  coverage::Field field = rectangle(100, 20);
  field.polygon.holes = {{Vec2(40, 0.5), Vec2(60, 0.5), Vec2(60, 19.5), Vec2(40, 19.5)}};
  const std::vector<coverage::Field> fields = {field};
  CoverageRaster raster(fields, kFlat, {.sensor_width_m = 20.0});
  raster.stamp(Vec3(0, 10, 20), Vec3(40, 10, 20));
  EXPECT_NEAR(raster.covered_percent(), 100.0 * 800.0 / 1620.0, 0.7);
  raster.stamp(Vec3(40, 10, 20), Vec3(100, 10, 20));
  EXPECT_NEAR(raster.covered_percent(), 100.0, 1e-9);
}

TEST(CoverageRaster, KeepsWithinItsBoundOfCells) {
  const std::vector<coverage::Field> fields = {rectangle(20'000, 15'000)};
  const CoverageRaster raster(fields, kFlat, {.sensor_width_m = 10.0});
  EXPECT_LE(raster.cells(), 2'000'000U);
  EXPECT_GT(raster.cells(), 1'000'000U);
  const CoverageRaster fine(std::vector<coverage::Field>{rectangle(50, 50)}, kFlat, {.sensor_width_m = 2.0});
  EXPECT_NEAR(fine.cell_size_m(), 0.2, 1e-9);
}

TEST(CoverageRaster, IsEmptyWithoutFields) {
  CoverageRaster raster({}, kFlat, {});
  raster.stamp(Vec3(0, 0, 20), Vec3(10, 0, 20));
  EXPECT_EQ(raster.covered_percent(), 0.0);
}

}  // namespace
}  // namespace swallowtail::sim
