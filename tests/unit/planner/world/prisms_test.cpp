#include "planner/world/prisms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "planner/base/rng.hpp"

namespace swallowtail::planner {
namespace {

using Part = std::vector<Vec2>;

double area_of(const Part& part) {
  double twice = 0.0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Vec2& a = part[i];
    const Vec2& b = part[(i + 1) % part.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

bool is_convex(const Part& part) {
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Vec2 u = part[(i + 1) % part.size()] - part[i];
    const Vec2 v = part[(i + 2) % part.size()] - part[(i + 1) % part.size()];
    if (u.x() * v.y() - u.y() * v.x() < -1e-9) return false;
  }
  return true;
}

bool holds(const Part& ring, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    if ((ring[i].y() > p.y()) != (ring[j].y() > p.y()) &&
        p.x() <
            (ring[j].x() - ring[i].x()) * (p.y() - ring[i].y()) / (ring[j].y() - ring[i].y()) + ring[i].x())
      inside = !inside;
  }
  return inside;
}

/// A star around a place, with random radii.
Part star(Rng& rng, const Vec2& centre, double least_m, double most_m, int corners) {
  Part out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    out.push_back(centre + rng.uniform(least_m, most_m) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return out;
}

TEST(ConvexParts, ASquareIsOnePart) {
  const auto parts = convex_parts({{Vec2(0, 0), Vec2(10, 0), Vec2(10, 10), Vec2(0, 10)}, {}});
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 1U);
  EXPECT_NEAR(area_of(parts->front()), 100.0, 1e-9);
}

TEST(ConvexParts, AreConvexAndMakeUpTheAreaWithoutItsHoles) {
  Rng rng(11);
  for (int round = 0; round < 100; ++round) {
    const int corners = 3 + static_cast<int>(rng.below(40));
    Area area{star(rng, Vec2(100, -50), 20.0, 60.0, corners), {}};
    if (rng.below(2) == 0) area.holes.push_back(star(rng, Vec2(100, -50), 2.0, 6.0, 7));
    const auto parts = convex_parts(area);
    ASSERT_TRUE(parts) << "round " << round << ": " << parts.error().message;
    double asked = std::abs(area_of(area.outline));
    for (const Part& hole : area.holes) asked -= std::abs(area_of(hole));
    double sum = 0.0;
    for (const Part& part : *parts) {
      EXPECT_TRUE(is_convex(part)) << "round " << round;
      EXPECT_GT(area_of(part), 0.0);
      EXPECT_LE(part.size(), kMaxPrismCorners);
      sum += area_of(part);
    }
    EXPECT_NEAR(sum, asked, 1e-6 * asked) << "round " << round;
    EXPECT_LT(parts->size(), area.outline.size() + 12) << "triangles were joined";
    for (int k = 0; k < 200; ++k) {
      const Vec2 p(rng.uniform(40, 160), rng.uniform(-110, 10));
      bool inside = holds(area.outline, p);
      for (const Part& hole : area.holes) inside = inside && !holds(hole, p);
      int count = 0;
      for (const Part& part : *parts) count += holds(part, p) ? 1 : 0;
      EXPECT_EQ(count, inside ? 1 : 0) << "round " << round;
    }
  }
}

TEST(ConvexParts, RefusesWhatIsNoPolygon) {
  EXPECT_FALSE(convex_parts({{Vec2(0, 0), Vec2(1, 1)}, {}}));
  EXPECT_FALSE(convex_parts({{Vec2(0, 0), Vec2(10, 10), Vec2(10, 0), Vec2(0, 10)}, {}})) << "a bow tie";
  EXPECT_FALSE(convex_parts({{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)}, {{Vec2(5, 5), Vec2(6, 5), Vec2(6, 6)}}}));
}

}  // namespace
}  // namespace swallowtail::planner
