#include "coverage/fleet/separation.hpp"

#include <gtest/gtest.h>

#include "coverage/fleet/fleet.hpp"

namespace swallowtail::coverage {
namespace {

constexpr Separation kApart{10.0, 5.0, 3.0};

TimedPiece eastward(double y_m, double z_m) { return {{0, y_m, z_m}, {100, y_m, z_m}, 0.0, 10.0}; }

TEST(Conflict, SideBySideAsFarAsAskedIsNone) {
  EXPECT_TRUE(conflict(eastward(0, 20), 0.0, eastward(9.99, 20), kApart));
  EXPECT_FALSE(conflict(eastward(0, 20), 0.0, eastward(10.0, 20), kApart));
  EXPECT_FALSE(conflict(eastward(0, 20), 0.0, eastward(0, 25.0), kApart));
  EXPECT_TRUE(conflict(eastward(0, 20), 0.0, eastward(0, 24.99), kApart));
}

TEST(Conflict, OneBehindTheOtherClearsAfterTheDistance) {
  // 10 m/s: a second behind is 10 m behind.
  EXPECT_TRUE(conflict(eastward(0, 20), 0.99, eastward(0, 20), kApart));
  EXPECT_FALSE(conflict(eastward(0, 20), 1.0, eastward(0, 20), kApart));
}

TEST(Conflict, CrossingIsFoundAtTheInstantOfClosestApproach) {
  const TimedPiece northward{{50, -50, 20}, {50, 50, 20}, 0.0, 10.0};
  EXPECT_TRUE(conflict(northward, 0.0, eastward(0, 20), kApart));
  // Paths at right angles at equal speed: a lag of √2 · 10 m keeps them 10 m apart.
  EXPECT_TRUE(conflict(northward, 1.41, eastward(0, 20), kApart));
  EXPECT_FALSE(conflict(northward, 1.415, eastward(0, 20), kApart));
}

TEST(Conflict, ALandedAircraftNeedsLessRoom) {
  const TimedPiece parked{{50, 4, 20}, {50, 4, 20}, 0.0, 100.0, true};
  EXPECT_FALSE(conflict(eastward(0, 20), 0.0, parked, kApart));
  EXPECT_TRUE(conflict(eastward(2, 20), 0.0, parked, kApart));
}

Task meadow() {
  Task out;
  out.fields = {{1, "meadow", {{{0, 0}, {100, 0}, {100, 30}, {0, 30}}, {}}, 20.0}};
  out.sensor_width_m = 10.0;
  return out;
}

Error refused(int aircraft, const Separation& separation) {
  const auto fleet = plan_fleet(meadow(), planner::Terrain::flat(0.0), {}, {aircraft, separation, nullptr});
  return fleet ? Error{} : fleet.error();
}

TEST(Fleet, NumbersThatMakeNoSenseAreRefused) {
  EXPECT_EQ(refused(0, kApart).code, Error::Code::kBadInput);
  EXPECT_EQ(refused(-1, kApart).code, Error::Code::kBadInput);
  EXPECT_EQ(refused(4, kApart).message, "There are 4 aircraft and only 3 sub-cells to fly.");
  EXPECT_EQ(refused(2, {0.0, 5.0, 3.0}).code, Error::Code::kBadInput);
}

TEST(Fleet, DistancesThatTheFieldCannotOfferAreSaidSo) {
  const Error error = refused(2, {10.0, 100.0, 500.0});
  EXPECT_EQ(error.code, Error::Code::kInfeasible);
  EXPECT_NE(error.message.find("No waiting on the ground keeps 2 aircraft"), std::string::npos)
      << error.message;
}

TEST(Fleet, TheSameSeedGivesTheSamePlan) {
  const auto once = plan_fleet(meadow(), planner::Terrain::flat(0.0), {}, {3, kApart, nullptr});
  const auto again = plan_fleet(meadow(), planner::Terrain::flat(0.0), {}, {3, kApart, nullptr});
  ASSERT_TRUE(once && again);
  ASSERT_EQ(once->members.size(), 3u);
  EXPECT_EQ(once->makespan_s, again->makespan_s);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(once->members[k].plan.legs.front().start_s, again->members[k].plan.legs.front().start_s);
}

}  // namespace
}  // namespace swallowtail::coverage
