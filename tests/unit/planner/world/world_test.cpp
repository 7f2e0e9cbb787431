#include "planner/world/world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace swallowtail::planner {
namespace {

using testing::HasSubstr;

Obstacle sphere(std::uint32_t id) {
  Obstacle obstacle;
  obstacle.id = id;
  obstacle.shape = Sphere{1.0};
  return obstacle;
}

std::vector<Obstacle> spheres(const std::vector<std::uint32_t>& ids) {
  std::vector<Obstacle> obstacles;
  for (const std::uint32_t id : ids) obstacles.push_back(sphere(id));
  return obstacles;
}

TEST(World, KeepsWhatItIsGiven) {
  const auto world = World::make(Terrain::flat(3.0), spheres({1, 7}), Bounds{}, 4, 5);
  ASSERT_TRUE(world.ok());
  EXPECT_EQ((*world)->obstacles().size(), 2U);
  EXPECT_EQ((*world)->obstacles()[1].id, 7U);
  EXPECT_EQ((*world)->terrain().height_at(0, 0), 3.0);
  EXPECT_EQ((*world)->terrain_revision(), 4U);
  EXPECT_EQ((*world)->obstacle_revision(), 5U);
}

TEST(World, RefusesTwinsBadObstaclesAndEmptyBounds) {
  EXPECT_THAT(World::make(Terrain::flat(0), spheres({1, 2, 1}), Bounds{}).error().message,
              HasSubstr("id 1;"));
  std::vector<Obstacle> bad = spheres({3});
  bad[0].shape = Sphere{-1.0};
  EXPECT_THAT(World::make(Terrain::flat(0), bad, Bounds{}).error().message, HasSubstr("Obstacle 3"));
  EXPECT_THAT(World::make(Terrain::flat(0), {}, Bounds{Vec3(0, 0, 0), Vec3(1, 0, 1)}).error().message,
              HasSubstr("empty"));
  EXPECT_FALSE(World::make(Terrain::flat(0), {}, Bounds{Vec3::Constant(std::nan("")), Vec3(1, 1, 1)}).ok());
  EXPECT_FALSE(World::make(Terrain::flat(std::nan("")), {}, Bounds{}).ok());
}

}  // namespace
}  // namespace swallowtail::planner
