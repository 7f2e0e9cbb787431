#include <gtest/gtest.h>

#include <numbers>

#include "planner/path/certifier.hpp"
#include "tests/support/oracle.hpp"
#include "tests/support/scenes.hpp"

namespace swallowtail::planner {
namespace {

VehicleLimits random_limits(Rng& rng) {
  VehicleLimits limits;
  limits.cruise_speed_mps = rng.uniform(0.5, 25.0);
  limits.climb_speed_mps = rng.uniform(0.2, 8.0);
  limits.descent_speed_mps = rng.uniform(0.2, 8.0);
  limits.turn_max_rad = rng.uniform(0.0, std::numbers::pi);
  limits.climb_max_rad = rng.uniform(0.0, std::numbers::pi / 2.0);
  if (rng.below(10) == 0) limits.climb_max_rad = 0.0;
  if (rng.below(10) == 0) limits.turn_max_rad = 0.0;
  return limits;
}

TEST(TimeRouteProperty, AnyRouteKeepsTheKinematicRules) {
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(seed);
    const VehicleLimits limits = random_limits(rng);
    const Vec3 half = Vec3::Constant(rng.below(2) == 0 ? 1e-3 : 2000.0);
    const auto route = test::random_route(rng, 1 + rng.below(20), -half, half);
    const double start_s = rng.below(2) == 0 ? 0.0 : rng.uniform(-1e6, 1e6);
    const TimedPath path = time_route(test::random_point(rng, -half, half), start_s, route, limits);
    const ClearanceQuery query(
        *World::make(Terrain::flat(-9000.0), {}, Bounds{Vec3::Constant(-1e5), Vec3::Constant(1e5)}));
    const Certificate certificate = certify(path, query, limits);
    ASSERT_TRUE(certificate.certified)
        << name(certificate.violations.front().kind) << " " << certificate.violations.front().detail << "\n"
        << test::as_code(path);
    const test::Opinion opinion = test::inspect(path, query.world(), limits, {1e4, 1.0});
    ASSERT_LE(opinion.speed_excess, 2e-6) << test::as_code(path);
    ASSERT_LE(opinion.climb_excess_rad, 1e-5) << test::as_code(path);
    ASSERT_LE(opinion.turn_excess_rad, 1e-5) << test::as_code(path);
    // Every route point is there, in order, and stood at for as long as asked.
    std::size_t at = 0;
    for (const RoutePoint& point : route) {
      while (at < path.size() && path[at].position_m != point.position_m) ++at;
      ASSERT_LT(at, path.size());
      std::size_t last = at;
      while (last + 1 < path.size() && path[last + 1].position_m == point.position_m) ++last;
      ASSERT_GE(path[last].time_s - path[at].time_s, point.dwell_s * (1.0 - 1e-6) - 1e-9);
    }
  }
}

}  // namespace
}  // namespace swallowtail::planner
