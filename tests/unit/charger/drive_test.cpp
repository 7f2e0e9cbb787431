#include "charger/motion/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(Drive, FollowsAWayRoundItsBends) {
  const std::vector<Vec3> bends{Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(10, 20, 0)};
  Drive drive(Vec3(0, 0, 0));
  double way_m = 0.0;
  Vec3 last = drive.position_m();
  for (int step = 0; step < 1000 && !drive.stands_at(Vec3(0, 20, 0)); ++step) {
    drive.follow(bends, Vec3(0, 20, 0), 2.0, 0.35);
    way_m += (drive.position_m() - last).norm();
    last = drive.position_m();
    const bool on_way = last.y() == 0.0 || std::abs(last.x() - 10.0) < 1e-9 || last.y() == 20.0;
    EXPECT_TRUE(on_way) << last.transpose();
    EXPECT_LE(drive.speed_mps(), 2.0 + 1e-9);
  }
  EXPECT_TRUE(drive.stands_at(Vec3(0, 20, 0)));
  EXPECT_LT(way_m, 40.0 + 1e-9);
  EXPECT_GT(way_m, 38.0) << "corners are cut by less than a step's length";
}

TEST(Drive, ComesBackToItsWayFirst) {
  Drive drive(Vec3(5, -3, 0));
  drive.follow({Vec3(0, 0, 0), Vec3(10, 0, 0)}, Vec3(10, 20, 0), 1.0, 4.0);
  EXPECT_LT((drive.position_m() - Vec3(6, 0, 0)).norm(), 1e-9);
  EXPECT_NEAR(drive.speed_mps(), 1.0, 1e-9);
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
