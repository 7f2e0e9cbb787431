#include "tools/bench/cover/holed_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/base/rng.hpp"

namespace swallowtail::bench {
namespace {

constexpr int kMostAttempts = 1000;
constexpr int kOutlineCorners = 11;
/// Circles around holes keep this factor apart.
constexpr double kClear = 1.02;

struct Circle {
  Vec2 middle_m;
  double radius_m = 0.0;
};

/// Corners at uneven angles between the least share of the radius and the radius.
coverage::Ring random_ring(Rng& rng, const Circle& circle, int corners, double least) {
  std::vector<double> gaps;
  double total = 0.0;
  for (int i = 0; i < corners; ++i) {
    gaps.push_back(0.35 + rng.uniform());
    total += gaps.back();
  }
  double angle_rad = rng.uniform(0.0, 2.0 * std::numbers::pi);
  coverage::Ring out;
  for (const double gap : gaps) {
    angle_rad += gap / total * 2.0 * std::numbers::pi;
    const double radius_m = circle.radius_m * rng.uniform(least, 1.0);
    out.push_back(circle.middle_m + radius_m * Vec2(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return out;
}

bool is_clear(const Circle& circle, const coverage::Polygon& outline, const std::vector<Circle>& placed) {
  return contains(outline, circle.middle_m) &&
         border_distance_m(outline, circle.middle_m) > circle.radius_m * kClear &&
         std::ranges::all_of(placed, [&](const Circle& other) {
           return (circle.middle_m - other.middle_m).norm() > (circle.radius_m + other.radius_m) * kClear;
         });
}

}  // namespace

coverage::Polygon holed_field(std::uint64_t seed, const HoledFieldParams& params) {
  Rng rng(seed);
  const coverage::Polygon outline{
      random_ring(rng, {Vec2::Zero(), 0.62 * params.side_m}, kOutlineCorners, 0.75), {}};
  coverage::Polygon out = outline;
  std::vector<Circle> placed;
  const double typical_m = params.side_m * std::sqrt(params.holes_share / std::max(1, params.holes) / 2.0);
  const double reach_m = 0.6 * params.side_m;
  int left = params.hole_corners;
  for (int hole = 0; hole < params.holes; ++hole) {
    const bool last = hole + 1 == params.holes;
    const int corners = last ? std::clamp(left, 3, 6) : 3 + static_cast<int>(rng.below(4)) * 9 / 10;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      const double x_m = rng.uniform(-reach_m, reach_m);
      const double y_m = rng.uniform(-reach_m, reach_m);
      const Circle circle{Vec2(x_m, y_m), typical_m * rng.uniform(0.5, 1.5)};
      if (!is_clear(circle, outline, placed)) continue;
      placed.push_back(circle);
      out.holes.push_back(random_ring(rng, circle, corners, 0.7));
      left -= corners;
      break;
    }
  }
  return out;
}

}  // namespace swallowtail::bench
