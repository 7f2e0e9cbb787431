#include "coverage/ground/road_network.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/rng.hpp"

namespace swallowtail::coverage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A square of 100 m with a dead end off its north-east corner.
RoadParams square() {
  RoadParams out;
  out.lines = {{{0, 0}, {100, 0}, {100, 100}, {0, 100}, {0, 0}}, {{100, 100}, {160, 100}}};
  out.speed_mps = 2.0;
  return out;
}

TEST(RoadNetwork, DrivesTheShorterWayRound) {
  const auto roads = *RoadNetwork::make(square());
  EXPECT_DOUBLE_EQ(roads->drive_s({0, 0}, {100, 0}), 50.0);
  EXPECT_DOUBLE_EQ(roads->drive_s({10, 0}, {0, 20}), 15.0) << "round the corner";
  EXPECT_DOUBLE_EQ(roads->drive_s({0, 50}, {160, 100}), 0.5 * (50 + 100 + 60));
  EXPECT_DOUBLE_EQ(roads->drive_s({20, 0}, {70, 0}), 25.0) << "along one road";
  EXPECT_THAT(roads->bends({10, 0}, {0, 20}), ElementsAre(Vec2(10, 0), Vec2(0, 0), Vec2(0, 20)));
  EXPECT_EQ(roads->drive_s({33, 0}, {33, 0}), 0.0);
}

TEST(RoadNetwork, WithoutASpeedOffTheRoadOnlySitesOnItAreReached) {
  const auto roads = *RoadNetwork::make(square());
  EXPECT_TRUE(std::isfinite(roads->drive_s({0, 0}, {50, 1.9})));
  EXPECT_TRUE(std::isinf(roads->drive_s({0, 0}, {50, 2.5})));
  EXPECT_THAT(roads->bends({0, 0}, {50, 2.5}), IsEmpty());
}

TEST(RoadNetwork, LeavesTheRoadAtItsNearestPoint) {
  RoadParams params = square();
  params.off_road_speed_mps = 0.5;
  params.off_road_max_m = 30.0;
  const auto roads = *RoadNetwork::make(params);
  EXPECT_DOUBLE_EQ(roads->drive_s({0, 0}, {50, 20}), 25.0 + 40.0);
  EXPECT_THAT(roads->bends({0, 0}, {50, 20}), ElementsAre(Vec2(0, 0), Vec2(50, 0)));
  EXPECT_TRUE(std::isinf(roads->drive_s({0, 0}, {50, 40}))) << "too far off";
  EXPECT_DOUBLE_EQ(roads->drive_s({50, 20}, {50, 24}), 8.0) << "straight is quicker";
  EXPECT_THAT(roads->bends({50, 20}, {50, 24}), IsEmpty());
}

/// From one place beside the road to another it may be farther off on its way than it may stop.
TEST(RoadNetwork, KnowsWaysFromHalfWayAcross) {
  RoadParams params;
  params.lines = {{{0, 0}, {200, 0}}, {{0, 100}, {200, 100}}};
  params.lines.push_back({{0, 0}, {0, 100}});
  params.off_road_speed_mps = 1.0;
  params.speed_mps = 2.0;
  params.off_road_max_m = 40.0;
  const auto roads = *RoadNetwork::make(params);
  const Vec2 south(100, 35);
  const Vec2 north(100, 65);
  EXPECT_DOUBLE_EQ(roads->drive_s(south, north), 30.0);
  EXPECT_DOUBLE_EQ(roads->drive_s({100, 50}, north), 15.0);
  EXPECT_TRUE(std::isfinite(roads->drive_s({100, 50}, {200, 0})));
  EXPECT_TRUE(std::isinf(roads->drive_s(south, {100, 50}))) << "no place to stop at";
}

TEST(RoadNetwork, PartsThatDoNotMeetDoNotReachEachOther) {
  RoadParams params = square();
  params.lines.push_back({{300, 0}, {400, 0}});
  params.lines.push_back({{50, -50}, {50, 150}});  // a bridge over two sides of the square
  const auto roads = *RoadNetwork::make(params);
  EXPECT_TRUE(std::isinf(roads->drive_s({0, 0}, {350, 0})));
  EXPECT_TRUE(std::isinf(roads->drive_s({0, 0}, {50, -30})));
  EXPECT_DOUBLE_EQ(roads->drive_s({300, 0}, {350, 0}), 25.0);
}

TEST(RoadNetwork, VerticesThatNearlyMeetAreJoined) {
  RoadParams params;
  params.lines = {{{0, 0}, {50, 0}}, {{50.3, 0.2}, {100, 0}}};
  const auto roads = *RoadNetwork::make(params);
  EXPECT_NEAR(roads->drive_s({0, 0}, {100, 0}), 100.0 / 1.6, 1e-9);
}

TEST(RoadNetwork, BothWaysTakeAsLongAndTheBendsAreWhatIsDriven) {
  Rng rng(7);
  RoadParams params;
  for (int i = 0; i < 12; ++i) {
    params.lines.push_back({{i * 20.0, 0.0}, {i * 20.0, 100.0}, {i * 20.0, 200.0}});
    if (i > 0)
      params.lines.push_back(
          {{i * 20.0 - 20.0, rng.uniform() < 0.5 ? 100.0 : 0.0}, {i * 20.0, params.lines.back()[0].y()}});
  }
  params.off_road_speed_mps = 0.4;
  const auto roads = *RoadNetwork::make(params);
  for (int i = 0; i < 200; ++i) {
    const Vec2 a(rng.uniform(0.0, 220.0), rng.uniform(0.0, 200.0));
    const Vec2 b(rng.uniform(0.0, 220.0), rng.uniform(0.0, 200.0));
    const double there = roads->drive_s(a, b);
    ASSERT_NEAR(there, roads->drive_s(b, a), 1e-9);
    if (!std::isfinite(there)) continue;
    std::vector<Vec2> way = roads->bends(a, b);
    way.push_back(b);
    double time = (way.front() - a).norm() / 0.4;
    for (std::size_t k = 1; k < way.size(); ++k)
      time += (way[k] - way[k - 1]).norm() / (k + 1 == way.size() ? 0.4 : 1.6);
    EXPECT_NEAR(time, there, 1e-6);
  }
}

TEST(RoadNetwork, RefusesWhatCannotBe) {
  const auto message = [](auto spoil) {
    RoadParams params = square();
    spoil(params);
    const auto out = RoadNetwork::make(params);
    return out ? std::string() : out.error().message;
  };
  EXPECT_EQ(message([](RoadParams&) {}), "");
  EXPECT_THAT(message([](RoadParams& p) { p.lines.clear(); }), HasSubstr("no line"));
  EXPECT_THAT(message([](RoadParams& p) { p.lines[1].resize(1); }), HasSubstr("Road 2"));
  EXPECT_THAT(message([](RoadParams& p) { p.lines[0][2].x() = std::nan(""); }), HasSubstr("Road 1"));
  EXPECT_THAT(message([](RoadParams& p) { p.speed_mps = 0.0; }), HasSubstr("positive"));
  EXPECT_THAT(message([](RoadParams& p) { p.off_road_speed_mps = 3.0; }), HasSubstr("faster off"));
  EXPECT_THAT(message([](RoadParams& p) { p.lines = {{{0, 0}, {0.1, 0}}}; }), HasSubstr("shorter"));
}

}  // namespace
}  // namespace swallowtail::coverage
