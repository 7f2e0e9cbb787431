#pragma once

#include <array>
#include <vector>

#include "coverage/field/detail/lines.hpp"
#include "coverage/field/polygon.hpp"

/// Ground as a set of small convex polygons, from which rectangles are taken away: quicker by orders than
/// general polygons, and as exact.
namespace swallowtail::coverage::detail {

/// A convex polygon of few corners, counter-clockwise.
struct Patch {
  static constexpr std::size_t kMostCorners = 12;
  std::array<Vec2, kMostCorners> corners;
  std::size_t size = 0;
  Vec2 middle_m = Vec2::Zero();
  double radius_m = 0.0;
  double area_m2 = 0.0;
};

/// What is seen from a segment: half a width to each side.
struct Band {
  Line line;
  Interval along;
  double half_width_m = 0.0;
};
/// As seen_from: kInside_m beyond the segment's ends.
Band band_of(const Segment& segment, double width_m);

/// The polygon as trapezoids between the heights of its vertices.
std::vector<Patch> patches_of(const Polygon& polygon);

/// What of the patches lies in the band.
std::vector<Patch> within(const std::vector<Patch>& patches, const Band& band);
/// Takes the band away from the patches.
void subtract(const Band& band, std::vector<Patch>& patches);

/// Area of a patch in the band and its extent along the line.
BandPart part_in_band(const Patch& patch, const Band& band);

double area_m2(const std::vector<Patch>& patches);

}  // namespace swallowtail::coverage::detail
