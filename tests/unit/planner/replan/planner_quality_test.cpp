#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/unit/planner/replan/quality_scenes.hpp"

/// What the planner promises on families of random scenes, in evaluations, so that a busy machine fails
/// nothing. Times are measured by `swallowtail bench plan`.
namespace swallowtail::planner {
namespace {

using quality_scenes::Scene;

constexpr double kNoClimbLimit = 0.5 * std::numbers::pi;

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

double planned_m(const Scene& scene, std::uint64_t seed, std::uint64_t evaluations) {
  PlanRequest request = scene.request;
  request.seed = seed;
  const Result<PlanReport> report = plan_path(scene.world, request, {.max_evaluations = evaluations});
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report->status, PlanStatus::kCertified) << report->reason;
  return report->status == PlanStatus::kCertified ? report->length_m
                                                  : std::numeric_limits<double>::infinity();
}

double best_of_long_runs_m(const Scene& scene) {
  double best_m = planned_m(scene, 101, 15000);
  for (std::uint64_t seed = 102; seed <= 103; ++seed)
    best_m = std::min(best_m, planned_m(scene, seed, 15000));
  return best_m;
}

/// Gaps of runs of so many evaluations to the best of long ones.
std::vector<double> gaps(const std::vector<Scene>& scenes, std::uint64_t evaluations) {
  std::vector<double> all;
  for (const Scene& scene : scenes) {
    const double best_m = best_of_long_runs_m(scene);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const double length_m = planned_m(scene, seed, evaluations);
      all.push_back(length_m / std::min(best_m, length_m) - 1.0);
    }
  }
  return all;
}

TEST(PlannerQuality, AmongTenSpheres) {
  for (const double climb_max_rad : {kNoClimbLimit, 0.25 * std::numbers::pi}) {
    std::vector<Scene> scenes;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      scenes.push_back(quality_scenes::spheres(seed, 10, climb_max_rad));
    }
    const std::vector<double> found = gaps(scenes, 1500);
    EXPECT_LT(median(found), 1e-3);
    EXPECT_LT(std::ranges::max(found), 5e-2);
  }
}

TEST(PlannerQuality, AmongHillsAndBalls) {
  std::vector<Scene> scenes;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    scenes.push_back(quality_scenes::hills_and_balls(seed, kNoClimbLimit));
  }
  const std::vector<double> found = gaps(scenes, 2500);
  EXPECT_LT(median(found), 1e-3);
  EXPECT_LT(std::ranges::max(found), 5e-2);
}

TEST(PlannerQuality, TheFirstPathComesAtOnce) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    for (const Scene& scene : {quality_scenes::spheres(seed, 10, kNoClimbLimit),
                               quality_scenes::hills_and_balls(seed, kNoClimbLimit)}) {
      const Result<PlanReport> report = plan_path(scene.world, scene.request, {.max_evaluations = 600});
      ASSERT_TRUE(report.ok());
      ASSERT_EQ(report->status, PlanStatus::kCertified) << "seed " << seed;
      EXPECT_LE(report->history.front().evaluations, 60u) << "seed " << seed;
    }
  }
}

TEST(PlannerQuality, CrossesACityOfThousands) {
  const Scene scene = quality_scenes::city(1, 3000, 1100.0);
  const double length_m = planned_m(scene, 1, 2000);
  EXPECT_LT(length_m, 1.2 * (scene.request.goal_m - scene.request.start_m).norm());
}

/// The scene scaled, turned about the vertical and shifted. Bounds are opened, since they cannot be turned.
Scene moved(const Scene& from, double scale, double turn_rad, const Vec3& shift_m) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(turn_rad, Vec3::UnitZ()).toRotationMatrix();
  const auto place = [&](const Vec3& p) { return Vec3(scale * (turn * p) + shift_m); };
  Scene scene;
  scene.request = from.request;
  scene.request.start_m = place(from.request.start_m);
  scene.request.goal_m = place(from.request.goal_m);
  scene.request.limits.radius_m *= scale;
  std::vector<Obstacle> obstacles;
  for (Obstacle o : from.world->obstacles()) {
    o.position_m = place(o.position_m);
    std::get<Sphere>(o.shape).radius_m *= scale;
    obstacles.push_back(o);
  }
  const Vec3 room = Vec3::Constant(1000.0 * scale);
  scene.world = *World::make(Terrain::flat(shift_m.z() - 50.0 * scale), std::move(obstacles),
                             {shift_m - room, shift_m + room});
  return scene;
}

TEST(PlannerQuality, AScaleOfAPowerOfTwoGivesTheVeryPath) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Scene plain = moved(quality_scenes::spheres(seed, 10, kNoClimbLimit), 1.0, 0.0, Vec3::Zero());
    const Scene large = moved(quality_scenes::spheres(seed, 10, kNoClimbLimit), 16.0, 0.0, Vec3::Zero());
    const PlanReport a = *plan_path(plain.world, plain.request, {.max_evaluations = 1500});
    const PlanReport b = *plan_path(large.world, large.request, {.max_evaluations = 1500});
    ASSERT_EQ(a.path.size(), b.path.size()) << "seed " << seed;
    for (std::size_t i = 0; i < a.path.size(); ++i) {
      EXPECT_EQ(16.0 * a.path[i].position_m, b.path[i].position_m) << "seed " << seed;
    }
  }
}

/// Kolmogorov and Smirnov's distance of two samples.
double ks_distance(std::vector<double> a, std::vector<double> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  double greatest = 0.0;
  for (const double at : a) {
    const auto below = [&](const std::vector<double>& v) {
      return static_cast<double>(std::ranges::upper_bound(v, at) - v.begin()) / static_cast<double>(v.size());
    };
    greatest = std::max(greatest, std::abs(below(a) - below(b)));
  }
  return greatest;
}

TEST(PlannerQuality, AShiftedOrTurnedSceneGivesTheSameLengths) {
  constexpr int kRuns = 100;
  const Scene base = quality_scenes::spheres(9, 10, kNoClimbLimit);
  const auto lengths = [&](const Scene& scene, std::uint64_t first_seed) {
    std::vector<double> all;
    for (std::uint64_t k = 0; k < kRuns; ++k) {
      // What differs in the sixth digit counts as the same.
      all.push_back(std::round(1e5 * planned_m(scene, first_seed + k, 250)) / 1e5);
    }
    return all;
  };
  const std::vector<double> plain = lengths(moved(base, 1.0, 0.0, Vec3::Zero()), 1000);
  const double critical = 1.63 * std::sqrt(2.0 / kRuns);  // at 1 %
  EXPECT_LT(ks_distance(plain, lengths(moved(base, 1.0, 0.7, Vec3::Zero()), 2000)), critical);
  EXPECT_LT(ks_distance(plain, lengths(moved(base, 1.0, 0.0, Vec3(300, -200, 90)), 3000)), critical);
}

}  // namespace
}  // namespace swallowtail::planner
