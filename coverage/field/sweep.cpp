#include "coverage/field/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "coverage/field/detail/simplify.hpp"

namespace swallowtail::coverage {
namespace {

constexpr std::size_t kMaxDirections = 72;
constexpr double kSameDirection_rad = 0.005;
/// See detail/rest.cpp: what counts as one straight stretch of border, as share of the width.
constexpr double kStraight = 0.24;
/// Of the field that a stretch of border may leave uncovered without a line of its own.
constexpr double kNegligibleShare = 5e-5;

Ring convex_hull(Ring points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  Ring hull(2 * points.size());
  std::size_t size = 0;
  const auto add = [&](const Vec2& p, std::size_t least) {
    while (size >= least) {
      const Vec2 u = hull[size - 1] - hull[size - 2];
      const Vec2 v = p - hull[size - 2];
      if (u.x() * v.y() - u.y() * v.x() > 0.0) break;
      --size;
    }
    hull[size++] = p;
  };
  for (const Vec2& p : points) add(p, 2);
  const std::size_t least = size + 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], least);
  hull.resize(size > 1 ? size - 1 : size);
  return hull;
}

struct Direction {
  double angle_rad;
  double length_m;
};

bool is_known(const std::vector<double>& angles_rad, double angle_rad) {
  return std::any_of(angles_rad.begin(), angles_rad.end(),
                     [&](double a) { return std::abs(a - angle_rad) < kSameDirection_rad; });
}

/// Edges' directions in [0, π), the longest first, equal ones once.
std::vector<double> directions_of(const Ring& ring, std::size_t limit) {
  std::vector<Direction> all;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 edge = ring[(i + 1) % ring.size()] - ring[i];
    double angle = std::atan2(edge.y(), edge.x());
    if (angle < 0.0) angle += std::numbers::pi;
    if (angle >= std::numbers::pi - 1e-12) angle = 0.0;
    all.push_back({angle, edge.norm()});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Direction& a, const Direction& b) { return a.length_m > b.length_m; });
  std::vector<double> out;
  for (const Direction& d : all) {
    if (!is_known(out, d.angle_rad) && out.size() < limit) out.push_back(d.angle_rad);
  }
  return out;
}

void add_crossings(const Ring& ring, double low, double step, std::vector<std::vector<double>>& crossings) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    Vec2 a = ring[i];
    Vec2 b = ring[(i + 1) % ring.size()];
    if (a.y() > b.y()) std::swap(a, b);
    const int first = std::max(0, static_cast<int>(std::ceil((a.y() - low) / step - 0.5)));
    for (int s = first; s < static_cast<int>(crossings.size()); ++s) {
      const double y = low + (s + 0.5) * step;
      if (y >= b.y()) break;
      if (y < a.y()) continue;
      crossings[static_cast<std::size_t>(s)].push_back(a.x() +
                                                       (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
    }
  }
}

/// Straight stretches of the border, by direction and length.
std::vector<Direction> stretches_of(const Polygon& polygon, double tolerance_m) {
  std::vector<Direction> out;
  const auto add = [&](const Ring& ring) {
    const std::vector<std::size_t> corners = detail::corners_of(ring, tolerance_m);
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
      const Vec2 edge = ring[corners[k + 1] % ring.size()] - ring[corners[k]];
      out.push_back({std::atan2(edge.y(), edge.x()), edge.norm()});
    }
  };
  add(polygon.outline);
  for (const Ring& hole : polygon.holes) add(hole);
  return out;
}

/// What lines along slanted borders will cost: strips leave a triangle of w²/8 · |cot θ| at each end, L · sin
/// θ / w of them along a border of length L.
double border_cost(const std::vector<Direction>& stretches, double angle_rad, double area_m2,
                   const SweepParams& params) {
  double cost = 0.0;
  for (const Direction& d : stretches) {
    const double left_m2 =
        d.length_m *
        std::min(params.sensor_width_m, d.length_m * std::abs(std::sin(d.angle_rad - angle_rad))) *
        std::abs(std::cos(d.angle_rad - angle_rad)) / 8.0;
    if (left_m2 > kNegligibleShare * area_m2) cost += params.piece_cost_m;
  }
  return cost;
}

double cost_of(const Polygon& polygon, double angle_rad, const SweepParams& params) {
  const Polygon turned = rotated(polygon, -angle_rad);
  const Box box = bounds_of(turned.outline);
  const double extent = box.hi.y() - box.lo.y();
  const int strips = strip_count(extent, params.spacing_m);
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(strips));
  add_crossings(turned.outline, box.lo.y(), extent / strips, crossings);
  for (const Ring& hole : turned.holes) add_crossings(hole, box.lo.y(), extent / strips, crossings);
  double cost = 0.0;
  for (std::vector<double>& xs : crossings) {
    std::sort(xs.begin(), xs.end());
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) cost += xs[i + 1] - xs[i] + params.piece_cost_m;
  }
  return cost;
}

}  // namespace

int strip_count(double extent_m, double spacing_m) {
  return std::max(1, static_cast<int>(std::ceil(extent_m / spacing_m - 1e-6)));
}

std::vector<double> best_sweeps_rad(const Polygon& polygon, const SweepParams& params, std::size_t count) {
  std::vector<double> candidates = directions_of(convex_hull(polygon.outline), kMaxDirections / 2);
  for (const double angle : directions_of(polygon.outline, kMaxDirections / 2)) {
    if (!is_known(candidates, angle)) candidates.push_back(angle);
  }
  const std::vector<Direction> stretches = stretches_of(polygon, kStraight * params.sensor_width_m);
  const double area = area_m2(polygon);
  std::vector<std::pair<double, double>> ranked;
  for (const double angle : candidates)
    ranked.emplace_back(cost_of(polygon, angle, params) + border_cost(stretches, angle, area, params), angle);
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> out;
  for (std::size_t i = 0; i < std::min(count, ranked.size()); ++i) out.push_back(ranked[i].second);
  return out;
}

}  // namespace swallowtail::coverage
