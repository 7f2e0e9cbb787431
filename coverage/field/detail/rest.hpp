#pragma once

#include <vector>

#include "coverage/field/detail/geos.hpp"
#include "coverage/field/detail/lines.hpp"
#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage::detail {

struct RestParams {
  double width_m = 10.0;       ///< of the sensor
  double piece_cost_m = 25.0;  ///< what one more piece costs, as metres of flight
  double allowed_m2 = 0.0;     ///< may stay uncovered
};

struct RestCover {
  std::vector<Segment> pieces;
  double uncovered_m2 = 0.0;
};

/// Lines inside the polygon from which the rest of it is seen that strips leave over: triangles along slanted
/// borders, rims beside holes, tips. Greedy by area seen per cost, over lines along the (simplified) border
/// and along each part's own axes. What no line inside can see stays uncovered. `rest` must be valid.
RestCover cover_rest(const Polygon& polygon, const Shape& rest, const RestParams& params);

}  // namespace swallowtail::coverage::detail
