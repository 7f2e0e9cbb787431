#include "planner/world/clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>
#include <vector>

#include "planner/base/rng.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Obstacle at(std::uint32_t id, Shape shape, const Vec3& position) {
  Obstacle obstacle;
  obstacle.id = id;
  obstacle.shape = std::move(shape);
  obstacle.position_m = position;
  return obstacle;
}

ClearanceQuery query(std::vector<Obstacle> obstacles) {
  auto world = World::make(Terrain::flat(0.0), std::move(obstacles), Bounds{});
  EXPECT_TRUE(world.ok());
  return ClearanceQuery(*world);
}

double distance(Shape shape, const Vec3& a, const Vec3& b) {
  return query({at(1, std::move(shape), Vec3::Zero())}).of_flight(a, 0, b, 1).distance_m;
}

TEST(Clearance, KnownDistances) {
  EXPECT_NEAR(distance(Sphere{2.0}, Vec3(-10, 5, 0), Vec3(10, 5, 0)), 3.0, 1e-6);
  EXPECT_NEAR(distance(Sphere{2.0}, Vec3(10, 5, 0), Vec3(20, 5, 0)), std::hypot(10, 5) - 2.0, 1e-6);
  EXPECT_NEAR(distance(Cylinder{2.0, 10.0}, Vec3(-9, 0, 12), Vec3(9, 0, 12)), 2.0, 1e-6);
  EXPECT_NEAR(distance(Cylinder{2.0, 10.0}, Vec3(6, -9, 5), Vec3(6, 9, 5)), 4.0, 1e-6);
  EXPECT_NEAR(distance(Cylinder{2.0, 10.0}, Vec3(5, 0, -4), Vec3(5, 0, -8)), 5.0, 1e-6);
  EXPECT_NEAR(distance(Cone{3.0, 4.0}, Vec3(-9, 0, 6), Vec3(9, 0, 6)), 2.0, 1e-6);
  EXPECT_NEAR(distance(Cone{3.0, 4.0}, Vec3(3, -9, 4), Vec3(3, 9, 4)), 12.0 / 5.0, 1e-6);
  EXPECT_NEAR(distance(Box{Vec3(2, 2, 2), std::numbers::pi / 4.0}, Vec3(5, -9, 0), Vec3(5, 9, 0)),
              5.0 - std::numbers::sqrt2, 1e-6);
  const ConvexMesh octahedron{
      {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}, 0.0};
  EXPECT_NEAR(distance(octahedron, Vec3(1, 1, 1), Vec3(1, 1, 1)), 2.0 / std::numbers::sqrt3, 1e-6);
}

TEST(Clearance, ThroughAndInsideIsZero) {
  for (const Shape& shape :
       {Shape(Sphere{2.0}), Shape(Cylinder{2.0, 4.0}), Shape(Cone{2.0, 4.0}), Shape(Box{Vec3(4, 4, 4), 0.3}),
        Shape(ConvexMesh{{Vec3(2, 0, -1), Vec3(-2, 2, -1), Vec3(-2, -2, -1), Vec3(0, 0, 3)}, 0.2})}) {
    EXPECT_EQ(distance(shape, Vec3(-10, 0.1, 0.5), Vec3(10, 0.1, 0.5)), 0.0);
    EXPECT_EQ(distance(shape, Vec3(0.1, 0.1, 0.5), Vec3(0.1, 0.1, 0.5)), 0.0);
  }
}

TEST(Clearance, SlackNamesTheObstacleWhoseMarginBites) {
  Obstacle wary = at(2, Sphere{1.0}, Vec3(0, 10, 0));
  wary.margin_m = 8.0;
  const Clearance c =
      query({at(1, Sphere{1.0}, Vec3(0, -4, 0)), wary}).of_flight(Vec3(-20, 0, 0), 10, Vec3(20, 0, 0), 14);
  EXPECT_NEAR(c.distance_m, 3.0, 1e-6);
  EXPECT_NEAR(c.slack_m, 1.0, 1e-6);
  EXPECT_EQ(c.obstacle_id, 2U);
  EXPECT_NEAR(c.time_s, 12.0, 1e-3);
}

TEST(Clearance, ATouchedObstacleDoesNotHideALargerMargin) {
  Obstacle wary = at(2, Sphere{1.0}, Vec3(0, 5, 0));
  wary.margin_m = 30.0;
  const Clearance c =
      query({at(1, Sphere{1.0}, Vec3::Zero()), wary}).of_flight(Vec3(-9, 0, 0), 0, Vec3(9, 0, 0), 1);
  EXPECT_EQ(c.distance_m, 0.0);
  EXPECT_NEAR(c.slack_m, 4.0 - 30.0, 1e-6);
  EXPECT_EQ(c.obstacle_id, 2U);
}

