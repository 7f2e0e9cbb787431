#pragma once

#include <optional>
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

struct Gap {
  double area_m2 = 0.0;
  Vec2 place_m = Vec2::Zero();  ///< in it
};

/// The largest connected part of the polygons that no swath covers; nothing when all is covered or GEOS
/// failed.
std::optional<Gap> largest_gap(std::span<const Polygon> polygons, std::span<const SubCell> sub_cells);

}  // namespace swallowtail::coverage
