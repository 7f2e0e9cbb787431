#include "planner/path/certifier.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace swallowtail::planner {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Obstacle sphere(std::uint32_t id, const Vec3& position, double radius_m) {
  Obstacle obstacle;
  obstacle.id = id;
  obstacle.shape = Sphere{radius_m};
  obstacle.position_m = position;
  return obstacle;
}

Certificate check(const TimedPath& path, std::vector<Obstacle> obstacles = {},
                  const Terrain& terrain = Terrain::flat(0.0), const VehicleLimits& limits = {},
                  const Bounds& bounds = {}) {
  auto world = World::make(terrain, std::move(obstacles), bounds);
  EXPECT_TRUE(world.ok());
  return certify(path, ClearanceQuery(*world), limits);
}

/// The kinds found, in time.
std::vector<ViolationKind> kinds(const Certificate& certificate) {
  std::vector<ViolationKind> found;
  for (const Violation& v : certificate.violations) found.push_back(v.kind);
  EXPECT_EQ(certificate.certified, found.empty());
  return found;
}
using Kinds = std::vector<ViolationKind>;

/// Level flight along x at 8 m/s, 20 m up.
TimedPath level(double length_m = 80.0, double z_m = 20.0) {
  return {{0, Vec3(0, 0, z_m)}, {length_m / 8.0, Vec3(length_m, 0, z_m)}};
}

TEST(Certifier, CertifiesACleanPath) {
  const Certificate c = check(level());
  EXPECT_TRUE(c.certified);
  EXPECT_DOUBLE_EQ(c.clearance_min_m, 20.0);
}

TEST(Certifier, MalformedPathsAreRefusedNotFollowed) {
  EXPECT_EQ(kinds(check({})), Kinds{ViolationKind::kMalformed});
  EXPECT_EQ(kinds(check({{0, Vec3(0, 0, 20)}, {-1, Vec3(1, 0, 20)}})), Kinds{ViolationKind::kMalformed});
  for (const double bad : {kNan, kInf, -kInf, 1e300}) {
    EXPECT_EQ(kinds(check({{bad, Vec3(0, 0, 20)}})), Kinds{ViolationKind::kMalformed}) << bad;
    for (int axis = 0; axis < 3; ++axis) {
      TimedPath path = level();
      path[1].position_m[axis] = bad;
      EXPECT_EQ(kinds(check(path)), Kinds{ViolationKind::kMalformed}) << bad;
    }
  }
  VehicleLimits limits;
  limits.cruise_speed_mps = kNan;
  EXPECT_EQ(kinds(check(level(), {}, Terrain::flat(0), limits)), Kinds{ViolationKind::kMalformed});
  EXPECT_EQ(check({}).clearance_min_m, 0.0);
}

TEST(Certifier, ViolationsAreBounded) {
  TimedPath path;
  for (int i = 0; i < 1000; ++i) path.push_back({static_cast<double>(i), Vec3(0, 0, kNan)});
  EXPECT_EQ(check(path).violations.size(), kMaxViolations);
  for (int i = 0; i < 1000; ++i) path[i].position_m = Vec3(100.0 * i, 0, 20);
  EXPECT_EQ(check(path).violations.size(), kMaxViolations);
}

TEST(Certifier, BoundsHoldAtEveryWaypoint) {
  const Bounds bounds{Vec3(-1, -1, 0), Vec3(50, 1, 50)};
  EXPECT_EQ(kinds(check(level(), {}, Terrain::flat(0), {}, bounds)), Kinds{ViolationKind::kBounds});
  EXPECT_TRUE(check(level(50), {}, Terrain::flat(0), {}, bounds).certified);
}

TEST(Certifier, ObstacleClearanceIsSharp) {
  const double required = VehicleLimits{}.clearance_m();
  EXPECT_TRUE(check(level(), {sphere(7, Vec3(40, 5 + required + 1e-4, 20), 5)}).certified);
  const Certificate refused = check(level(), {sphere(7, Vec3(40, 5 + required - 1e-4, 20), 5)});
  EXPECT_EQ(kinds(refused), Kinds{ViolationKind::kObstacle});
  EXPECT_EQ(refused.violations[0].obstacle_id, 7U);
  EXPECT_EQ(refused.violations[0].segment, 1U);
  EXPECT_NEAR(refused.violations[0].time_s, 5.0, 0.01);
  EXPECT_NEAR(refused.violations[0].where_m.x(), 40.0, 0.1);
  Obstacle wary = sphere(7, Vec3(40, 5 + required + 1.0, 20), 5);
  EXPECT_TRUE(check(level(), {wary}).certified);
  wary.margin_m = 1.001;
  EXPECT_FALSE(check(level(), {wary}).certified);
}

TEST(Certifier, AThinObstacleBetweenWaypointsIsSeen) {
  EXPECT_EQ(kinds(check(level(8000), {sphere(1, Vec3(4321.5, 0, 20), 0.01)})),
            Kinds{ViolationKind::kObstacle});
}

