#include "planner/world/obstacle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace swallowtail::planner {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Obstacle with(Shape shape) {
  Obstacle obstacle;
  obstacle.id = 42;
  obstacle.shape = std::move(shape);
  return obstacle;
}

std::string fault(const Obstacle& obstacle) {
  const Status status = validate(obstacle);
  return status.ok() ? "" : status.error().message;
}

TEST(Obstacle, AcceptsEveryKind) {
  EXPECT_EQ(fault(with(Sphere{1.0})), "");
  EXPECT_EQ(fault(with(Cylinder{1.0, 2.0})), "");
  EXPECT_EQ(fault(with(Cone{1.0, 2.0})), "");
  EXPECT_EQ(fault(with(Box{Vec3(1, 2, 3), 0.3})), "");
  EXPECT_EQ(fault(with(ConvexMesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, 0.0})), "");
}

TEST(Obstacle, RefusalsNameObstacleAndValue) {
  EXPECT_THAT(fault(with(Sphere{0.0})), testing::AllOf(HasSubstr("Obstacle 42"), HasSubstr("radius is 0 m")));
  EXPECT_THAT(fault(with(Sphere{kNan})), HasSubstr("radius"));
  EXPECT_THAT(fault(with(Cylinder{1.0, -2.0})), HasSubstr("height is -2"));
  EXPECT_THAT(fault(with(Cone{1e9, 2.0})), HasSubstr("radius"));
  EXPECT_THAT(fault(with(Box{Vec3(1, 0, 3), 0.0})), HasSubstr("1 × 0 × 3"));
  EXPECT_THAT(fault(with(Box{Vec3(1, 2, 3), kNan})), HasSubstr("yaw"));
}

TEST(Obstacle, AMeshMustHaveAVolume) {
  EXPECT_THAT(fault(with(ConvexMesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, 0.0})),
              HasSubstr("3 vertices"));
  EXPECT_THAT(fault(with(ConvexMesh{
                  {Vec3(0, 0, 5), Vec3(1, 0, 5), Vec3(0, 1, 5), Vec3(1, 1, 5), Vec3(3, 1, 5)}, 0.0})),
              HasSubstr("one plane"));
  EXPECT_THAT(fault(with(ConvexMesh{std::vector<Vec3>(6, Vec3(1, 1, 1)), 0.0})), HasSubstr("one plane"));
  EXPECT_THAT(fault(with(ConvexMesh{{Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(3, 3, 3)}, 0.0})),
              HasSubstr("one plane"));
  EXPECT_THAT(fault(with(ConvexMesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, kNan)}, 0.0})),
              HasSubstr("vertex"));
  EXPECT_THAT(fault(with(ConvexMesh{std::vector<Vec3>(kMaxVertices + 1, Vec3::Zero()), 0.0})),
              HasSubstr("vertices"));
}

TEST(Obstacle, MotionAndMarginAreChecked) {
  Obstacle fast = with(Sphere{1.0});
  fast.velocity_mps = Vec3(201, 0, 0);
  EXPECT_THAT(fault(fast), HasSubstr("speed is 201"));
  Obstacle lost = with(Sphere{1.0});
  lost.position_m.x() = kNan;
  EXPECT_THAT(fault(lost), HasSubstr("position"));
  Obstacle margin = with(Sphere{1.0});
  margin.margin_m = -0.5;
  EXPECT_THAT(fault(margin), HasSubstr("margin is -0.5"));
  Obstacle relief = with(Sphere{1.0});
  relief.relief_m = -0.5;
  EXPECT_THAT(fault(relief), HasSubstr("relief is -0.5"));
  Obstacle ends = with(Sphere{1.0});
  ends.valid_until_s = kNan;
  EXPECT_THAT(fault(ends), HasSubstr("valid-until"));
}

TEST(Obstacle, MovesFromItsStateTime) {
  Obstacle obstacle = with(Sphere{1.0});
  obstacle.position_m = Vec3(10, 0, 0);
  obstacle.velocity_mps = Vec3(2, 0, -1);
  obstacle.state_time_s = 100.0;
  EXPECT_TRUE(obstacle.position_at(103.0).isApprox(Vec3(16, 0, -3)));
  EXPECT_TRUE(obstacle.position_at(99.0).isApprox(Vec3(8, 0, 1)));
}

TEST(Obstacle, ExtentAndBoundingRadiusHoldTheShape) {
  EXPECT_DOUBLE_EQ(bounding_radius_m(Cylinder{3.0, 4.0}), 5.0);
  EXPECT_DOUBLE_EQ(bounding_radius_m(Cone{3.0, 4.0}), 4.0);
  EXPECT_DOUBLE_EQ(bounding_radius_m(Box{Vec3(2, 4, 4), 1.0}), 3.0);
  const Extent cone = extent(Cone{3.0, 4.0});
  EXPECT_TRUE(cone.min_m.isApprox(Vec3(-3, -3, 0)));
  EXPECT_TRUE(cone.max_m.isApprox(Vec3(3, 3, 4)));
  const Extent box = extent(Box{Vec3(4, 2, 6), std::numbers::pi / 2.0});
  EXPECT_TRUE(box.max_m.isApprox(Vec3(1, 2, 3)));
  const Extent mesh = extent(
      ConvexMesh{{Vec3(5, 0, 1), Vec3(4, 0, 0), Vec3(4, 1, 0), Vec3(4, 0, 2)}, std::numbers::pi / 2.0});
  EXPECT_TRUE(mesh.min_m.isApprox(Vec3(-1, 4, 0)));
  EXPECT_TRUE(mesh.max_m.isApprox(Vec3(0, 5, 2), 1e-9));
}

}  // namespace
}  // namespace swallowtail::planner
