#include "tests/support/holed_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "planner/base/rng.hpp"

namespace swallowtail::test_support {
namespace {

constexpr int kMostAttempts = 1000;
/// Circles around holes keep this factor apart.
constexpr double kClear = 1.02;

struct Circle {
  Point middle;
  double radius = 0.0;
};

/// Corners at uneven angles between the least share of the radius and the radius.
std::vector<Point> random_ring(Rng& rng, const Circle& circle, int corners, double least) {
  std::vector<double> gaps;
  double total = 0.0;
  for (int i = 0; i < corners; ++i) {
    gaps.push_back(0.35 + rng.uniform());
    total += gaps.back();
  }
  double angle = rng.uniform(0.0, 2.0 * std::numbers::pi);
  std::vector<Point> out;
  for (const double gap : gaps) {
    angle += gap / total * 2.0 * std::numbers::pi;
    const double radius = circle.radius * rng.uniform(least, 1.0);
    out.emplace_back(circle.middle.first + radius * std::cos(angle),
                     circle.middle.second + radius * std::sin(angle));
  }
  return out;
}

bool is_clear(const Circle& circle, const Ground& outline, const std::vector<Circle>& placed) {
  const auto apart = [&](const Circle& other) {
    return std::hypot(circle.middle.first - other.middle.first, circle.middle.second - other.middle.second) >
           (circle.radius + other.radius) * kClear;
  };
  return is_on(outline, circle.middle) &&
         distance_to_border(outline, circle.middle) > circle.radius * kClear &&
         std::all_of(placed.begin(), placed.end(), apart);
}

}  // namespace

Ground holed_field(std::uint64_t seed, const HoledFieldParams& params) {
  Rng rng(seed);
  Ground outline{{random_ring(rng, {{0.0, 0.0}, 0.62 * params.side_m}, 11, 0.75)}};
  Ground out = outline;
  std::vector<Circle> placed;
  const double typical_m = params.side_m * std::sqrt(params.holes_share / params.holes / 2.0);
  int left = params.hole_corners;
  for (int hole = 0; hole < params.holes; ++hole) {
    const bool last = hole + 1 == params.holes;
    const int corners = last ? std::clamp(left, 3, 6) : 3 + static_cast<int>(rng.below(4)) * 9 / 10;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      const double reach = 0.6 * params.side_m;
      const Circle circle{{rng.uniform(-reach, reach), rng.uniform(-reach, reach)},
                          typical_m * rng.uniform(0.5, 1.5)};
      if (!is_clear(circle, outline, placed)) continue;
      placed.push_back(circle);
      out.rings.push_back(random_ring(rng, circle, corners, 0.7));
      left -= corners;
      break;
    }
  }
  return out;
}

}  // namespace swallowtail::test_support
