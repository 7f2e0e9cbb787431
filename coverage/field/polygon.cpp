#include "coverage/field/polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

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

Status check_coordinates(const Ring& ring, const std::string& name) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (is_finite(ring[i]) && ring[i].cwiseAbs().maxCoeff() <= kMaxCoordinate_m) continue;
    std::string message = "Vertex " + std::to_string(i) + " of " + name;
    if (i > 0) message += ", after " + place_text(ring[i - 1]) + ",";
    return bad_input(message + " is not finite or lies beyond 1e6 m.");
  }
  return {};
}

Ring turned_round(const Ring& ring) { return {ring.rbegin(), ring.rend()}; }

/// Without redundant vertices and rings of no area, every ring turned its way.
Polygon tidied(const Polygon& raw) {
  Polygon out;
  out.outline = simplified(raw.outline);
  if (out.outline.size() >= 3 && signed_area_m2(out.outline) < 0.0) out.outline = turned_round(out.outline);
  for (const Ring& hole : raw.holes) {
    Ring ring = simplified(hole);
    if (ring.size() < 3 || std::abs(signed_area_m2(ring)) < kLeastRingArea_m2) continue;
    out.holes.push_back(signed_area_m2(ring) > 0.0 ? turned_round(ring) : std::move(ring));
  }
  return out;
}

Result<std::vector<Polygon>> repaired(const Polygon& polygon, const detail::Fault& fault) {
  std::vector<Polygon> out;
  double area = 0.0;
  for (const Polygon& part : detail::Shape::repaired(polygon).parts()) {
    Polygon tidy = tidied(part);
    if (tidy.outline.size() < 3 || area_m2(tidy) < kLeastRingArea_m2) continue;
    area += area_m2(tidy);
    out.push_back(std::move(tidy));
  }
  const double meant = area_m2(polygon);
  const double outline = std::abs(signed_area_m2(polygon.outline));
  if (out.empty() || std::abs(area - meant) > kRepairedShare * outline) {
    return bad_input("The polygon is not valid: " + fault.what + " at " + place_text(fault.place_m) + ".");
  }
  return out;
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
  const auto first = std::find_if(ring.begin(), ring.end(), [](const Vec2& p) { return is_finite(p); });
  if (first == ring.end()) return {};
  Box box{*first, *first};
  for (const Vec2& p : ring) {
    if (!is_finite(p)) continue;
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

double border_distance_m(const Polygon& polygon, const Vec2& p) {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Vec2 edge = ring[i] - ring[j];
      const double t = std::clamp((p - ring[j]).dot(edge) / std::max(edge.squaredNorm(), 1e-18), 0.0, 1.0);
      least = std::min(least, (p - ring[j] - t * edge).norm());
    }
  };
  look(polygon.outline);
  for (const Ring& hole : polygon.holes) look(hole);
  return least;
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

std::string place_text(const Vec2& place_m) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "(%.2f, %.2f) m", place_m.x(), place_m.y());
  return text.data();
}

Result<std::vector<Polygon>> clean(const Polygon& raw) {
  std::size_t vertices = raw.outline.size();
  for (const Ring& hole : raw.holes) vertices += hole.size();
  if (vertices > kMaxPolygonVertices) {
    return bad_input("The polygon has " + std::to_string(vertices) + " vertices; at most 100000 are taken.");
  }
  if (const Status status = check_coordinates(raw.outline, "the outline"); !status) return status.error();
  for (std::size_t i = 0; i < raw.holes.size(); ++i) {
    const Status status = check_coordinates(raw.holes[i], "hole " + std::to_string(i));
    if (!status) return status.error();
  }
  if (raw.outline.empty()) return bad_input("The polygon is empty: its outline has no vertex.");
  const Polygon polygon = tidied(raw);
  const std::string no_area = "The outline has no area at " + place_text(raw.outline.front()) + ".";
  if (polygon.outline.size() < 3) return bad_input(no_area);
  if (const auto fault = detail::find_fault(polygon)) return repaired(polygon, *fault);
  if (std::abs(signed_area_m2(polygon.outline)) < kLeastRingArea_m2) return bad_input(no_area);
  return std::vector<Polygon>{polygon};
}

}  // namespace swallowtail::coverage
