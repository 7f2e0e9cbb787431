#include "tools/cli/terrain/generate.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace swallowtail::cli {
namespace {

class GeneratedTerrain : public testing::TestWithParam<TerrainKind> {};

TEST_P(GeneratedTerrain, SpansTheReliefAndTheSizeAskedFor) {
  TerrainParams params;
  params.kind = GetParam();
  params.size_m = Vec2(203, 101);
  params.cell_size_m = 5;
  params.relief_m = 37;
  const auto grid = generate_terrain(params);
  ASSERT_TRUE(grid.ok()) << grid.error().message;
  EXPECT_EQ(grid.value().cols, 42);  // 41 cells reach beyond 203 m
  EXPECT_EQ(grid.value().rows, 22);
  const auto [lo, hi] = std::ranges::minmax(grid.value().elevation_m);
  EXPECT_FLOAT_EQ(lo, 0.0f);
  EXPECT_FLOAT_EQ(hi, 37.0f);
  EXPECT_TRUE(planner::Terrain::from_grid(grid.value()).ok());
}

TEST_P(GeneratedTerrain, DependsOnTheSeedAlone) {
  TerrainParams params;
  params.kind = GetParam();
  const auto first = generate_terrain(params).value().elevation_m;
  EXPECT_EQ(generate_terrain(params).value().elevation_m, first);
  params.seed = 2;
  EXPECT_NE(generate_terrain(params).value().elevation_m, first);
}

INSTANTIATE_TEST_SUITE_P(Kinds, GeneratedTerrain,
                         testing::Values(TerrainKind::kMountains, TerrainKind::kHills,
                                         TerrainKind::kFarmland));

TEST(GeneratedTerrain, FarmlandHasTwoLevels) {
  TerrainParams params;
  params.kind = TerrainKind::kFarmland;
  params.relief_m = 10;
  const auto grid = generate_terrain(params);
  ASSERT_TRUE(grid.ok());
  const auto& z = grid.value().elevation_m;
  const auto at_level = std::ranges::count_if(z, [](float v) { return v == 0.0f || v == 10.0f; });
  EXPECT_GT(at_level, static_cast<std::ptrdiff_t>(z.size()) * 3 / 4);
}

TEST(GeneratedTerrain, RefusesWhatCannotBe) {
  const auto refused = [](auto change) {
    TerrainParams params;
    change(params);
    return !generate_terrain(params).ok();
  };
  EXPECT_TRUE(refused([](TerrainParams& p) { p.size_m.x() = 0; }));
  EXPECT_TRUE(refused([](TerrainParams& p) { p.size_m.y() = std::nan(""); }));
  EXPECT_TRUE(refused([](TerrainParams& p) { p.cell_size_m = -1; }));
  EXPECT_TRUE(refused([](TerrainParams& p) { p.cell_size_m = 0.01; }));
  EXPECT_TRUE(refused([](TerrainParams& p) { p.relief_m = 0; }));
  EXPECT_TRUE(refused([](TerrainParams& p) { p.count = 0; }));
}

}  // namespace
}  // namespace swallowtail::cli
