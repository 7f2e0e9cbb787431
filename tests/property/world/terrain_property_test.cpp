#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/world/terrain.hpp"
#include "planner/world/world.hpp"
#include "tests/support/oracle.hpp"
#include "tests/support/scenes.hpp"

namespace swallowtail::planner {
namespace {

std::shared_ptr<const World> bare_world(const Terrain& terrain) {
  return *World::make(terrain, {}, Bounds{});
}

/// A random raster of any shape, from 2 × 2 on; odd sizes leave the pyramid's last blocks half empty.
Terrain any_terrain(Rng& rng, double cell_size_m, int& rows, int& cols) {
  rows = 2 + static_cast<int>(rng.below(30));
  cols = 2 + static_cast<int>(rng.below(30));
  return test::random_terrain(rng, Vec2(-20.0, 7.0), rows, cols, cell_size_m, 40.0);
}

TEST(TerrainProperty, MinHeightAboveIsTheLeastOfDenseSamples) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(seed);
    const double cell = rng.uniform(0.5, 8.0);
    int rows = 0;
    int cols = 0;
    const Terrain terrain = any_terrain(rng, cell, rows, cols);
    const auto world = bare_world(terrain);
    const Vec3 lo(-20.0 - 2.0 * cell, 7.0 - 2.0 * cell, -10.0);
    const Vec3 hi(-20.0 + (cols + 2.0) * cell, 7.0 + (rows + 2.0) * cell, 80.0);
    Vec3 a = test::random_point(rng, lo, hi);
    Vec3 b = test::random_point(rng, lo, hi);
    if (rng.below(5) == 0) b.x() = a.x();
    if (rng.below(5) == 0) b.y() = a.y();
    if (rng.below(5) == 0)
      a.head<2>() = Vec2(-20.0 + cell * static_cast<double>(rng.below(cols)),
                         7.0 + cell * static_cast<double>(rng.below(rows)));
    constexpr int kSamples = 600;
    double sampled = 1e300;
    for (int i = 0; i <= kSamples; ++i) {
      const Vec3 p = a + (b - a) * (static_cast<double>(i) / kSamples);
      sampled = std::min(sampled, p.z() - test::ground_m(*world, p.x(), p.y()));
    }
    const double exact = terrain.min_height_above(a, b);
    const double step_m = (b - a).norm() / kSamples;
    ASSERT_LE(exact, sampled + 1e-9);
    ASSERT_GE(exact, sampled - step_m * (1.0 + terrain.max_slope()));
    ASSERT_NEAR(exact, terrain.min_height_above(b, a), 1e-9);
    const double cap = rng.uniform(-40.0, 60.0);
    ASSERT_NEAR(terrain.min_height_above(a, b, cap), std::min(cap, exact), 1e-9);
  }
}

/// Cut at every crossing of a grid line, found by sorting; between two of them the height is a parabola
/// through its ends and middle, whose roots cut again; whether a part is below is asked at its middle.
double length_below_by_cuts(const World& world, const Vec3& a, const Vec3& b) {
  const TerrainGrid& grid = *world.terrain().grid();
  std::vector<double> cuts = {0.0, 1.0};
  for (int axis = 0; axis < 2; ++axis) {
    const double step = b[axis] - a[axis];
    const int lines = axis == 0 ? grid.cols : grid.rows;
    for (int k = 0; k < lines; ++k)
      cuts.push_back((grid.origin_m[axis] + k * grid.cell_size_m - a[axis]) / step);
  }
  std::erase_if(cuts, [](double t) { return !(t >= 0.0 && t <= 1.0); });
  const auto height = [&](double t) {
    const Vec3 p = a + (b - a) * t;
    return p.z() - test::ground_m(world, p.x(), p.y());
  };
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0, lines = cuts.size(); i + 1 < lines; ++i) {
    const double t0 = cuts[i];
    const double span = cuts[i + 1] - t0;
    const double h0 = height(t0);
    const double h1 = height(t0 + span);
    const double c2 = 2.0 * (h0 + h1) - 4.0 * height(t0 + 0.5 * span);
    const double c1 = h1 - h0 - c2;
    const double discriminant = c1 * c1 - 4.0 * c2 * h0;
    for (const double sign : {-1.0, 1.0}) {
      const double root =
          std::abs(c2) > 1e-12 ? (-c1 + sign * std::sqrt(discriminant)) / (2.0 * c2) : -h0 / c1;
      if (root > 0.0 && root < 1.0) cuts.push_back(t0 + root * span);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  double share = 0.0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (height(0.5 * (cuts[i] + cuts[i + 1])) <= 0.0) share += cuts[i + 1] - cuts[i];
  }
  return share * (b - a).norm();
}

