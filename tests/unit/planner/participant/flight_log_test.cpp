#include "planner/participant/flight_log.hpp"

#include <gtest/gtest.h>

namespace swallowtail::planner {
namespace {

const TimedPath kFirst{{0, Vec3(0, 0, 10), Phase::kTransfer, 0},
                       {10, Vec3(0, 50, 10), Phase::kCover, 0},
                       {12, Vec3(10, 50, 10), Phase::kTransfer, 1},
                       {22, Vec3(10, 0, 10), Phase::kCover, 1}};

TEST(FlightLog, FliesTheOldPathUntilTheNewOneBegins) {
  FlightLog log;
  log.join(kFirst, 0.0);
  log.join({{5, Vec3(0, 25, 10), Phase::kTransfer, 0}, {10, Vec3(25, 25, 10), Phase::kTransfer, 0}}, 2.0);
  EXPECT_EQ(log.position(4), Vec3(0, 20, 10));
  EXPECT_EQ(log.position(6), Vec3(5, 25, 10));
  EXPECT_EQ(log.begin_s(), 5.0);
  EXPECT_EQ(log.target(4).phase, Phase::kCover) << "up to the seam it is still the strip";
  EXPECT_EQ(log.velocity(6), Vec3(5, 0, 0));
}

TEST(FlightLog, RestBeginsWhereItIs) {
  FlightLog log;
  log.join(kFirst, 0.0);
  const TimedPath rest = log.rest(11.0);
  ASSERT_EQ(rest.size(), 3u);
  EXPECT_EQ(rest.front().position_m, Vec3(5, 50, 10));
  EXPECT_EQ(rest.front().time_s, 11.0);
}

TEST(FlightLog, KnowsWhichStripHasBegun) {
  FlightLog log;
  log.join(kFirst, 0.0);
  EXPECT_TRUE(log.has_begun(0, Vec3(0, 0, 10), 1.0));
  EXPECT_FALSE(log.has_begun(1, Vec3(10, 50, 10), 11.0));
  EXPECT_TRUE(log.has_begun(1, Vec3(10, 50, 10), 12.5));
  EXPECT_TRUE(log.covers_later(1, 15.0));
  EXPECT_FALSE(log.covers_later(0, 15.0));
  log.note(5.0);
  log.join({{6, Vec3(0, 30, 10), Phase::kTransfer, 0}, {60, Vec3(25, 25, 10), Phase::kTransfer, 0}}, 5.0);
  log.join({{20, Vec3(6, 29, 10), Phase::kTransfer, 0}, {60, Vec3(25, 25, 10), Phase::kTransfer, 0}}, 19.0);
  EXPECT_TRUE(log.has_begun(0, Vec3(0, 0, 10), 30.0)) << "it stays begun while a detour is flown";
}

}  // namespace
}  // namespace swallowtail::planner
