#include "planner/path/certifier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/support/oracle.hpp"
#include "tests/support/scenes.hpp"

namespace swallowtail::planner {
namespace {

struct Scene {
  std::shared_ptr<const World> world;
  TimedPath path;
  VehicleLimits limits;
};

/// A timed route through obstacles above flat or rough ground; one in three gets a waypoint or a time pushed
/// about afterwards.
Scene random_scene(Rng& rng) {
  Scene scene;
  scene.limits.radius_m = rng.uniform(0.2, 1.0);
  scene.limits.margin_m = rng.uniform(0.0, 2.0);
  const Vec3 lo(0.0, 0.0, 6.0);
  const Vec3 hi(80.0, 80.0, 40.0);
  std::vector<Obstacle> obstacles;
  const auto count = static_cast<std::uint32_t>(rng.below(7));
  for (std::uint32_t id = 1; id <= count; ++id)
    obstacles.push_back(test::random_obstacle(rng, id, Vec3(0.0, 0.0, 0.0), hi, 20.0));
  Terrain terrain = rng.below(2) == 0
                        ? Terrain::flat(rng.uniform(-5.0, 8.0))
                        : test::random_terrain(rng, Vec2(5.0, 5.0), 16, 16, 5.0, rng.uniform(1.0, 20.0));
  const Vec3 start = test::random_point(rng, lo, hi);
  scene.path = time_route(start, rng.uniform(0.0, 10.0), test::random_route(rng, 1 + rng.below(5), lo, hi),
                          scene.limits);
  const Bounds bounds{Vec3(-1.0, -1.0, -20.0), Vec3(81.0, 81.0, rng.below(6) == 0 ? 36.0 : 60.0)};
  scene.world = *World::make(std::move(terrain), std::move(obstacles), bounds);
  if (rng.below(3) == 0) {
    const std::size_t i = rng.below(scene.path.size());
    if (rng.below(2) == 0)
      scene.path[i].position_m += test::random_point(rng, Vec3::Constant(-2.0), Vec3::Constant(2.0));
    const double later_s = rng.uniform(0.0, 2.0);
    // All that comes before waypoint i happens later: its segment is flown faster, or its stop is cut short.
    const double room_s = i == 0 ? 0.0 : std::min(later_s, scene.path[i].time_s - scene.path[i - 1].time_s);
    for (std::size_t j = 0; j < i; ++j) scene.path[j].time_s += room_s;
  }
  return scene;
}

bool has(const Certificate& certificate, ViolationKind kind) {
  return std::any_of(certificate.violations.begin(), certificate.violations.end(),
                     [&](const Violation& v) { return v.kind == kind; });
}

TEST(CertifierProperty, NeverCertifiesWhatTheOracleFindsBroken) {
  int certified = 0;
  int refused = 0;
  constexpr int kScenes = 3000;
  for (std::uint64_t seed = 0; seed < kScenes; ++seed) {
    Rng rng(seed);
    const Scene scene = random_scene(rng);
    SCOPED_TRACE(testing::Message() << "seed " << seed << "\n" << test::as_code(scene.path));
    const ClearanceQuery query(scene.world);
    const Certificate certificate = certify(scene.path, query, scene.limits);
    const test::Opinion opinion = test::inspect(scene.path, *scene.world, scene.limits, {0.25, 0.5});
    (certificate.certified ? certified : refused) += 1;
    ASSERT_EQ(certificate.certified, certificate.violations.empty());
    // What the oracle finds broken is refused, rule by rule. Its samples are points of the path: nothing is
    // borderline but rounding and the limits' tolerance.
    const bool complete = certificate.violations.size() < kMaxViolations;
    ASSERT_TRUE(complete);
    if (opinion.bounds_excess_m > 0.0) {
      ASSERT_TRUE(has(certificate, ViolationKind::kBounds));
    }
    if (opinion.obstacle_excess_m > 1e-9) {
      ASSERT_TRUE(has(certificate, ViolationKind::kObstacle));
    }
    if (opinion.terrain_excess_m > 1e-6 || opinion.below_ground_m > 0.0501) {
      ASSERT_TRUE(has(certificate, ViolationKind::kTerrain));
    }
    if (opinion.turn_excess_rad > 1e-5) {
      ASSERT_TRUE(has(certificate, ViolationKind::kTurn));
    }
    if (opinion.climb_excess_rad > 1e-5) {
      ASSERT_TRUE(has(certificate, ViolationKind::kClimb));
    }
    if (opinion.speed_excess > 1e-5) {
      ASSERT_TRUE(has(certificate, ViolationKind::kSpeed));
    }
    // And nothing is refused that the oracle finds kept by more than it may have missed.
    if (opinion.bounds_excess_m < 0.0) {
      ASSERT_FALSE(has(certificate, ViolationKind::kBounds));
    }
    if (opinion.obstacle_excess_m < -opinion.obstacle_resolution_m - 1e-3) {
      ASSERT_FALSE(has(certificate, ViolationKind::kObstacle));
    }
    if (opinion.turn_excess_rad < -1e-5) {
      ASSERT_FALSE(has(certificate, ViolationKind::kTurn));
    }
    if (opinion.climb_excess_rad < -1e-5) {
      ASSERT_FALSE(has(certificate, ViolationKind::kClimb));
    }
    if (opinion.speed_excess < -1e-5) {
      ASSERT_FALSE(has(certificate, ViolationKind::kSpeed));
    }
    const double slope = scene.world->terrain().max_slope();
    const double resolution = 0.125 * (1.0 + slope);
    if (opinion.terrain_height_m > scene.limits.clearance_m() * std::sqrt(1.0 + slope * slope) + resolution &&
        opinion.below_ground_m < 0.049) {
      ASSERT_FALSE(has(certificate, ViolationKind::kTerrain));
    }
    // The clearance it names is the least of the two, where obstacles are near enough to count.
    if (certificate.clearance_min_m < 40.0 && scene.world->obstacles().empty()) {
      ASSERT_LE(certificate.clearance_min_m, opinion.terrain_height_m + 1e-9);
      ASSERT_GE(certificate.clearance_min_m, opinion.terrain_height_m - resolution);
    }
  }
  std::cout << certified << " certified, " << refused << " refused\n";
  // A test in which everything is refused, or nothing, says little.
  EXPECT_GT(certified, kScenes / 10);
  EXPECT_GT(refused, kScenes / 10);
}

}  // namespace
}  // namespace swallowtail::planner
