#pragma once

#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage {

struct SweepParams {
  double sensor_width_m = 10.0;
  /// What one more piece to fly costs, as metres of flight; it weighs turns against length.
  double piece_cost_m = 25.0;
};

/// How many strips of at most one sensor width cover an extent: the last one is not missing, and all are
/// equally wide.
int strip_count(double extent_m, double sensor_width_m);

/// The direction to fly in, counter-clockwise from east, in [0, π): of the directions of the polygon's edges
/// and of its convex hull's edges the one whose strips' centre lines cost least within the polygon (length +
/// piece_cost_m each). The narrowest direction, which has the fewest strips, is always among them.
double best_sweep_rad(const Polygon& polygon, const SweepParams& params);

}  // namespace swallowtail::coverage
