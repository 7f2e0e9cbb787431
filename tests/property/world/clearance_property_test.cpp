#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "planner/world/clearance.hpp"
#include "planner/world/detail/narrow_phase.hpp"
#include "tests/support/oracle.hpp"
#include "tests/support/scenes.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kQuality = 1e-6;  ///< the header's promise, relative to 1 + distance

TEST(ClearanceProperty, AgreesWithDenseSamplesInSpaceAndTime) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(seed);
    const Vec3 lo(-30.0, -30.0, -10.0);
    const Vec3 hi(30.0, 30.0, 40.0);
    std::vector<Obstacle> obstacles;
    const auto count = static_cast<std::uint32_t>(1 + rng.below(6));
    for (std::uint32_t id = 1; id <= count; ++id)
      obstacles.push_back(test::random_obstacle(rng, id, lo, hi, 20.0));
    const auto world = *World::make(Terrain::flat(0.0), obstacles, Bounds{});
    const ClearanceQuery query(world);
    const Vec3 a = test::random_point(rng, lo, hi);
    const Vec3 b = rng.below(8) == 0 ? a : test::random_point(rng, lo, hi);
    const double t0 = rng.uniform(0.0, 20.0);
    const double t1 = t0 + rng.uniform(0.0, 15.0);
    constexpr int kSamples = 300;
    double distance = std::numeric_limits<double>::infinity();
    double slack = std::numeric_limits<double>::infinity();
    for (const Obstacle& o : obstacles) {
      if (o.valid_until_s < t0) continue;
      const double until =
          std::min(1.0, (o.valid_until_s - t0) / (t1 - t0));  // the instant it ends is sampled too
      for (int i = 0; i <= kSamples; ++i) {
        const double s = until * i / kSamples;
        const double t = t0 + (t1 - t0) * s;
        const double d = test::point_distance_m(
            o.shape, a + (b - a) * s - (o.position_m + o.velocity_mps * (t - o.state_time_s)));
        distance = std::min(distance, d);
        slack = std::min(slack, d - o.margin_m);
      }
    }
    const Clearance answer = query.of_flight(a, t0, b, t1, 1e4);
    if (distance == std::numeric_limits<double>::infinity()) {
      ASSERT_EQ(answer.distance_m, distance);
      continue;
    }
    const double missed = 0.5 * ((b - a).norm() + 6.0 * (t1 - t0)) / kSamples + kQuality * (1.0 + distance);
    ASSERT_LE(answer.distance_m, distance + 1e-9);
    ASSERT_GE(answer.distance_m, distance - missed);
    ASSERT_LE(answer.slack_m, slack + 1e-9);
    ASSERT_GE(answer.slack_m, slack - missed);
    ASSERT_GE(answer.time_s, t0);
    ASSERT_LE(answer.time_s, t1);
    // The time and obstacle named are where the slack is.
    const Obstacle& named = obstacles.at(answer.obstacle_id - 1);
    const double share = t1 > t0 ? (answer.time_s - t0) / (t1 - t0) : 0.0;
    const double there =
        test::point_distance_m(named.shape, a + (b - a) * share - named.position_at(answer.time_s)) -
        named.margin_m;
    if (answer.distance_m > 0.0 && t1 > t0) {
      ASSERT_NEAR(there, answer.slack_m, 1e-3);
    }
  }
}

// Two routes to the distance that have only the supporting plane in common: GJK's direction and bisection's.
TEST(ClearanceProperty, GjkAndBisectionProveTheSameDistance) {
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(seed);
    const detail::NarrowShape shape(test::random_shape(rng, rng.uniform(0.2, 60.0)));
    const double reach = std::pow(10.0, rng.uniform(0.0, 3.5));
    Vec3 p = test::random_point(rng, Vec3::Constant(-reach), Vec3::Constant(reach));
    Vec3 q = test::random_point(rng, Vec3::Constant(-reach), Vec3::Constant(reach));
    if (rng.below(4) == 0) q.z() = p.z();
    if (rng.below(4) == 0) q.x() = p.x();
    const double bisected = shape.by_bisection(p, q).distance_m;
    const double answer = shape.to_segment(p, q).distance_m;
    ASSERT_NEAR(answer, bisected, kQuality * (1.0 + bisected));
    ASSERT_LE(shape.by_gjk(p, q).distance_m, bisected + kQuality * (1.0 + bisected));
  }
}

TEST(ClearanceProperty, ThousandObstaclesGiveWhatOneByOneGives) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(seed);
    const Vec3 lo(-500.0, -500.0, 0.0);
    const Vec3 hi(500.0, 500.0, 60.0);
    std::vector<Obstacle> obstacles;
    for (std::uint32_t id = 1; id <= 1000; ++id)
      obstacles.push_back(test::random_obstacle(rng, id, lo, hi, 15.0));
    const ClearanceQuery query(*World::make(Terrain::flat(0.0), obstacles, Bounds{}));
    for (int i = 0; i < 20; ++i) {
      const Vec3 a = test::random_point(rng, lo, hi);
      const Vec3 b = a + 0.1 * test::random_point(rng, lo, hi);
      const double reach = rng.uniform(1.0, 60.0);
      Clearance least;
      for (const Obstacle& o : obstacles) {
        if (o.valid_until_s < 5.0) continue;
        const double until = std::min(9.0, o.valid_until_s);
        const Vec3 end = a + (b - a) * ((until - 5.0) / 4.0);
        const double d = detail::NarrowShape(o.shape)
                             .to_segment(a - o.position_at(5.0), end - o.position_at(until))
                             .distance_m;
        least.distance_m = std::min(least.distance_m, d);
        least.slack_m = std::min(least.slack_m, d - o.margin_m);
      }
      const Clearance answer = query.of_flight(a, 5.0, b, 9.0, reach);
      if (least.distance_m < reach) {
        EXPECT_NEAR(answer.distance_m, least.distance_m, 1e-6);
      }
      if (least.slack_m < reach) {
        EXPECT_NEAR(answer.slack_m, least.slack_m, 1e-6);
      }
      EXPECT_GE(answer.distance_m, least.distance_m - 1e-6);
      EXPECT_GE(answer.slack_m, least.slack_m - 1e-6);
    }
  }
}

}  // namespace
}  // namespace swallowtail::planner
