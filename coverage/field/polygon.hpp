#pragma once

#include <string>
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

/// How much of its area a polygon may gain or lose by being made valid; more is refused.
inline constexpr double kRepairedShare = 0.005;

/// The same area without repeated, collinear and closing vertices and without spikes, as one polygon or,
/// where holes or the outline's own touch cut it through, as several; outlines counter-clockwise, holes
/// clockwise; holes and parts of no area left out. Small loops, holes that touch, overlap or stick out a
/// little are made valid. Errors (kBadInput), each named in the message with its place: a coordinate that is
/// not finite or beyond 1e6 m, too many vertices, an outline of no area, a polygon that could only be made
/// valid by changing more than kRepairedShare of its area (a bow tie, a hole outside the outline, holes in
/// holes).
Result<std::vector<Polygon>> clean(const Polygon& raw);

/// "(12.3, -4.5) m", for messages.
std::string place_text(const Vec2& place_m);

/// Signed area of a ring: positive counter-clockwise.
double signed_area_m2(const Ring& ring);
/// Outline less holes, whichever way they run.
double area_m2(const Polygon& polygon);
/// Of the vertices that are finite; none: a box of no size at the origin.
Box bounds_of(const Ring& ring);
/// Even-odd, borders either way.
bool contains(const Polygon& polygon, const Vec2& point);
bool contains(const Ring& ring, const Vec2& point);
/// To the nearest point of outline or holes, from either side.
double border_distance_m(const Polygon& polygon, const Vec2& point);
Polygon rotated(const Polygon& polygon, double angle_rad);
Vec2 rotated(const Vec2& point, double angle_rad);

}  // namespace swallowtail::coverage
