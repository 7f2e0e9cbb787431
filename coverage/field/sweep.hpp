#pragma once

#include <vector>

#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage {

struct SweepParams {
  double sensor_width_m = 10.0;
  double spacing_m = 10.0;  ///< of strips; at most the sensor's width
  /// What one more piece to fly costs, as metres of flight; it weighs turns against length.
  double piece_cost_m = 25.0;
};

/// How many strips at most `spacing_m` wide cover an extent: the last one is not missing, and all are
/// equally wide.
int strip_count(double extent_m, double spacing_m);

/// Directions to fly in, counter-clockwise from east, in [0, π), the one expected to cost least first, at
/// most `count`: of the directions of the polygon's edges and of its convex hull's edges. A direction costs
/// the length of its strips' centre lines within the polygon, piece_cost_m each, and piece_cost_m for each
/// straight stretch of border that is so slanted that it will need a line of its own. The narrowest
/// direction, which has the fewest strips, is always among those weighed.
std::vector<double> best_sweeps_rad(const Polygon& polygon, const SweepParams& params, std::size_t count);

}  // namespace swallowtail::coverage