TEST(Certifier, MovingObstaclesAreMetInTime) {
  Obstacle crossing = sphere(2, Vec3(40, 50, 20), 1.0);
  crossing.velocity_mps = Vec3(0, -10, 0);
  EXPECT_EQ(kinds(check(level(), {crossing})), Kinds{ViolationKind::kObstacle});
  crossing.state_time_s = 5.0;  // now 50 m away when the aircraft passes
  EXPECT_TRUE(check(level(), {crossing}).certified);
  crossing.state_time_s = 0.0;
  crossing.valid_until_s = 4.0;
  EXPECT_TRUE(check(level(), {crossing}).certified);
}

TEST(Certifier, AStopAmongMovingObstaclesIsChecked) {
  Obstacle passing = sphere(2, Vec3(-100, 0, 20), 1.0);
  passing.velocity_mps = Vec3(10, 0, 0);
  EXPECT_EQ(kinds(check({{0, Vec3(0, 0, 20)}, {30, Vec3(0, 0, 20)}}, {passing})),
            Kinds{ViolationKind::kObstacle});
  EXPECT_TRUE(check({{0, Vec3(0, 0, 20)}, {5, Vec3(0, 0, 20)}}, {passing}).certified);
}

TEST(Certifier, FlatGroundNeedsTheClearanceExactly) {
  EXPECT_TRUE(check(level(80, 2.5)).certified);
  EXPECT_EQ(kinds(check(level(80, 2.4999))), Kinds{ViolationKind::kTerrain});
}

TEST(Certifier, SlopingGroundNeedsItAcrossTheSlope) {
  // A plane of slope 1 along x: clearance 2.5 means 2.5·√2 above ground.
  const auto slope = Terrain::from_grid({Vec2(-500, -500), 1000.0, 2, 2, {-500, 500, -500, 500}});
  ASSERT_TRUE(slope.ok());
  const auto along_y = [](double z) { return TimedPath{{0, Vec3(0, 0, z)}, {10, Vec3(0, 80, z)}}; };
  EXPECT_TRUE(check(along_y(2.5 * std::numbers::sqrt2 + 1e-3), {}, *slope).certified);
  EXPECT_EQ(kinds(check(along_y(2.5 * std::numbers::sqrt2 - 1e-3), {}, *slope)),
            Kinds{ViolationKind::kTerrain});
}

TEST(Certifier, APeakBesideThePathIsSeenAndALowRidgeIsNot) {
  TerrainGrid grid{Vec2::Zero(), 1.0, 41, 41, std::vector<float>(41 * 41, 0.0F)};
  grid.elevation_m[22 * 41 + 20] = 20.0F;
  const auto peak = *Terrain::from_grid(grid);
  const auto across = [](double y, double z) { return TimedPath{{0, Vec3(0, y, z)}, {10, Vec3(40, y, z)}}; };
  EXPECT_EQ(kinds(check(across(20, 20), {}, peak)), Kinds{ViolationKind::kTerrain});
  EXPECT_TRUE(check(across(20, 22.6), {}, peak).certified);
  EXPECT_TRUE(check(across(10, 3), {}, peak).certified);
}

TEST(Certifier, TakeOffAndLandingMayTouchTheGround) {
  const TimedPath path = {{0, Vec3(0, 0, 0), Phase::kTakeOff},    {10, Vec3(0, 0, 20), Phase::kTakeOff},
                          {11, Vec3(0, 0, 20), Phase::kTakeOff},  {21, Vec3(80, 0, 20), Phase::kTransfer},
                          {22, Vec3(80, 0, 20), Phase::kLanding}, {32, Vec3(80, 0, 0), Phase::kLanding}};
  const Certificate c = check(path);
  EXPECT_EQ(kinds(c), Kinds{});
  EXPECT_DOUBLE_EQ(c.clearance_min_m, 20.0);
  TimedPath buried = path;
  buried.back().position_m.z() = -0.04;
  EXPECT_TRUE(check(buried).certified);
  buried.back().position_m.z() = -0.06;
  EXPECT_EQ(kinds(check(buried)), Kinds{ViolationKind::kTerrain});
  TimedPath transfer = path;
  transfer.back().phase = Phase::kTransfer;
  EXPECT_EQ(kinds(check(transfer)), Kinds{ViolationKind::kTerrain});
  EXPECT_EQ(kinds(check(path, {sphere(3, Vec3(82, 0, 1), 1)})), Kinds{ViolationKind::kObstacle});
}

TEST(Certifier, ASinglePointIsJudgedToo) {
  EXPECT_TRUE(check({{0, Vec3(0, 0, 20)}}).certified);
  EXPECT_TRUE(check({{0, Vec3(0, 0, 0), Phase::kLanding}}).certified);
  EXPECT_EQ(kinds(check({{0, Vec3(0, 0, 1)}})), Kinds{ViolationKind::kTerrain});
  EXPECT_EQ(kinds(check({{0, Vec3(0, 0, 20)}}, {sphere(1, Vec3(0, 0, 20), 1)})),
            Kinds{ViolationKind::kObstacle});
}

