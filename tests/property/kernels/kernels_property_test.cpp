#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "planner/kernels/batch_field.hpp"
#include "planner/world/clearance.hpp"
#include "planner/world/detail/narrow_phase.hpp"
#include "tests/property/kernels/segment_oracle.hpp"
#include "tests/support/scenes.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kExact = 1e-9;  ///< of the scene's size

/// One obstacle of a size anywhere from millimetres to kilometres, thin ones among them, and hops around it.
struct Scene {
  Obstacle obstacle;
  double size_m = 0.0;
  LanePoint a, b;
  Vec3 from(int lane) const { return {a.x[lane], a.y[lane], a.z[lane]}; }
  Vec3 to(int lane) const { return {b.x[lane], b.y[lane], b.z[lane]}; }
};

Shape any_shape(Rng& rng, double size_m) {
  const auto part = [&] { return size_m * (rng.below(4) == 0 ? 0.001 : rng.uniform(0.05, 1.0)); };
  switch (rng.below(4)) {
    case 0:
      return Sphere{part()};
    case 1:
      return Cylinder{part(), part()};
    case 2:
      return Cone{part(), part()};
    default:
      return Box{Vec3(part(), part(), part()), rng.uniform(-4.0, 4.0)};
  }
}

/// Anywhere around, level, upright, through the middle or along the axis, going nowhere.
Scene any_scene(std::uint64_t seed) {
  Rng rng(seed);
  Scene scene;
  scene.size_m = std::pow(10.0, rng.uniform(-2.0, 3.5));
  scene.obstacle = {.id = 1, .shape = any_shape(rng, scene.size_m)};
  scene.obstacle.position_m =
      test::random_point(rng, Vec3::Constant(-scene.size_m), Vec3::Constant(scene.size_m));
  const Vec3 reach = Vec3::Constant(scene.size_m * (rng.below(3) == 0 ? 10.0 : 1.5));
  for (int lane = 0; lane < kLanes; ++lane) {
    Vec3 a = test::random_point(rng, -reach, reach);
    Vec3 b = test::random_point(rng, -reach, reach);
    switch (rng.below(8)) {
      case 0:
        b.z() = a.z();
        break;
      case 1:
        b.head<2>() = a.head<2>();
        break;
      case 2:
        b = -a * rng.uniform(0.1, 1.0);
        break;
      case 3:
        a.head<2>().setZero();
        b.head<2>().setZero();
        break;
      case 4:
        b = a;
        break;
      default:
        break;
    }
    a += scene.obstacle.position_m;
    b += scene.obstacle.position_m;
    for (auto [point, v] : {std::pair{&scene.a, &a}, std::pair{&scene.b, &b}}) {
      point->x[lane] = v->x();
      point->y[lane] = v->y();
      point->z[lane] = v->z();
    }
  }
  return scene;
}

struct Fields {
  explicit Fields(const Obstacle& obstacle)
      : world(*World::make(Terrain::flat(-1e5), {obstacle}, Bounds{})),
        field(world, VehicleLimits{}),
        batch(field) {}
  std::shared_ptr<const World> world;
  ObstacleField field;
  BatchField batch;
};

TEST(KernelsProperty, DistancesAreTheOracles) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    const Scene scene = any_scene(seed);
    const Fields fields(scene.obstacle);
    std::vector<LaneDistance> buffer;
    const auto near = fields.batch.distances(scene.a, scene.b, 1e6, buffer);
    RC_ASSERT(near.size() == 1U);
    Lanes violation_m = Lanes::Zero();
    fields.batch.add_violation(scene.a, scene.b, violation_m);
    for (int lane = 0; lane < kLanes; ++lane) {
      const Vec3 p = scene.from(lane) - scene.obstacle.position_m;
      const Vec3 q = scene.to(lane) - scene.obstacle.position_m;
      const double expected = test::signed_segment_distance_m(scene.obstacle.shape, p, q);
      const double tolerance = kExact * (scene.size_m + p.norm() + q.norm());
      RC_ASSERT(std::abs(near[0].signed_distance_m[lane] - expected) <= tolerance);
      const double required = fields.field.required_m(0);
      RC_ASSERT(std::abs(violation_m[lane] - std::max(0.0, required - expected)) <= tolerance);
      const Approach approach = fields.field.approach(0, scene.from(lane), 0.0, scene.to(lane), 1.0);
      RC_ASSERT(std::abs(approach.signed_distance_m - expected) <= tolerance);
      const Vec3 at = p + (q - p) * approach.fraction;
      RC_ASSERT(std::abs(test::signed_point_distance_m(scene.obstacle.shape, at) - expected) <= tolerance);
      RC_ASSERT(std::abs(approach.normal.norm() - 1.0) <= 1e-12);
    }
  }));
}

/// Going along it by the distance ends on the surface.
TEST(KernelsProperty, NormalsPointToTheNearestSurface) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    const Scene scene = any_scene(seed);
    const Fields fields(scene.obstacle);
    for (int lane = 0; lane < kLanes; ++lane) {
      const Approach approach = fields.field.approach(0, scene.from(lane), 0.0, scene.to(lane), 1.0);
      const Vec3 at = scene.from(lane) + (scene.to(lane) - scene.from(lane)) * approach.fraction -
                      scene.obstacle.position_m;
      const double here = test::signed_point_distance_m(scene.obstacle.shape, at);
      const double there = test::signed_point_distance_m(scene.obstacle.shape, at - here * approach.normal);
      RC_ASSERT(std::abs(there) <= kExact * (scene.size_m + scene.from(lane).norm()));
    }
  }));
}

/// FCL knows no depth; outside it is right to its own tolerance.
TEST(KernelsProperty, DistancesAreThoseOfFcl) {
  EXPECT_TRUE(rc::check([](std::uint64_t seed) {
    const Scene scene = any_scene(seed);
    const Fields fields(scene.obstacle);
    const detail::NarrowShape fcl(scene.obstacle.shape);
    for (int lane = 0; lane < kLanes; ++lane) {
      const double mine =
          fields.field.approach(0, scene.from(lane), 0.0, scene.to(lane), 1.0).signed_distance_m;
      const double proven =
          fcl.by_gjk(scene.from(lane) - scene.obstacle.position_m, scene.to(lane) - scene.obstacle.position_m)
              .distance_m;
      RC_ASSERT(proven <= std::max(mine, 0.0) + kExact * (scene.size_m + scene.from(lane).norm()));
      const double judged = fcl.to_segment(scene.from(lane) - scene.obstacle.position_m,
                                           scene.to(lane) - scene.obstacle.position_m)
                                .distance_m;
      RC_ASSERT(std::abs(judged - std::max(mine, 0.0)) <= 1e-6 * (1.0 + std::abs(mine)));
    }
  }));
}

}  // namespace
}  // namespace swallowtail::planner
