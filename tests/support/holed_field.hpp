#pragma once

#include <cstdint>

#include "tests/support/cover_oracle.hpp"

/// Random fields with holes, after the family on which coverage planners for polygons with obstacles are
/// compared [BAHNEMANN]: an outline of 11 corners around a square, and holes of 3 to 6 corners that keep
/// clear of each other and of the outline.
namespace swallowtail::test_support {

struct HoledFieldParams {
  double side_m = 100.0;
  int holes = 15;
  int hole_corners = 64;     ///< of all holes, about
  double holes_share = 0.2;  ///< of the square's area, about, of the circles around the holes
};

/// First the outline, then the holes.
Ground holed_field(std::uint64_t seed, const HoledFieldParams& params = {});

}  // namespace swallowtail::test_support