TEST(Certifier, SpeedsHaveARelativeTolerance) {
  const auto flown = [](const Vec3& move, double seconds) {
    return kinds(check({{0, Vec3(0, 0, 50)}, {seconds, Vec3(0, 0, 50) + move}}));
  };
  EXPECT_EQ(flown(Vec3(80, 0, 0), 10 * (1 - 5e-7)), Kinds{});
  EXPECT_EQ(flown(Vec3(80, 0, 0), 10 * (1 - 2e-6)), Kinds{ViolationKind::kSpeed});
  EXPECT_EQ(flown(Vec3(0, 0, 30), 10), Kinds{});
  EXPECT_EQ(flown(Vec3(0, 0, 30), 9.9), Kinds{ViolationKind::kSpeed});
  EXPECT_EQ(flown(Vec3(0, 0, -30), 9.9), Kinds{ViolationKind::kSpeed});
  EXPECT_EQ(flown(Vec3(60, 0, 40), 11), Kinds{ViolationKind::kSpeed});
  EXPECT_EQ(flown(Vec3(1, 0, 0), 0), Kinds{ViolationKind::kSpeed});
  EXPECT_EQ(flown(Vec3(0, 0, 0), 0), Kinds{});
}

TEST(Certifier, ClimbAngleHoldsUnlessVertical) {
  EXPECT_EQ(kinds(check({{0, Vec3(0, 0, 50)}, {30, Vec3(20, 0, 70)}})), Kinds{});
  EXPECT_EQ(kinds(check({{0, Vec3(0, 0, 50)}, {30, Vec3(20, 0, 71)}})), Kinds{ViolationKind::kClimb});
  EXPECT_EQ(kinds(check({{0, Vec3(0, 0, 50)}, {30, Vec3(20, 0, 29)}})), Kinds{ViolationKind::kClimb});
  EXPECT_EQ(kinds(check({{0, Vec3(0, 0, 50)}, {30, Vec3(0, 0, 71)}})), Kinds{});
}

/// Two level segments that meet at `turn_rad`, with a stop between.
TimedPath corner(double turn_rad, double stop_s) {
  const Vec3 bend(80, 0, 20);
  TimedPath path = {{0, Vec3(0, 0, 20)}, {10, bend}};
  if (stop_s > 0.0) path.push_back({10 + stop_s, bend});
  path.push_back({20 + stop_s, bend + 80 * Vec3(std::cos(turn_rad), std::sin(turn_rad), 0)});
  return path;
}

TEST(Certifier, TurnsNeedAStopBeyondTheLimit) {
  EXPECT_TRUE(check(corner(std::numbers::pi / 3.0, 0)).certified);
  EXPECT_EQ(kinds(check(corner(std::numbers::pi / 3.0 + 1e-4, 0))), Kinds{ViolationKind::kTurn});
  EXPECT_EQ(kinds(check(corner(-2.0, 0.9))), Kinds{ViolationKind::kTurn});
  EXPECT_TRUE(check(corner(std::numbers::pi, kStopToTurn_s)).certified);
}

TEST(Certifier, AStopInPiecesAddsUp) {
  TimedPath path = corner(2.0, 1.2);
  path.insert(path.begin() + 2, {10.5, path[1].position_m});
  EXPECT_TRUE(check(path).certified);
}

TEST(Certifier, VerticalToLevelCountsAsARightAngle) {
  const TimedPath lift = {{0, Vec3(0, 0, 10)}, {10, Vec3(0, 0, 30)}, {40, Vec3(100, 0, 70)}};
  EXPECT_EQ(kinds(check(lift)), Kinds{ViolationKind::kTurn});
  VehicleLimits nimble;
  nimble.turn_max_rad = 1.5;  // more than the 68° between the two, less than 90°
  EXPECT_EQ(kinds(check(lift, {}, Terrain::flat(0), nimble)), Kinds{ViolationKind::kTurn});
  EXPECT_TRUE(check({{0, Vec3(0, 0, 10)}, {10, Vec3(0, 0, 30)}, {20, Vec3(0, 0, 50)}}).certified);
  EXPECT_EQ(kinds(check({{0, Vec3(0, 0, 10)}, {10, Vec3(0, 0, 30)}, {20, Vec3(0, 0, 10)}})),
            Kinds{ViolationKind::kTurn});
}

TEST(Certifier, KindsHaveNames) {
  EXPECT_STREQ(name(ViolationKind::kObstacle), "obstacle");
  EXPECT_STREQ(name(ViolationKind::kMalformed), "malformed");
}

}  // namespace
}  // namespace swallowtail::planner