TEST(Clearance, ReliefHidesNeitherDistanceNorSlackOfOthers) {
  Rng rng(5);
  for (int round = 0; round < 200; ++round) {
    std::vector<Obstacle> solids;
    for (std::uint32_t i = 0; i < 30; ++i) {
      solids.push_back(at(i + 1, Sphere{rng.uniform(0.1, 3.0)},
                          Vec3(rng.uniform(-30, 30), rng.uniform(-30, 30), rng.uniform(-5, 5))));
      solids.back().margin_m = rng.below(2) == 0 ? rng.uniform(0.0, 10.0) : 0.0;
      solids.back().relief_m = rng.below(2) == 0 ? rng.uniform(0.0, 10.0) : 0.0;
    }
    const Vec3 a(rng.uniform(-30, 30), rng.uniform(-30, 30), 0);
    const Vec3 b(rng.uniform(-30, 30), rng.uniform(-30, 30), 0);
    const Clearance found = query(solids).of_flight(a, 0, b, 1, 1000);
    double distance_m = kInf;
    double slack_m = kInf;
    for (const Obstacle& solid : solids) {
      const double share = std::clamp((solid.position_m - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      const double away = std::max(
          0.0, (a + share * (b - a) - solid.position_m).norm() - std::get<Sphere>(solid.shape).radius_m);
      distance_m = std::min(distance_m, away);
      slack_m = std::min(slack_m, away - solid.margin_m + solid.relief_m);
    }
    EXPECT_NEAR(found.distance_m, distance_m, 1e-4) << "round " << round;
    EXPECT_NEAR(found.slack_m, slack_m, 1e-4) << "round " << round;
  }
}

TEST(Clearance, OutOfReachIsInfinitelyFar) {
  const auto q = query({at(9, Sphere{1.0}, Vec3(100, 0, 0)), at(10, Sphere{1.0}, Vec3(200, 0, 0))});
  EXPECT_NEAR(q.of_flight(Vec3::Zero(), 0, Vec3(0, 1, 0), 1, 500).distance_m, 99.0, 1e-4);
  const auto moving_only = [] {
    Obstacle o = at(1, Sphere{1.0}, Vec3(1000, 0, 0));
    o.velocity_mps = Vec3(1, 0, 0);
    return query({o});
  }();
  const Clearance c = moving_only.of_flight(Vec3::Zero(), 0, Vec3(0, 1, 0), 1);
  EXPECT_EQ(c.distance_m, kInf);
  EXPECT_EQ(c.obstacle_id, 0U);
}

TEST(Clearance, MovingObstacleIsMetInItsOwnFrame) {
  Obstacle mover = at(3, Sphere{1.0}, Vec3(0, 20, 0));
  mover.velocity_mps = Vec3(0, -2, 0);
  mover.state_time_s = 0.0;
  const auto q = query({mover});
  // They meet at the origin at t = 10.
  EXPECT_EQ(q.of_flight(Vec3(-20, 0, 0), 0, Vec3(20, 0, 0), 20).distance_m, 0.0);
  // A minute later it is long past.
  EXPECT_GT(q.of_flight(Vec3(-20, 0, 0), 60, Vec3(20, 0, 0), 80).distance_m, 40.0);
  // The closest approach of two straight motions: relative speed (2, 2), offset (−20, −20) + 5 s of lead.
  const Clearance c = q.of_flight(Vec3(-20, 0, 0), -5, Vec3(20, 0, 0), 15);
  EXPECT_NEAR(c.distance_m, 10.0 / std::numbers::sqrt2 - 1.0, 1e-5);
}

TEST(Clearance, ValidityIsClippedWithinTheInterval) {
  Obstacle brief = at(4, Sphere{1.0}, Vec3(10, 0, 0));
  brief.valid_until_s = 5.0;
  const auto q = query({brief});
  EXPECT_NEAR(q.of_flight(Vec3(0, 0, 0), 0, Vec3(10, 0, 0), 10).distance_m, 4.0, 1e-5);
  EXPECT_EQ(q.of_flight(Vec3(0, 0, 0), 5.001, Vec3(10, 0, 0), 10).distance_m, kInf);
  EXPECT_NEAR(q.of_flight(Vec3(8, 0, 0), 5.0, Vec3(8, 0, 0), 5.0).distance_m, 1.0, 1e-5);
}

TEST(Clearance, NotANumberIsNeverClear) {
  const auto q = query({at(1, Sphere{1.0}, Vec3(500, 0, 0))});
  for (const Clearance& c :
       {q.of_flight(Vec3(kNan, 0, 0), 0, Vec3::Zero(), 1), q.of_flight(Vec3::Zero(), kNan, Vec3::Zero(), 1),
        q.of_flight(Vec3::Zero(), 0, Vec3(0, kInf, 0), 1)}) {
    EXPECT_EQ(c.distance_m, 0.0);
    EXPECT_EQ(c.slack_m, -kInf);
  }
}

TEST(Clearance, NeverMoreThanTrueFarFromTheOrigin) {
  const Vec3 far(6e5, -8e5, 3000.0);
  const double gap = 2.5;
  const auto q = query({at(1, Cylinder{7.0, 30.0}, far)});
  const double d =
      q.of_flight(far + Vec3(-400, 7.0 + gap, 12), 0, far + Vec3(400, 7.0 + gap, 12), 100).distance_m;
  EXPECT_LE(d, gap + 1e-9);
  EXPECT_NEAR(d, gap, 1e-5);
}

TEST(Clearance, OneQueryPerThreadOverOneWorld) {
  std::vector<Obstacle> obstacles;
  for (std::uint32_t i = 0; i < 40; ++i) obstacles.push_back(at(i + 1, Cone{3.0, 9.0}, Vec3(20.0 * i, 0, 0)));
  const auto world = *World::make(Terrain::flat(0), obstacles, Bounds{});
  const auto sum = [&] {
    const ClearanceQuery q(world);
    double total = 0.0;
    for (int i = 0; i < 200; ++i)
      total += q.of_flight(Vec3(4.0 * i, -20, 5), 0, Vec3(4.0 * i, -8, 7), 1).distance_m;
    return total;
  };
  const double expected = sum();
  std::vector<double> totals(4);
  std::vector<std::thread> threads;
  for (double& total : totals) threads.emplace_back([&] { total = sum(); });
  for (auto& thread : threads) thread.join();
  for (const double total : totals) EXPECT_EQ(total, expected);
}

}  // namespace
}  // namespace swallowtail::planner
