#include "planner/path/path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace swallowtail::planner {
namespace {

using testing::HasSubstr;

RoutePoint to(double x, double y, double z, Phase phase = Phase::kTransfer, std::uint32_t leg = 0,
              double dwell_s = 0.0) {
  return {Vec3(x, y, z), phase, leg, dwell_s};
}

TEST(Path, PositionIsInterpolatedAndClamped) {
  const TimedPath path = {{10, Vec3(0, 0, 0)},
                          {14, Vec3(8, 0, 4)},
                          {16, Vec3(8, 0, 4)},
                          {16, Vec3(8, 1, 4)},
                          {17, Vec3(9, 1, 4)}};
  EXPECT_EQ(position_at(path, 9), Vec3(0, 0, 0));
  EXPECT_EQ(position_at(path, 11), Vec3(2, 0, 1));
  EXPECT_EQ(position_at(path, 15), Vec3(8, 0, 4));
  EXPECT_EQ(position_at(path, 16), Vec3(8, 1, 4));
  EXPECT_EQ(position_at(path, 99), Vec3(9, 1, 4));
  EXPECT_DOUBLE_EQ(length_m(path), std::sqrt(80.0) + 2.0);
  EXPECT_EQ(length_m({}), 0.0);
}

TEST(TimeRoute, CruisesStraight) {
  const TimedPath path =
      time_route(Vec3(0, 0, 10), 5.0, {to(80, 0, 10), to(160, 0, 10, Phase::kCover, 3)}, {});
  ASSERT_EQ(path.size(), 3U);
  EXPECT_EQ(path[0].time_s, 5.0);
  EXPECT_NEAR(path[1].time_s, 15.0, 1e-6);
  EXPECT_NEAR(path[2].time_s, 25.0, 1e-6);
  EXPECT_EQ(path[2].phase, Phase::kCover);
  EXPECT_EQ(path[2].leg_index, 3U);
}

TEST(TimeRoute, StopsWhereTheTurnIsTooSharp) {
  const TimedPath path = time_route(Vec3(0, 0, 10), 0.0, {to(80, 0, 10), to(80, 80, 10)}, {});
  ASSERT_EQ(path.size(), 4U);
  EXPECT_EQ(path[2].position_m, path[1].position_m);
  EXPECT_NEAR(path[2].time_s - path[1].time_s, kStopToTurn_s, 1e-9);
  EXPECT_EQ(time_route(Vec3(0, 0, 10), 0.0, {to(80, 0, 10), to(160, 80, 10)}, {}).size(), 3U);
}

TEST(TimeRoute, ADwellCountsAsTheStop) {
  const TimedPath path =
      time_route(Vec3(0, 0, 10), 0.0, {to(80, 0, 10, Phase::kTransfer, 0, 5.0), to(80, 80, 10)}, {});
  ASSERT_EQ(path.size(), 4U);
  EXPECT_NEAR(path[2].time_s - path[1].time_s, 5.0, 1e-9);
  const TimedPath brief =
      time_route(Vec3(0, 0, 10), 0.0, {to(80, 0, 10, Phase::kTransfer, 0, 0.25), to(80, 80, 10)}, {});
  EXPECT_NEAR(brief[brief.size() - 2].time_s - brief[1].time_s, kStopToTurn_s, 1e-9);
}

TEST(TimeRoute, SteepSegmentsClimbFirstAndDescendLast) {
  const TimedPath up = time_route(Vec3(0, 0, 0), 0.0, {to(10, 0, 40)}, {});
  ASSERT_EQ(up.size(), 4U);
  EXPECT_EQ(up[1].position_m, Vec3(0, 0, 40));
  EXPECT_NEAR(up[1].time_s, 40.0 / 3.0, 1e-6);
  EXPECT_EQ(up[3].position_m, Vec3(10, 0, 40));
  const TimedPath down = time_route(Vec3(0, 0, 40), 0.0, {to(10, 0, 0)}, {});
  ASSERT_EQ(down.size(), 4U);
  EXPECT_EQ(down[1].position_m, Vec3(10, 0, 40));
}

TEST(TimeRoute, ClimbSpeedMayRuleASlopingSegment) {
  VehicleLimits limits;
  limits.climb_speed_mps = 1.0;
  EXPECT_NEAR(time_route(Vec3(0, 0, 0), 0.0, {to(40, 0, 20)}, limits).back().time_s, 20.0, 1e-6);
  EXPECT_NEAR(time_route(Vec3(0, 0, 20), 0.0, {to(40, 0, 0)}, limits).back().time_s, 20.0 / 3.0, 1e-6);
}

TEST(TimeRoute, NoRouteIsAPathThatStands) {
  const TimedPath path = time_route(Vec3(1, 2, 3), 7.0, {}, {});
  ASSERT_EQ(path.size(), 1U);
  EXPECT_EQ(path[0].position_m, Vec3(1, 2, 3));
}

TEST(VehicleLimits, RefusalsNameTheLimit) {
  EXPECT_TRUE(validate(VehicleLimits{}).ok());
  const auto fault = [](auto&& change) {
    VehicleLimits limits;
    change(limits);
    const Status status = validate(limits);
    return status.ok() ? std::string("accepted") : status.error().message;
  };
  EXPECT_THAT(fault([](auto& l) { l.radius_m = -1; }), HasSubstr("radius_m is -1"));
  EXPECT_THAT(fault([](auto& l) { l.margin_m = std::nan(""); }), HasSubstr("margin_m"));
  EXPECT_THAT(fault([](auto& l) { l.radius_m = l.margin_m = 0; }), HasSubstr("radius_m + margin_m"));
  EXPECT_THAT(fault([](auto& l) { l.cruise_speed_mps = 0; }), HasSubstr("cruise_speed_mps"));
  EXPECT_THAT(fault([](auto& l) { l.climb_speed_mps = std::numeric_limits<double>::infinity(); }),
              HasSubstr("climb_speed_mps"));
  EXPECT_THAT(fault([](auto& l) { l.descent_speed_mps = -2; }), HasSubstr("descent_speed_mps"));
  EXPECT_THAT(fault([](auto& l) { l.turn_max_rad = 4; }), HasSubstr("turn_max_rad"));
  EXPECT_THAT(fault([](auto& l) { l.climb_max_rad = 2; }), HasSubstr("climb_max_rad"));
}

}  // namespace
}  // namespace swallowtail::planner
