#pragma once

#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::coverage {

/// Vertices in order, local metres; the first is not repeated at the end.
using Ring = std::vector<Vec2>;

struct Polygon {
  Ring outline;
  std::vector<Ring> holes;
};

struct Box {
  Vec2 lo = Vec2::Zero();
  Vec2 hi = Vec2::Zero();
};

inline constexpr std::size_t kMaxPolygonVertices = 100'000;
inline constexpr double kRepeatedVertex_m = 1e-3;  ///< vertices nearer than this are one
inline constexpr double kCollinear_m =
    1e-4;  ///< a vertex nearer than this to the chord of its neighbours is left out

/// The same area without repeated, collinear and closing vertices and without spikes; the outline
/// counter-clockwise, holes clockwise; holes of no area left out. Errors (kBadInput), each named in the
/// message: a coordinate that is not finite or beyond 1e6 m, too many vertices, a ring of no area, a
/// self-intersection (with its place), a hole outside the outline or in another hole.
Result<Polygon> clean(const Polygon& raw);

/// Signed area of a ring: positive counter-clockwise.
double signed_area_m2(const Ring& ring);
/// Outline less holes, whichever way they run.
double area_m2(const Polygon& polygon);
Box bounds_of(const Ring& ring);
/// Even-odd, borders either way.
bool contains(const Polygon& polygon, const Vec2& point);
bool contains(const Ring& ring, const Vec2& point);
Polygon rotated(const Polygon& polygon, double angle_rad);
Vec2 rotated(const Vec2& point, double angle_rad);

}  // namespace swallowtail::coverage
