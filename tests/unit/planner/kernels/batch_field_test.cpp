#include "planner/kernels/batch_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "planner/kernels/detail/batch_kernel.hpp"
#include "tests/support/scenes.hpp"

namespace swallowtail::planner {
namespace {

struct Hops {
  LanePoint a, b;
  Vec3 from(int lane) const { return {a.x[lane], a.y[lane], a.z[lane]}; }
  Vec3 to(int lane) const { return {b.x[lane], b.y[lane], b.z[lane]}; }
};

Hops random_hops(Rng& rng, const Vec3& lo, const Vec3& hi) {
  Hops hops;
  for (int lane = 0; lane < kLanes; ++lane) {
    const Vec3 a = test::random_point(rng, lo, hi);
    const Vec3 b = rng.below(10) == 0 ? a : test::random_point(rng, lo, hi);
    for (auto [point, v] : {std::pair{&hops.a, &a}, std::pair{&hops.b, &b}}) {
      point->x[lane] = v->x();
      point->y[lane] = v->y();
      point->z[lane] = v->z();
    }
  }
  return hops;
}

const Vec3 kLo(-30.0, -30.0, -5.0);
const Vec3 kHi(30.0, 30.0, 30.0);

std::shared_ptr<const World> random_world(Rng& rng, std::uint32_t count) {
  std::vector<Obstacle> obstacles;
  for (std::uint32_t id = 1; id <= count; ++id)
    obstacles.push_back(test::random_obstacle(rng, id, kLo, kHi, 15.0));
  return *World::make(test::random_terrain(rng, Vec2(-25.0, -25.0), 20, 22, 2.0, 15.0), obstacles, Bounds{});
}

TEST(BatchField, GivesWhatTheFieldGivesLaneByLane) {
  Rng rng(5);
  for (int trial = 0; trial < 300; ++trial) {
    const auto world = random_world(rng, 12);
    const ObstacleField field(world, VehicleLimits{});
    const BatchField batch(field);
    const Hops hops = random_hops(rng, kLo, kHi);
    Lanes length_m = Lanes::Zero();
    Lanes violation_m = Lanes::Zero();
    Lanes terrain_m = Lanes::Zero();
    Lanes below_m = Lanes::Zero();
    BatchField::add_length(hops.a, hops.b, length_m);
    batch.add_violation(hops.a, hops.b, violation_m);
    batch.add_terrain_violation(hops.a, hops.b, terrain_m);
    batch.add_length_below_ground(hops.a, hops.b, below_m);
    std::vector<LaneDistance> buffer;
    const auto near = batch.distances(hops.a, hops.b, 8.0, buffer);
    for (int lane = 0; lane < kLanes; ++lane) {
      const Vec3 a = hops.from(lane);
      const Vec3 b = hops.to(lane);
      double expected_m = 0.0;
      for (std::size_t i = 0; i < field.standing(); ++i) {
        expected_m += field.violation_m(i, a, 0.0, b, 1.0);
        const double distance = field.approach(i, a, 0.0, b, 1.0).signed_distance_m;
        const auto found =
            std::find_if(near.begin(), near.end(), [&](const auto& d) { return d.obstacle == i; });
        if (found == near.end()) {
          EXPECT_GE(distance, 8.0);
        } else {
          EXPECT_NEAR(found->signed_distance_m[lane], distance, 1e-8);
        }
        const Vec3 centre = world->obstacles()[field.id(i) - 1].position_m;
        const Vec2 p = a.head<2>() - centre.head<2>();
        const Vec2 d = b.head<2>() - a.head<2>();
        const double s = d.squaredNorm() > 0.0 ? std::clamp(-p.dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
        EXPECT_NEAR(batch.axis_distance_m(i, hops.a, hops.b)[lane], (p + s * d).norm(), 1e-10);
      }
      EXPECT_NEAR(violation_m[lane], expected_m, 1e-8);
      EXPECT_NEAR(length_m[lane], (b - a).norm(), 1e-12);
      EXPECT_NEAR(terrain_m[lane], field.terrain_violation_m(a, b), 1e-10);
      EXPECT_NEAR(below_m[lane], world->terrain().length_below(a, b), 1e-9);
    }
  }
}

TEST(BatchField, LeavesOutWhatMovesOrEnds) {
  Obstacle stands{.id = 7, .shape = Sphere{1.0}};
  Obstacle moves{.id = 8, .shape = Sphere{1.0}, .velocity_mps = Vec3(1.0, 0.0, 0.0)};
  Obstacle ends{.id = 9, .shape = Sphere{1.0}, .valid_until_s = 5.0};
  const ObstacleField field(*World::make(Terrain::flat(-100.0), {moves, stands, ends}, Bounds{}),
                            VehicleLimits{});
  const BatchField batch(field);
  ASSERT_EQ(batch.timed().size(), 2U);
  for (const std::size_t i : batch.timed()) EXPECT_NE(field.id(i), 7U);
  std::vector<LaneDistance> buffer;
  const LanePoint origin;
  const auto near = batch.distances(origin, origin, 100.0, buffer);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(field.id(near[0].obstacle), 7U);
  EXPECT_NEAR(near[0].signed_distance_m[3], -1.0, 1e-12);
}

TEST(BatchField, EveryWidthOfRegistersGivesTheSameBits) {
  Rng rng(6);
  const auto kernels = detail::batch_kernels();
  for (int trial = 0; trial < 300; ++trial) {
    const ObstacleField field(random_world(rng, 12), VehicleLimits{});
    const detail::SolidList list{field.solids().data(), field.standing_tree().nodes(),
                                 field.supports().data()};
    const Hops hops = random_hops(rng, kLo, kHi);
    Lanes expected_m = Lanes::Zero();
    std::vector<LaneDistance> expected(field.size());
    kernels.front().add_violation(list, hops.a, hops.b, expected_m);
    kernels.front().distances(list, hops.a, hops.b, 20.0, expected.data());
    for (const detail::BatchKernel& kernel : kernels) {
      Lanes violation_m = Lanes::Zero();
      kernel.add_violation(list, hops.a, hops.b, violation_m);
      EXPECT_EQ(std::memcmp(violation_m.data(), expected_m.data(), sizeof(double) * kLanes), 0)
          << kernel.name;
      std::vector<LaneDistance> found(field.size());
      const std::size_t count = kernel.distances(list, hops.a, hops.b, 20.0, found.data());
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(found[i].obstacle, expected[i].obstacle) << kernel.name;
        EXPECT_TRUE((found[i].signed_distance_m == expected[i].signed_distance_m).all()) << kernel.name;
      }
    }
  }
}

struct GroundAnswers {
  Lanes least_m = Lanes::Zero();
  Lanes below_m = Lanes::Zero();
  unsigned least_lanes = 0;
  unsigned below_lanes = 0;
};

GroundAnswers ask(const detail::BatchKernel& kernel, const detail::GroundView& ground, const Hops& hops,
                  double cap_m) {
  GroundAnswers answers;
  answers.least_lanes = kernel.least_height(ground, hops.a, hops.b, cap_m, answers.least_m);
  answers.below_lanes = kernel.length_below(ground, hops.a, hops.b, answers.below_m);
  return answers;
}

TEST(BatchField, EveryWidthWalksRastersAsTheTerrainDoes) {
  Rng rng(7);
  unsigned walked = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const int rows = 2 + static_cast<int>(rng.below(trial % 20 == 0 ? 900 : 60));
    const int cols = 2 + static_cast<int>(rng.below(60));
    const double cell_m = rng.uniform(0.2, 3.0);
    const Terrain terrain = test::random_terrain(rng, Vec2(-20.0, -10.0), rows, cols, cell_m, 25.0);
    const detail::GroundView ground = detail::ground_view(terrain);
    const Vec3 reach((cols - 1) * cell_m, (rows - 1) * cell_m, 30.0);
    const Hops hops = random_hops(rng, Vec3(-20.1, -10.1, -2.0), Vec3(-20.0, -10.0, 0.0) + reach);
    const double cap_m = rng.uniform(-5.0, 20.0);
    const GroundAnswers expected = ask(detail::batch_kernels().front(), ground, hops, cap_m);
    for (const detail::BatchKernel& kernel : detail::batch_kernels()) {
      const GroundAnswers answers = ask(kernel, ground, hops, cap_m);
      EXPECT_EQ(answers.least_lanes, expected.least_lanes) << kernel.name;
      EXPECT_EQ(answers.below_lanes, expected.below_lanes) << kernel.name;
      for (int lane = 0; lane < kLanes; ++lane) {
        const bool is_walked = (expected.least_lanes >> lane & 1U) != 0;
        EXPECT_EQ(is_walked, (expected.below_lanes >> lane & 1U) != 0);
        if (!is_walked) continue;
        ++walked;
        EXPECT_EQ(answers.least_m[lane], expected.least_m[lane]) << kernel.name;
        EXPECT_EQ(answers.below_m[lane], expected.below_m[lane]) << kernel.name;
        const Vec3 a = hops.from(lane);
        const Vec3 b = hops.to(lane);
        EXPECT_NEAR(answers.least_m[lane], terrain.min_height_above(a, b, cap_m), 1e-9);
        EXPECT_NEAR(answers.below_m[lane], terrain.length_below(a, b), 1e-8 * (1.0 + (b - a).norm()));
      }
    }
  }
  EXPECT_GT(walked, 3000U) << "most hops must be walked by the kernels themselves";
}

TEST(BatchField, ALaneDoesNotDependOnItsNeighbours) {
  Rng rng(8);
  for (int trial = 0; trial < 200; ++trial) {
    const ObstacleField field(random_world(rng, 12), VehicleLimits{});
    const BatchField batch(field);
    const Hops together = random_hops(rng, kLo, kHi);
    Lanes sum_m = Lanes::Zero();
    batch.add_violation(together.a, together.b, sum_m);
    for (int lane = 0; lane < kLanes; ++lane) {
      Hops alone;
      for (auto axis : {&LanePoint::x, &LanePoint::y, &LanePoint::z}) {
        (alone.a.*axis).setConstant((together.a.*axis)[lane]);
        (alone.b.*axis).setConstant((together.b.*axis)[lane]);
      }
      Lanes alone_m = Lanes::Zero();
      batch.add_violation(alone.a, alone.b, alone_m);
      EXPECT_TRUE((alone_m == sum_m[lane]).all());
    }
  }
}

}  // namespace
}  // namespace swallowtail::planner
