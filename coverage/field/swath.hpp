#pragma once

#include <span>
#include <vector>

#include "coverage/field/polygon.hpp"
#include "coverage/field/sub_cells.hpp"

namespace swallowtail::coverage {

/// The rectangle of ground that is seen when the sub-cell is flown: its centre line's length, half a swath to
/// each side, nothing beyond the ends.
Ring swath_of(const SubCell& sub_cell);

struct SwathArea {
  double covered_m2 = 0.0;
  double outside_m2 = 0.0;
};

/// What the union of the swaths covers of the polygons and beyond them, by polygon union. Errors (kInternal):
/// GEOS failed.
Result<SwathArea> swath_area(std::span<const Polygon> polygons, std::span<const SubCell> sub_cells);

}  // namespace swallowtail::coverage
