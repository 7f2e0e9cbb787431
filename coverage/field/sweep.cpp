#include "coverage/field/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace swallowtail::coverage {
namespace {

constexpr std::size_t kMaxDirections = 72;
constexpr double kSameDirection_rad = 0.005;

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
    const bool known = std::any_of(out.begin(), out.end(),
                                   [&](double a) { return std::abs(a - d.angle_rad) < kSameDirection_rad; });
    if (!known && out.size() < limit) out.push_back(d.angle_rad);
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

double cost_of(const Polygon& polygon, double angle_rad, const SweepParams& params) {
  const Polygon turned = rotated(polygon, -angle_rad);
  const Box box = bounds_of(turned.outline);
  const double extent = box.hi.y() - box.lo.y();
  const int strips = strip_count(extent, params.sensor_width_m);
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

int strip_count(double extent_m, double sensor_width_m) {
  return std::max(1, static_cast<int>(std::ceil(extent_m / sensor_width_m - 1e-6)));
}

double best_sweep_rad(const Polygon& polygon, const SweepParams& params) {
  std::vector<double> candidates = directions_of(convex_hull(polygon.outline), kMaxDirections / 2);
  for (const double angle : directions_of(polygon.outline, kMaxDirections / 2)) candidates.push_back(angle);
  double best = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const double angle : candidates) {
    const double cost = cost_of(polygon, angle, params);
    if (cost < least - 1e-9) {
      least = cost;
      best = angle;
    }
  }
  return best;
}

}  // namespace swallowtail::coverage
