#include "planner/participant/world_keeper.hpp"

#include <gtest/gtest.h>

namespace swallowtail::planner {
namespace {

data::TerrainTile tile(std::uint32_t col, float height, std::uint32_t revision = 1) {
  data::TerrainTile t;
  t.map_id = 1;
  t.col = col;
  t.revision = revision;
  t.cell_size_m = 10;
  t.map_rows = t.tile_rows = 4;
  t.map_cols = 8;
  t.tile_cols = 4;
  t.first_col = 4 * col;
  t.elevation_m.assign(16, height);
  return t;
}

data::Obstacle sphere(std::uint32_t id) {
  data::Obstacle o;
  o.obstacle_id = id;
  o.radius_m = 3;
  return o;
}

TEST(WorldKeeper, HasFlatGroundAtZeroWithoutTerrain) {
  WorldKeeper keeper;
  ASSERT_NE(keeper.world(), nullptr);
  EXPECT_EQ(keeper.world()->terrain().height_at(5, 5), 0.0);
}

TEST(WorldKeeper, PutsTilesTogether) {
  WorldKeeper keeper;
  keeper.set_has_terrain(true);
  ASSERT_TRUE(keeper.put(tile(0, 1.0F)).ok());
  EXPECT_EQ(keeper.world(), nullptr);
  ASSERT_TRUE(keeper.put(tile(1, 5.0F)).ok());
  ASSERT_NE(keeper.world(), nullptr);
  EXPECT_EQ(keeper.world()->terrain().height_at(5, 5), 1.0);
  EXPECT_EQ(keeper.world()->terrain().height_at(65, 5), 5.0);
  ASSERT_TRUE(keeper.put(tile(1, 9.0F, 2)).ok());
  EXPECT_EQ(keeper.world()->terrain().height_at(65, 5), 9.0);
  EXPECT_EQ(keeper.terrain_revision(), 2u);
  ASSERT_TRUE(keeper.put(tile(1, 3.0F, 1)).ok());
  EXPECT_EQ(keeper.world()->terrain().height_at(65, 5), 9.0) << "an old revision comes late";
}

TEST(WorldKeeper, RefusesATileOutsideItsMap) {
  WorldKeeper keeper;
  data::TerrainTile t = tile(1, 1.0F);
  t.first_col = 6;
  EXPECT_FALSE(keeper.put(t).ok());
}

TEST(WorldKeeper, KeepsObstaclesUntilTheyAreGone) {
  WorldKeeper keeper;
  ASSERT_TRUE(keeper.put(sphere(1)).ok());
  ASSERT_TRUE(keeper.put(sphere(2)).ok());
  ASSERT_TRUE(keeper.put(sphere(1)).ok());
  EXPECT_EQ(keeper.world()->obstacles().size(), 2u);
  EXPECT_EQ(keeper.obstacle_revision(), 3u);
  EXPECT_TRUE(keeper.take_changed());
  EXPECT_FALSE(keeper.take_changed());
  keeper.remove_obstacle(1);
  EXPECT_TRUE(keeper.take_changed());
  EXPECT_EQ(keeper.world()->obstacles().size(), 1u);
  keeper.remove_obstacle(1);
  EXPECT_FALSE(keeper.take_changed());
}

TEST(WorldKeeper, RefusesAnObstacleItCannotUse) {
  WorldKeeper keeper;
  data::Obstacle flat = sphere(1);
  flat.shape = data::ObstacleShape::kMesh;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_FALSE(keeper.put(flat).ok());
  EXPECT_TRUE(keeper.world()->obstacles().empty());
}

}  // namespace
}  // namespace swallowtail::planner
