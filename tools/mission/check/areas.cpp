#include "tools/mission/check/areas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::check {
namespace {

double piece_distance_m(const P2& a, const P2& b, const P2& p) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length2 = dx * dx + dy * dy;
  const double s =
      length2 > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - s * dx, p.y - a.y - s * dy);
}

}  // namespace

bool holds(const Rings& rings, const P2& p) {
  bool inside = false;
  for (const auto& ring : rings) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const P2& a = ring[i];
      const P2& b = ring[j];
      if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
    }
  }
  return inside;
}

double border_distance_m(const Rings& rings, const P2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& ring : rings) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      nearest = std::min(nearest, piece_distance_m(ring[j], ring[i], p));
  }
  return nearest;
}

double line_distance_m(const std::vector<P2>& line, const P2& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i)
    nearest = std::min(nearest, piece_distance_m(line[i - 1], line[i], p));
  return nearest;
}

}  // namespace swallowtail::check
