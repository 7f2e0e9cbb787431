#include "coverage/field/polygon.hpp"

#include <cmath>
#include <string>

#include "coverage/field/detail/geos.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kMaxCoordinate_m = 1e6;
constexpr double kLeastRingArea_m2 = 1e-3;

bool is_redundant(const Vec2& before, const Vec2& at, const Vec2& after) {
  if ((at - before).norm() < kRepeatedVertex_m) return true;
  const Vec2 chord = after - before;
  const double length = chord.norm();
  if (length < kRepeatedVertex_m) return true;  // a spike that comes back to where it left
  const Vec2 to = at - before;
  return std::abs(chord.x() * to.y() - chord.y() * to.x()) / length < kCollinear_m;
}

/// Leaves redundant vertices out until none is left.
Ring simplified(Ring ring) {
  for (bool changed = true; changed && ring.size() >= 3;) {
    changed = false;
    Ring kept;
    kept.reserve(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2& before = kept.empty() ? ring.back() : kept.back();
      const Vec2& after = i + 1 < ring.size() ? ring[i + 1] : (kept.empty() ? ring.front() : kept.front());
      if (is_redundant(before, ring[i], after)) {
        changed = true;
      } else {
        kept.push_back(ring[i]);
      }
    }
    ring = std::move(kept);
  }
  return ring;
}

Status check_coordinates(const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const bool good = is_finite(ring[i]) && ring[i].cwiseAbs().maxCoeff() <= kMaxCoordinate_m;
    if (!good) return bad_input("Vertex " + std::to_string(i) + " is not finite or lies beyond 1e6 m.");
  }
  return {};
}

}  // namespace

double signed_area_m2(const Ring& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - ring.front();
    const Vec2 b = ring[(i + 1) % ring.size()] - ring.front();
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2.0;
}

double area_m2(const Polygon& polygon) {
  double area = std::abs(signed_area_m2(polygon.outline));
  for (const Ring& hole : polygon.holes) area -= std::abs(signed_area_m2(hole));
  return area;
}

Box bounds_of(const Ring& ring) {
  Box box{ring.front(), ring.front()};
  for (const Vec2& p : ring) {
    box.lo = box.lo.cwiseMin(p);
    box.hi = box.hi.cwiseMax(p);
  }
  return box;
}

bool contains(const Ring& ring, const Vec2& point) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2& a = ring[i];
    const Vec2& b = ring[j];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

bool contains(const Polygon& polygon, const Vec2& point) {
  if (!contains(polygon.outline, point)) return false;
  for (const Ring& hole : polygon.holes) {
    if (contains(hole, point)) return false;
  }
  return true;
}

Vec2 rotated(const Vec2& p, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}

Polygon rotated(const Polygon& polygon, double angle_rad) {
  Polygon out = polygon;
  for (Vec2& p : out.outline) p = rotated(p, angle_rad);
  for (Ring& hole : out.holes) {
    for (Vec2& p : hole) p = rotated(p, angle_rad);
  }
  return out;
}

Result<Polygon> clean(const Polygon& raw) {
  std::size_t vertices = raw.outline.size();
  for (const Ring& hole : raw.holes) vertices += hole.size();
  if (vertices > kMaxPolygonVertices) {
    return bad_input("The polygon has " + std::to_string(vertices) + " vertices; at most 100000 are taken.");
  }
  if (const Status status = check_coordinates(raw.outline); !status) return status.error();
  for (const Ring& hole : raw.holes) {
    if (const Status status = check_coordinates(hole); !status) return status.error();
  }
  Polygon out;
  out.outline = simplified(raw.outline);
  if (out.outline.size() < 3 || std::abs(signed_area_m2(out.outline)) < kLeastRingArea_m2) {
    // A bow tie's halves cancel out: say what is really wrong with it.
    if (raw.outline.size() >= 4) {
      if (const Status status =
              detail::check_validity({out.outline.size() >= 3 ? out.outline : raw.outline, {}});
          !status && out.outline.size() >= 3) {
        return status.error();
      }
    }
    return bad_input("The outline has no area.");
  }
  if (signed_area_m2(out.outline) < 0.0) out.outline = Ring(out.outline.rbegin(), out.outline.rend());
  for (const Ring& hole : raw.holes) {
    Ring ring = simplified(hole);
    if (ring.size() < 3 || std::abs(signed_area_m2(ring)) < kLeastRingArea_m2) continue;
    if (signed_area_m2(ring) > 0.0) ring = Ring(ring.rbegin(), ring.rend());
    out.holes.push_back(std::move(ring));
  }
  if (const Status status = detail::check_validity(out); !status) return status.error();
  return out;
}

}  // namespace swallowtail::coverage
