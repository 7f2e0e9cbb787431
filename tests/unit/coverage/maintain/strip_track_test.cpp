#include "coverage/maintain/strip_track.hpp"

#include <gtest/gtest.h>

namespace swallowtail::coverage {
namespace {

class Track : public testing::Test {
 protected:
  Track() {
    leg_.entry_m = Vec3(0, 0, 20);
    leg_.exit_m = Vec3(100, 0, 20);
  }
  /// Flies on at 8 m/s with positions every 0.1 s; `off` metres sideways between two places.
  void fly(StripTrack& track, double from, double to, double off_from = 1e9, double off_to = 1e9,
           double off = 2.0) {
    for (double x = from; x <= to; x += 0.8) {
      time_ += 0.1;
      track.add(time_, Vec3(x, x > off_from && x < off_to ? off : 0.0, 20));
    }
  }
  Leg leg_;
  double time_ = 0.0;
};

TEST_F(Track, AStripFlownStraightHasNoGap) {
  StripTrack track(leg_, {});
  fly(track, 0.0, 100.0);
  EXPECT_TRUE(track.gaps().empty());
  EXPECT_NEAR(track.flown_from_entry_m(), 100.0, 1.0);
}

TEST_F(Track, ADetourLeavesItsStretch) {
  StripTrack track(leg_, {});
  fly(track, 0.0, 100.0, 40.0, 60.0);
  ASSERT_EQ(track.gaps().size(), 1U);
  EXPECT_NEAR(track.gaps()[0].from_m, 40.0, 1.0);
  EXPECT_NEAR(track.gaps()[0].to_m, 60.0, 1.0);
  EXPECT_NEAR(track.flown_from_entry_m(), 40.0, 1.0);
}

TEST_F(Track, FlownOverWithoutCoveringIsMissing) {
  StripTrack track(leg_, {});
  fly(track, 0.0, 40.0);
  // Over an obstacle, within what the altitude may be off.
  for (double x = 40.8; x < 60.0; x += 0.8) track.add(time_ += 0.1, Vec3(x, 0, 22), false);
  fly(track, 60.0, 100.0);
  ASSERT_EQ(track.gaps().size(), 1U);
  EXPECT_NEAR(track.gaps()[0].from_m, 40.0, 1.0);
  EXPECT_NEAR(track.gaps()[0].to_m, 60.0, 1.0);
}

TEST_F(Track, AHoldOnTheWayIsNoGap) {
  StripTrack track(leg_, {});
  fly(track, 0.0, 40.0);
  for (int i = 0; i < 50; ++i) track.add(time_ += 0.1, Vec3(40.4, 0, 20), false);
  fly(track, 41.0, 100.0);
  EXPECT_TRUE(track.gaps().empty());
}

TEST_F(Track, AShortLegPassedFarAsideIsMissing) {
  leg_.exit_m = Vec3(10, 0, 20);
  StripTrack track(leg_, {});
  track.add(0.05, Vec3(0, 0, 50));
  fly(track, 0.0, 10.0, -1.0, 11.0, 20.0);
  ASSERT_EQ(track.gaps().size(), 1U);
  EXPECT_NEAR(track.gaps()[0].to_m - track.gaps()[0].from_m, 10.0, 1e-9);
}

TEST_F(Track, SidewaysByLessThanHalfAMetreCounts) {
  StripTrack track(leg_, {});
  fly(track, 0.0, 100.0, 40.0, 60.0, 0.4);
  EXPECT_TRUE(track.gaps().empty());
}

TEST_F(Track, AStripBrokenOffLacksItsEnd) {
  StripTrack track(leg_, {});
  fly(track, 0.0, 30.0);
  ASSERT_EQ(track.gaps().size(), 1U);
  EXPECT_NEAR(track.gaps()[0].from_m, 30.0, 1.0);
  EXPECT_EQ(track.gaps()[0].to_m, 100.0);
  track.end_at(Vec3(30, 0, 20));
  EXPECT_TRUE(track.gaps().empty());
}

TEST_F(Track, APauseOfThePositionsOnAStraightFlightIsNoGap) {
  StripTrack track(leg_, {});
  fly(track, 0.0, 30.0);
  time_ += 5.0;  // 40 m at 8 m/s
  fly(track, 70.0, 100.0);
  EXPECT_TRUE(track.gaps().empty());
}

TEST_F(Track, APauseTooLongForAStraightFlightIsOne) {
  StripTrack track(leg_, {});
  fly(track, 0.0, 30.0);
  time_ += 12.0;
  fly(track, 70.0, 100.0);
  EXPECT_EQ(track.gaps().size(), 1U);
}

TEST_F(Track, AStripPassedBesideIsMissedWholeAndOneNeverWatchedIsBelieved) {
  StripTrack beside(leg_, {});
  fly(beside, 0.0, 100.0, -1.0, 101.0, 6.0);
  ASSERT_EQ(beside.gaps().size(), 1U);
  EXPECT_EQ(beside.gaps()[0].to_m, 100.0);
  EXPECT_TRUE(StripTrack(leg_, {}).gaps().empty());
}

}  // namespace
}  // namespace swallowtail::coverage