TEST(TerrainProperty, LengthBelowIsWhatCutsAtEveryGridLineGive) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(seed);
    const double cell = rng.uniform(0.5, 8.0);
    int rows = 0;
    int cols = 0;
    const Terrain terrain = any_terrain(rng, cell, rows, cols);
    const Vec3 lo(-20.0 - 2.0 * cell, 7.0 - 2.0 * cell, -10.0);
    const Vec3 hi(-20.0 + (cols + 2.0) * cell, 7.0 + (rows + 2.0) * cell, 50.0);
    const Vec3 a = test::random_point(rng, lo, hi);
    Vec3 b = test::random_point(rng, lo, hi);
    if (rng.below(5) == 0) b.x() = a.x();
    if (rng.below(5) == 0) b.y() = a.y();
    const double exact = terrain.length_below(a, b);
    ASSERT_NEAR(exact, length_below_by_cuts(*bare_world(terrain), a, b), 1e-8 * (1.0 + (b - a).norm()));
    ASSERT_NEAR(exact, terrain.length_below(b, a), 1e-9 * (1.0 + (b - a).norm()));
  }
}

TEST(TerrainProperty, RectangleExtremesAreThoseOfDenseSamples) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Rng rng(seed);
    const double cell = rng.uniform(0.5, 8.0);
    int rows = 0;
    int cols = 0;
    const Terrain terrain = any_terrain(rng, cell, rows, cols);
    const auto world = bare_world(terrain);
    const auto corner = [&] {
      return Vec2(rng.uniform(-20.0 - cell, -20.0 + (cols + 1) * cell),
                  rng.uniform(7.0 - cell, 7.0 + (rows + 1) * cell));
    };
    const Vec2 p = corner();
    const Vec2 q = rng.below(4) == 0 ? p + Vec2(rng.uniform(0.0, cell), rng.uniform(0.0, cell)) : corner();
    const Vec2 lo = p.cwiseMin(q);
    const Vec2 hi = p.cwiseMax(q);
    double most = -1e300;
    double least = 1e300;
    double steepest = 0.0;
    constexpr int kSamples = 50;
    const Vec2 step = (hi - lo) / kSamples;
    for (int i = 0; i <= kSamples; ++i) {
      for (int j = 0; j <= kSamples; ++j) {
        const double x = lo.x() + step.x() * i;
        const double y = lo.y() + step.y() * j;
        const double z = test::ground_m(*world, x, y);
        most = std::max(most, z);
        least = std::min(least, z);
        if (i > 0 && step.x() > 1e-6)
          steepest = std::max(steepest, std::abs(z - test::ground_m(*world, x - step.x(), y)) / step.x());
      }
    }
    const double missed = 0.5 * step.norm() * terrain.max_slope() + 1e-9;
    ASSERT_GE(terrain.max_in(lo, hi), most - 1e-9);
    ASSERT_LE(terrain.max_in(lo, hi), most + missed);
    ASSERT_LE(terrain.min_in(lo, hi), least + 1e-9);
    ASSERT_GE(terrain.min_in(lo, hi), least - missed);
    ASSERT_GE(terrain.max_slope_in(lo, hi), steepest * (1.0 - 1e-6) - 1e-6);
    ASSERT_LE(terrain.max_slope_in(lo, hi), terrain.max_slope());
    ASSERT_EQ(terrain.max_in(hi, lo), terrain.max_in(lo, hi));
  }
}

}  // namespace
}  // namespace swallowtail::planner
