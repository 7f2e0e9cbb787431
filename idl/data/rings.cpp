#include "idl/data/rings.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstdint>
#include <span>

#include "idl/data/ranges.hpp"

namespace swallowtail::data {

namespace {

/// Twice the signed area of the triangle.
double orient(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x_m - a.x_m) * (c.y_m - a.y_m) - (b.y_m - a.y_m) * (c.x_m - a.x_m);
}

/// Whether `p`, known to be in line with a and b, lies between them.
bool is_between(const Point2& a, const Point2& b, const Point2& p) {
  return std::min(a.x_m, b.x_m) <= p.x_m && p.x_m <= std::max(a.x_m, b.x_m) &&
         std::min(a.y_m, b.y_m) <= p.y_m && p.y_m <= std::max(a.y_m, b.y_m);
}

bool boxes_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return std::max(a.x_m, b.x_m) >= std::min(c.x_m, d.x_m) &&
         std::max(c.x_m, d.x_m) >= std::min(a.x_m, b.x_m) &&
         std::max(a.y_m, b.y_m) >= std::min(c.y_m, d.y_m) && std::max(c.y_m, d.y_m) >= std::min(a.y_m, b.y_m);
}

/// Whether the closed segments have a point in common.
bool segments_meet(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  if (!boxes_meet(a, b, c, d)) return false;
  const double c_side = orient(a, b, c);
  const double d_side = orient(a, b, d);
  const double a_side = orient(c, d, a);
  const double b_side = orient(c, d, b);
  const auto opposite = [](double p, double q) { return (p > 0.0 && q < 0.0) || (p < 0.0 && q > 0.0); };
  if (opposite(c_side, d_side) && opposite(a_side, b_side)) return true;
  return (c_side == 0.0 && is_between(a, b, c)) || (d_side == 0.0 && is_between(a, b, d)) ||
         (a_side == 0.0 && is_between(c, d, a)) || (b_side == 0.0 && is_between(c, d, b));
}

/// Whether the edges that share `corner` run back over each other.
bool is_spike(const Point2& before, const Point2& corner, const Point2& after) {
  if (orient(before, corner, after) != 0.0) return false;
  const double dot = (before.x_m - corner.x_m) * (after.x_m - corner.x_m) +
                     (before.y_m - corner.y_m) * (after.y_m - corner.y_m);
  return dot >= 0.0;
}

bool crosses_itself(std::span<const Point2> ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (is_spike(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n])) return true;
  }
  for (std::size_t i = 0; i + 2 < n; ++i) {
    const std::size_t last = i == 0 ? n - 1 : n;  // the closing edge is a neighbour of the first
    for (std::size_t j = i + 2; j < last; ++j) {
      if (segments_meet(ring[i], ring[i + 1], ring[j], ring[(j + 1) % n])) return true;
    }
  }
  return false;
}

double twice_area(std::span<const Point2> ring) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum += orient(ring[0], ring[i], ring[i + 1]);
  return sum;
}

}  // namespace

Refusal check_rings(const CoverageTask& task) {
  for (const Point2& point : task.points) {
    if (!ranges::is_horizontal(point.x_m) || !ranges::is_horizontal(point.y_m)) return "point out of range";
  }
  std::array<std::bitset<kMaxAreas>, 3> outlined;
  std::array<std::size_t, 3> count{task.fields.size(), 0, 0};
  for (const Ring& ring : task.rings) {
    if (ring.kind > AreaKind::kNoDrive) return "enumerator out of range";
    const auto kind = static_cast<std::size_t>(ring.kind);
    if (ring.kind == AreaKind::kField && ring.area_index >= task.fields.size()) return "ring of no field";
    if (ring.area_index >= kMaxAreas) return "area index above its bound";
    if (ring.point_count < 3) return "ring has under 3 points";
    if (ring.point_count > kMaxRingPoints) return "ring above its bound";
    if (std::uint64_t{ring.first_point} + ring.point_count > task.points.size())
      return "ring outside the points";
    if (outlined[kind][ring.area_index] != ring.is_hole) {
      return ring.is_hole ? "hole before its outline" : "area has two outlines";
    }
    outlined[kind].set(ring.area_index);
    count[kind] = std::max<std::size_t>(count[kind], ring.area_index + 1);
    const std::span<const Point2> points(task.points.data() + ring.first_point, ring.point_count);
    if (crosses_itself(points)) return "ring crosses itself";
    if (twice_area(points) == 0.0) return "ring without area";
  }
  for (std::size_t kind = 0; kind < count.size(); ++kind) {
    if (outlined[kind].count() != count[kind]) return "area without an outline";
  }
  return {};
}

}  // namespace swallowtail::data
