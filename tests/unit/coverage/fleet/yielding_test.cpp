#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "coverage/fleet/drives.hpp"
#include "coverage/fleet/separation.hpp"

namespace swallowtail::coverage {
namespace {

constexpr Separation kApart{10.0, 5.0, 3.0};
constexpr double kForGood_s = std::numeric_limits<double>::infinity();

/// A robot that drives at 2 m/s while its aircraft, far away, flies until `lands_s`, and then stays.
Trace driver(const Vec3& from_m, const Vec3& to_m, double lands_s, double away_m) {
  const Vec3 away(away_m, 1000.0, 0.0);
  Stretch stretch;
  stretch.stands_m = {away, from_m};
  stretch.pieces = {{away, away + Vec3(50, 0, 0), 0.0, lands_s, false}};
  const double drive_s = (to_m - from_m).norm() / 2.0;
  stretch.drive = {from_m, 0.0, {{from_m, to_m, 0.0, drive_s, true}}, lands_s};
  Stretch last;
  last.stands_m = {to_m};
  last.stands_from_s = lands_s;
  last.take_off_s = lands_s + 10.0;
  last.drive = {to_m, lands_s + 10.0, {}, kForGood_s};
  Trace out;
  out.stretches = {stretch, last};
  out.end_m = away + Vec3(50, 0, 0);
  out.end_s = lands_s + 20.0;
  return out;
}

TEST(Yielding, ARobotWithTimeToSpareWaitsBeforeItsDriveAndItsAircraftDoesNot) {
  const Trace first = driver({0, 50, 0}, {100, 50, 0}, 90.0, 0.0);
  const Trace mover = driver({50, 0, 0}, {50, 100, 0}, 90.0, 500.0);
  const auto delays = delays_of(mover, std::vector{first}, kApart, 500.0);
  ASSERT_TRUE(delays);
  EXPECT_EQ(delays->stretch_s, (std::vector<double>{0.0, 0.0}));
  // Both would cross at 25 s; at 2 m/s and right angles √2 · 3 m lie between them after 2.12 s.
  EXPECT_EQ(delays->robot_s.front(), 3.0);
}

TEST(Yielding, WithoutTimeToSpareTheStretchIsLater) {
  const Trace first = driver({0, 50, 0}, {100, 50, 0}, 90.0, 0.0);
  const Trace mover = driver({50, 0, 0}, {50, 100, 0}, 51.0, 500.0);
  const auto delays = delays_of(mover, std::vector{first}, kApart, 500.0);
  ASSERT_TRUE(delays);
  EXPECT_GT(delays->stretch_s.front() + delays->robot_s.front(), 2.1);
  EXPECT_LE(delays->robot_s.front(), 1.0);
}

TEST(Yielding, PastOneThatStaysForGoodThereIsNoTime) {
  const Trace first = driver({0, 50, 0}, {50, 50, 0}, 90.0, 0.0);
  // It passes there after the other has come to stay, however early it leaves.
  const Trace mover = driver({50, -200, 0}, {50, 100, 0}, 160.0, 500.0);
  EXPECT_FALSE(delays_of(mover, std::vector{first}, kApart, 500.0));
}

TEST(Yielding, RobotsOnTheGroundAreNearWhateverTheirHeights) {
  const TimedPiece above{{0, 0, 20}, {10, 0, 20}, 0.0, 10.0, true};
  const TimedPiece below{{10, 0, 0}, {0, 0, 0}, 0.0, 10.0, true};
  EXPECT_TRUE(conflict(above, 0.0, below, kApart));
}

TEST(Drives, BendsAreDrivenAtTheRobotsSpeed) {
  const planner::Terrain terrain = planner::Terrain::flat(3.0);
  const FlightModel model({}, {}, terrain);
  Charger charger;
  charger.speed_mps = 2.0;
  const auto pieces = drive_of(charger, model, {0, 0, 0}, std::vector{Vec3(40, 0, 0)}, {40, 20, 0}, 5.0);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].to_m, Vec3(40, 0, 3));
  EXPECT_DOUBLE_EQ(pieces[0].start_s, 5.0);
  EXPECT_DOUBLE_EQ(pieces[0].end_s, 25.0);
  EXPECT_DOUBLE_EQ(pieces[1].end_s, 35.0);
}

}  // namespace
}  // namespace swallowtail::coverage
