#include "coverage/field/detail/lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace swallowtail::coverage::detail {
namespace {

constexpr double kShortest_m = 0.02;

void add_crossings(const Ring& ring, const Line& line, std::vector<double>& out) {
  double left_a = line.left_of(ring.back());
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const double left_b = line.left_of(ring[i]);
    if ((left_a > 0.0) != (left_b > 0.0)) {
      const double a = line.along_of(ring[j]);
      const double b = line.along_of(ring[i]);
      out.push_back(a + (b - a) * left_a / (left_a - left_b));
    }
    left_a = left_b;
  }
}

/// Keeps of a ring what lies where sign · coordinate ≤ limit [SUTHERLAND-HODGMAN].
void clip(const Ring& ring, int axis, double sign, double limit, Ring& out) {
  out.clear();
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const double a = sign * ring[j][axis] - limit;
    const double b = sign * ring[i][axis] - limit;
    if ((a > 0.0) != (b > 0.0)) out.push_back(ring[j] + (ring[i] - ring[j]) * (a / (a - b)));
    if (b <= 0.0) out.push_back(ring[i]);
  }
}

double area_in_band(const Ring& ring, const Line& line, const Interval& within, double half_width,
                    Interval& extent) {
  Ring now;
  now.reserve(ring.size() + 4);
  for (const Vec2& p : ring) now.emplace_back(line.along_of(p), line.left_of(p));
  Ring next;
  const auto keep = [&](int axis, double sign, double limit) {
    if (now.empty()) return;
    clip(now, axis, sign, limit, next);
    std::swap(now, next);
  };
  keep(1, 1.0, half_width);
  keep(1, -1.0, half_width);
  keep(0, 1.0, within.to);
  keep(0, -1.0, -within.from);
  if (now.size() < 3) return 0.0;
  for (const Vec2& p : now) {
    extent.from = std::min(extent.from, p.x());
    extent.to = std::max(extent.to, p.x());
  }
  return std::abs(signed_area_m2(now));
}

}  // namespace

Line line_through(const Vec2& from, const Vec2& to) { return {from, (to - from).normalized()}; }

std::vector<Interval> inside_of(const Polygon& polygon, const Line& line) {
  std::vector<double> crossings;
  add_crossings(polygon.outline, line, crossings);
  for (const Ring& hole : polygon.holes) add_crossings(hole, line, crossings);
  return inside_between(std::move(crossings));
}

std::vector<Interval> inside_between(std::vector<double> crossings) {
  std::sort(crossings.begin(), crossings.end());
  std::vector<Interval> out;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    if (crossings[i + 1] - crossings[i] > kShortest_m)
      out.push_back({crossings[i] + kInside_m, crossings[i + 1] - kInside_m});
  }
  return out;
}

Ring seen_from(const Segment& segment, double width_m) {
  const Vec2 along = (segment.to_m - segment.from_m).normalized();
  const Vec2 side = Vec2(-along.y(), along.x()) * (width_m / 2.0);
  const Vec2 a = segment.from_m - along * kInside_m;
  const Vec2 b = segment.to_m + along * kInside_m;
  return {a - side, b - side, b + side, a + side};
}

BandPart part_in_band(const Polygon& polygon, const Line& line, const Interval& within, double half_width) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  BandPart out{0.0, {kFar, -kFar}};
  out.area_m2 = area_in_band(polygon.outline, line, within, half_width, out.extent);
  Interval ignored{kFar, -kFar};
  for (const Ring& hole : polygon.holes) out.area_m2 -= area_in_band(hole, line, within, half_width, ignored);
  return out;
}

}  // namespace swallowtail::coverage::detail
