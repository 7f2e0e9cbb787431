#include "tools/mission/check/distance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace swallowtail::check {
namespace {

Solid solid(data::ObstacleShape shape) {
  Solid s;
  s.shape = shape;
  s.radius_m = 2.0;
  s.height_m = 4.0;
  s.size_m = {2, 4, 6};
  return s;
}

TEST(Distance, Sphere) {
  EXPECT_DOUBLE_EQ(distance_m(solid(data::ObstacleShape::kSphere), {3, 4, 0}, 0), 3.0);
}

TEST(Distance, Cylinder) {
  const Solid s = solid(data::ObstacleShape::kCylinder);
  EXPECT_DOUBLE_EQ(distance_m(s, {5, 0, 2}, 0), 3.0);
  EXPECT_DOUBLE_EQ(distance_m(s, {0, 0, 7}, 0), 3.0);
  EXPECT_DOUBLE_EQ(distance_m(s, {5, 0, 8}, 0), 5.0);
  EXPECT_DOUBLE_EQ(distance_m(s, {1, 0, 1}, 0), 0.0);
}

TEST(Distance, Cone) {
  const Solid s = solid(data::ObstacleShape::kCone);
  EXPECT_DOUBLE_EQ(distance_m(s, {0, 0, 7}, 0), 3.0);
  EXPECT_DOUBLE_EQ(distance_m(s, {0, 0, -1}, 0), 1.0);
  EXPECT_DOUBLE_EQ(distance_m(s, {0.9, 0, 2}, 0), 0.0);
  // Straight out from the middle of the slant: its normal is (4, 2)/sqrt(20).
  EXPECT_NEAR(distance_m(s, {1 + 4 / std::sqrt(20.0), 0, 2 + 2 / std::sqrt(20.0)}, 0), 1.0, 1e-12);
}

TEST(Distance, BoxTurned) {
  Solid s = solid(data::ObstacleShape::kBox);
  EXPECT_DOUBLE_EQ(distance_m(s, {4, 0, 0}, 0), 3.0);
  s.yaw_rad = std::acos(0.0);
  EXPECT_NEAR(distance_m(s, {4, 0, 0}, 0), 2.0, 1e-12);
}

TEST(Distance, HullNeverClaimsMoreThanThereIs) {
  Solid s = solid(data::ObstacleShape::kMesh);
  s.vertices = {{-1, -2, -3}, {1, -2, -3}, {-1, 2, -3}, {1, 2, -3},
                {-1, -2, 3},  {1, -2, 3},  {-1, 2, 3},  {1, 2, 3}};
  const Solid box = solid(data::ObstacleShape::kBox);
  for (const P3 p : {P3{4, 0, 0}, P3{3, 5, 1}, P3{2, 3, 7}, P3{-5, -5, -5}, P3{0.2, 0.1, 0.3}}) {
    const double exact = distance_m(box, p, 0);
    EXPECT_LE(distance_m(s, p, 0), exact + 1e-9);
    EXPECT_GE(distance_m(s, p, 0), exact - 0.02);
  }
}

TEST(Distance, MovesWithTime) {
  Solid s = solid(data::ObstacleShape::kSphere);
  s.velocity_mps = {1, 0, 0};
  s.since_s = 10.0;
  EXPECT_DOUBLE_EQ(distance_m(s, {10, 0, 0}, 15.0), 3.0);
}

}  // namespace
}  // namespace swallowtail::check
