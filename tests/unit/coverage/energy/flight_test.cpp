#include "coverage/energy/flight.hpp"

#include <gtest/gtest.h>

#include <string>

#include "planner/base/rng.hpp"

namespace swallowtail::coverage {
namespace {

const planner::Terrain kFlat = planner::Terrain::flat(0.0);
const planner::VehicleLimits kLimits;

TEST(Flight, PhasesCostWhatTheModelSays) {
  const FlightModel model(
      kLimits, {.level_per_s = 2.0, .climb_per_s = 5.0, .descent_per_s = 0.5, .hover_per_s = 3.0}, kFlat);
  EXPECT_DOUBLE_EQ(model.level(Vec3(0, 0, 10), Vec3(0, 80, 10)).time_s, 10.0);
  EXPECT_DOUBLE_EQ(model.level(Vec3(0, 0, 10), Vec3(0, 80, 10)).energy, 20.0);
  EXPECT_DOUBLE_EQ(model.vertical(0.0, 30.0).energy, 50.0);
  EXPECT_DOUBLE_EQ(model.vertical(30.0, 0.0).energy, 5.0);
  EXPECT_DOUBLE_EQ(model.take_off(Vec3(5, 5, 30)).time_s, 11.0);
  EXPECT_DOUBLE_EQ(model.landing(Vec3(5, 5, 30)).energy, 3.0 + 5.0);
}

TEST(Flight, TurnsStopOnlyWhereTheLimitIsBroken) {
  const FlightModel model(kLimits, {}, kFlat);
  const Vec3 a(0, 0, 20);
  const Vec3 b(80, 0, 20);
  EXPECT_DOUBLE_EQ(model.transfer(a, b, {Vec3(1, 0, 0), Vec3(1, 0, 0)}).time_s, 10.0);
  EXPECT_DOUBLE_EQ(model.transfer(a, b, {Vec3(0, 1, 0), Vec3(1, 0, 0)}).time_s, 11.0);
  EXPECT_DOUBLE_EQ(model.transfer(a, b, {Vec3(0, 1, 0), Vec3(0, -1, 0)}).time_s, 12.0);
}

/// planner::time_route decides how long flights really take: predictions must not be shorter, and close.
TEST(Flight, PredictionsAgreeWithTimeRoute) {
  const FlightModel model(kLimits, {}, kFlat);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rng rng(seed);
    const double z1 = rng.uniform(10.0, 40.0);
    const double z2 = seed % 2 == 0 ? z1 : rng.uniform(10.0, 40.0);
    const auto place = [&](double z) {
      return Vec3(rng.uniform(-100.0, 100.0), rng.uniform(-100.0, 100.0), z);
    };
    const Vec3 a = place(z1);
    const Vec3 b = place(z1);
    const Vec3 c = place(z2);
    const Vec3 d = place(z2);
    const std::vector<planner::RoutePoint> route = {{a, planner::Phase::kTakeOff, 0, 0.0},
                                                    {b, planner::Phase::kCover, 0, 0.0},
                                                    {c, planner::Phase::kTransfer, 1, 0.0},
                                                    {d, planner::Phase::kCover, 1, 0.0},
                                                    {model.ground(d), planner::Phase::kLanding, 1, 0.0}};
    const planner::TimedPath path = planner::time_route(model.ground(a), 0.0, route, kLimits);
    const FlightCost predicted = model.take_off(a) + model.level(a, b) +
                                 model.transfer(b, c, {b - a, d - c}) + model.level(c, d) + model.landing(d);
    EXPECT_GE(predicted.time_s, path.back().time_s - 1e-6);
    // A slanted transfer is flown quicker than climb and level flight one after the other.
    EXPECT_LE(
        predicted.time_s,
        path.back().time_s + (z1 == z2 ? 1e-6 : 2.0 + std::abs(z1 - z2) / kLimits.climb_speed_mps + 2.0));
  }
}

TEST(Flight, TransfersClimbOverTheGroundBetweenTheirEnds) {
  planner::TerrainGrid grid;
  grid.cell_size_m = 10.0;
  grid.rows = 3;
  grid.cols = 21;
  grid.elevation_m.assign(63, 0.0F);
  for (const int r : {0, 1, 2}) grid.elevation_m[static_cast<std::size_t>(r * 21 + 10)] = 50.0F;
  const planner::Terrain ridge = planner::Terrain::from_grid(grid).value();
  const FlightModel model(kLimits, {}, ridge);
  const FlightCost over = model.transfer(Vec3(0, 10, 20), Vec3(200, 10, 20), {});
  EXPECT_GT(over.length_m, 200.0 + 2.0 * 30.0);
  const FlightCost beside = model.transfer(Vec3(0, 10, 20), Vec3(60, 10, 20), {});
  EXPECT_DOUBLE_EQ(beside.length_m, 60.0);
}

/// From one line's height to the next one's, where both end: up or down, and not first a metre higher.
TEST(Flight, ATransferStraightUpOrDownRisesAboveNeitherEnd) {
  planner::TerrainGrid grid;
  grid.rows = grid.cols = 2;
  grid.elevation_m = {17.0F, 17.0F, 17.0F, 17.0F};
  const planner::Terrain ground = planner::Terrain::from_grid(grid).value();
  const FlightModel model(kLimits, {}, ground);
  const double low_m = 17.0 + kLimits.clearance_m();
  const FlightCost down =
      model.transfer(Vec3(1, 1, low_m + 0.5), Vec3(1, 1, low_m), {Vec3(1, 0, 0), Vec3(0, 1, 0)});
  EXPECT_DOUBLE_EQ(down.length_m, 0.5);
  EXPECT_DOUBLE_EQ(down.time_s, 0.5 / kLimits.descent_speed_mps + 2.0 * planner::kStopToTurn_s);
}

}  // namespace
}  // namespace swallowtail::coverage
