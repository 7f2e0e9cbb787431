#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "coverage/field/detail/lines.hpp"
#include "coverage/field/polygon.hpp"

/// Ground as a set of small convex polygons, from which rectangles are taken away: quicker by orders than
/// general polygons, and as exact.
namespace swallowtail::coverage::detail {

/// A convex polygon of few corners, counter-clockwise.
struct Patch {
  static constexpr std::size_t kMostCorners = 12;
  Vec2 middle_m = Vec2::Zero();  ///< of a circle of radius_m around it
  double radius_m = 0.0;
  double area_m2 = 0.0;
  std::size_t size = 0;
  std::array<Vec2, kMostCorners> corners;
};

/// What is seen from a segment: half a width to each side.
struct Band {
  Line line;
  Interval along;
  double half_width_m = 0.0;
};
/// By the patch's circle.
inline bool may_meet(const Band& band, const Patch& patch) {
  const double at = band.line.along_of(patch.middle_m);
  return std::abs(band.line.left_of(patch.middle_m)) < band.half_width_m + patch.radius_m &&
         at + patch.radius_m > band.along.from && at - patch.radius_m < band.along.to;
}
/// As seen_from: kInside_m beyond the segment's ends.
Band band_of(const Segment& segment, double width_m);

/// A half-plane: the points with normal · p ≤ limit.
struct HalfPlane {
  Vec2 normal = Vec2::Zero();
  double limit = 0.0;
};
/// Whose intersection a band is.
using Planes = std::array<HalfPlane, 4>;
Planes planes_of(const Band& band);

/// The polygon as trapezoids between the heights of its vertices.
std::vector<Patch> patches_of(const Polygon& polygon);

/// Whether neither's directions leave a gap between the two.
bool may_meet(const Band& a, const Band& b);

/// What of the patches lies in the band.
std::vector<Patch> within(const std::vector<Patch>& patches, const Band& band);
/// What is left of a patch without the bands, added to `out`.
void add_remains(const Patch& patch, std::span<const Planes* const> bands, std::vector<Patch>& out);

/// Ground that is still to be seen. Patches keep their places: what a band cuts is closed, what is left of it
/// comes after all others, so that who has looked at the first of them need only look at the rest.
class OpenGround {
 public:
  explicit OpenGround(std::vector<Patch> patches);

  void subtract(const Band& band);
  const std::vector<Patch>& patches() const { return patches_; }
  bool is_open(std::size_t patch) const { return open_[patch] != 0; }
  double area_m2() const;
  /// False where the band meets none of the patches, by a circle around all.
  bool may_meet(const Band& band) const { return detail::may_meet(band, all_); }
  /// Of the open patches that the band may meet, told by their circles.
  double area_near(const Band& band) const;

 private:
  std::vector<Patch> patches_;
  std::vector<char> open_;
  Patch all_;  ///< no more than its circle
};

/// Area of a patch in the band and its extent along the line.
BandPart part_in_band(const Patch& patch, const Band& band);

double area_m2(const std::vector<Patch>& patches);

}  // namespace swallowtail::coverage::detail
