#pragma once

#include <cstdint>

#include "coverage/field/polygon.hpp"

namespace swallowtail::bench {

struct HoledFieldParams {
  double side_m = 100.0;
  int holes = 15;
  int hole_corners = 64;     ///< of all holes, about
  double holes_share = 0.2;  ///< of the square's area, about, of the circles around the holes
};

/// A random field after the family on which coverage planners for polygons with obstacles are compared
/// [BAHNEMANN]: an outline of 11 corners around a square, and holes of 3 to 6 corners that keep clear of each
/// other and of the outline. A hole for which no place is found is left out.
coverage::Polygon holed_field(std::uint64_t seed, const HoledFieldParams& params = {});

}  // namespace swallowtail::bench
