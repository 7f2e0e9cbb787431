#pragma once

#include <utility>
#include <vector>

/// Judges a cover of the ground by looking at points only. Shares no code and no types with what it judges.
namespace swallowtail::test_support {

using Point = std::pair<double, double>;

struct Ground {
  std::vector<std::vector<Point>> rings;  ///< of one or more polygons and their holes, even-odd
};

struct FlownLine {
  Point from;
  Point to;
};

struct CoverVerdict {
  long points = 0;             ///< of the raster, on the ground asked for
  double covered_share = 0.0;  ///< of them, within half a width of a line and between its ends
  double outside_m = 0.0;      ///< of lines, flown more than `tolerance_m` away from the ground
  Point first_outside{0.0, 0.0};
};

struct CoverQuestion {
  double width_m = 10.0;
  double cell_m = 0.25;       ///< of the raster
  double step_m = 0.1;        ///< along lines
  double tolerance_m = 0.01;  ///< outside by less is inside
};

/// A raster of cell centres for what is covered, steps along the lines for what is flown outside.
CoverVerdict judge_cover(const Ground& ground, const std::vector<FlownLine>& lines,
                         const CoverQuestion& question);

/// Even-odd.
bool is_on(const Ground& ground, const Point& point);
double distance_to_border(const Ground& ground, const Point& point);

}  // namespace swallowtail::test_support
