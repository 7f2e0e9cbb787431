#include "charger/motion/drive.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace swallowtail::charger {
namespace {

TEST(Drive, GoesStraightAtItsSpeed) {
  Drive drive(Vec3(0, 0, 0));
  drive.advance(Vec3(30, 40, 5), 2.0, 10.0);
  EXPECT_LT((drive.position_m() - Vec3(12, 16, 2)).norm(), 1e-9);
  EXPECT_NEAR(drive.speed_mps(), 2.0, 1e-12);
  EXPECT_NEAR(drive.distance_to_m(Vec3(30, 40, 5)), 30.0, 1e-9);
}

TEST(Drive, StandsExactlyOnTheTargetOnceReached) {
  Drive drive(Vec3(0, 0, 0));
  drive.advance(Vec3(3, 0, 1), 2.0, 10.0);
  EXPECT_EQ(drive.position_m(), Vec3(3, 0, 1));
  EXPECT_NEAR(drive.speed_mps(), 0.3, 1e-12);
  EXPECT_TRUE(drive.stands_at(Vec3(3, 0, 99)));
  drive.advance(Vec3(3, 0, 1), 2.0, 10.0);
  EXPECT_EQ(drive.speed_mps(), 0.0);
}

TEST(Drive, MovesNothingOnSenselessArguments) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Drive drive(Vec3(1, 2, 3));
  drive.advance(Vec3(9, 9, 9), -1.0, 1.0);
  drive.advance(Vec3(9, 9, 9), 1.0, -1.0);
  drive.advance(Vec3(9, 9, 9), nan, 1.0);
  drive.advance(Vec3(nan, 9, 9), 1.0, 1.0);
  EXPECT_EQ(drive.position_m(), Vec3(1, 2, 3));
  EXPECT_EQ(drive.speed_mps(), 0.0);
}

}  // namespace
}  // namespace swallowtail::charger
