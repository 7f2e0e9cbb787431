#pragma once

#include <vector>

#include "coverage/field/polygon.hpp"

/// Straight lines through polygons and what a sensor sees from them.
namespace swallowtail::coverage::detail {

/// Positive where b is left of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

struct Segment {
  Vec2 from_m = Vec2::Zero();
  Vec2 to_m = Vec2::Zero();
  int strip = -1;  ///< that it belongs to; −1: none

  double length_m() const { return (to_m - from_m).norm(); }
};

/// A stretch of a line, by distance from the line's origin.
struct Interval {
  double from = 0.0;
  double to = 0.0;
};

/// A directed line; `along` has unit length, left of it is positive.
struct Line {
  Vec2 origin_m = Vec2::Zero();
  Vec2 along = Vec2(1.0, 0.0);

  double along_of(const Vec2& p) const { return (p - origin_m).dot(along); }
  double left_of(const Vec2& p) const {
    const Vec2 to = p - origin_m;
    return along.x() * to.y() - along.y() * to.x();
  }
  Vec2 at(double s) const { return origin_m + s * along; }
  Segment piece(const Interval& interval, int strip = -1) const {
    return {at(interval.from), at(interval.to), strip};
  }
};
/// Through `from` towards `to`, which must differ.
Line line_through(const Vec2& from, const Vec2& to);

/// Ends of lines stay so far inside the border, so that rounding takes none outside.
inline constexpr double kInside_m = 1e-3;

/// Where the line runs inside the polygon, in order; stretches shorter than 2 cm are left out, the ends of
/// the others drawn in by kInside_m.
std::vector<Interval> inside_of(const Polygon& polygon, const Line& line);

/// The same, by where the line crosses the polygon's rings.
std::vector<Interval> inside_between(std::vector<double> crossings);

/// The rectangle that is seen from a segment: half a width to each side, kInside_m beyond the ends.
Ring seen_from(const Segment& segment, double width_m);

/// What of a polygon lies within a band of a line: its area and its extent along the line.
struct BandPart {
  double area_m2 = 0.0;
  Interval extent;
};
/// `half_width` to each side, between from and to along the line. Exact for any simple rings.
BandPart part_in_band(const Polygon& polygon, const Line& line, const Interval& within, double half_width);

}  // namespace swallowtail::coverage::detail
