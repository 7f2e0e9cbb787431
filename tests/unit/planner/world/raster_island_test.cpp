#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "planner/world/raster_file.hpp"

/// Real elevation data, where it is at hand (../shared/data/terrain beside the checkout).
namespace swallowtail::planner {
namespace {

std::string data(const std::string& file) {
  for (const std::string folder :
       {SWALLOWTAIL_SOURCE_DIR "/../shared/data/terrain/", "/work/shared/data/terrain/"}) {
    if (std::filesystem::exists(folder + file)) return folder + file;
  }
  return "";
}

TEST(Island, SpsoFileIsReadWhole) {
  const std::string file = data("christmas_island_spso_5m.tif");
  if (file.empty()) GTEST_SKIP() << "christmas_island_spso_5m.tif is not there";
  const auto terrain = read_terrain(file, {});
  ASSERT_TRUE(terrain.ok()) << terrain.error().message;
  EXPECT_EQ(terrain->grid()->cols, 1045);
  EXPECT_EQ(terrain->grid()->rows, 879);
  EXPECT_EQ(terrain->grid()->cell_size_m, 5.0);
  const Vec2 all(1e5, 1e5);
  EXPECT_NEAR(terrain->min_in(-all, all), 48.9, 0.06);
  EXPECT_NEAR(terrain->max_in(-all, all), 296.0, 0.06);
}

TEST(Island, NmopsoSeaIsAGap) {
  const std::string file = data("christmas_island_nmopso_5m.tif");
  if (file.empty()) GTEST_SKIP() << "christmas_island_nmopso_5m.tif is not there";
  const auto refused = read_terrain(file, {});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("53131 of 923923"), std::string::npos) << refused.error().message;
  RasterOptions sea;
  sea.no_data_elevation_m = 0.0;
  const auto terrain = read_terrain(file, sea);
  ASSERT_TRUE(terrain.ok()) << terrain.error().message;
  const auto& z = terrain->grid()->elevation_m;
  EXPECT_GE(std::count(z.begin(), z.end(), 0.0F), 53131);
  EXPECT_NEAR(*std::min_element(z.begin(), z.end()), -2.2, 0.06);
  EXPECT_NEAR(*std::max_element(z.begin(), z.end()), 358.4, 0.06);
}

TEST(Island, AroundAnOriginItKeepsItsGround) {
  const std::string file = data("christmas_island_spso_5m.tif");
  if (file.empty()) GTEST_SKIP() << "christmas_island_spso_5m.tif is not there";
  const auto own = read_terrain(file, {});
  RasterOptions options;
  options.origin = GeoOrigin{-10.49, 105.62, 10.0};
  const auto local = read_terrain(file, options);
  ASSERT_TRUE(own.ok());
  ASSERT_TRUE(local.ok()) << local.error().message;
  EXPECT_NEAR(local->grid()->cell_size_m, 5.0, 0.01);
  const Vec2 all(1e6, 1e6);
  EXPECT_NEAR(local->max_in(-all, all) + 10.0, own->max_in(-all, all), 2.0);
  EXPECT_LE(local->max_in(-all, all) + 10.0, own->max_in(-all, all) + 1e-3);
  EXPECT_GE(local->min_in(-all, all) + 10.0, own->min_in(-all, all) - 1e-3);
}

}  // namespace
}  // namespace swallowtail::planner
