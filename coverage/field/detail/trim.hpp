#pragma once

#include <vector>

#include "coverage/field/detail/lines.hpp"
#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage::detail {

struct TrimParams {
  double width_m = 10.0;    ///< that a piece sees
  double near_m = 10.0;     ///< width of the band that it is to see itself, if no other's does: ≤ width_m
  double allowed_m2 = 0.0;  ///< may become uncovered, of either width
};

/// Draws pieces in to what of the polygon they alone see, or alone see so near, and leaves out those that
/// others make needless, in order: shortest first. Returns what became uncovered of either width, m².
double trim(const Polygon& polygon, const TrimParams& params, std::vector<Segment>& pieces);

}  // namespace swallowtail::coverage::detail
