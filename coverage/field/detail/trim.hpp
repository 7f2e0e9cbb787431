#pragma once

#include <vector>

#include "coverage/field/detail/lines.hpp"
#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage::detail {

struct TrimParams {
  double width_m = 10.0;
  double allowed_m2 = 0.0;  ///< may become uncovered
};

/// Draws pieces in to what of the polygon they alone see and leaves out those that others make needless, in
/// order: shortest first. Returns what became uncovered, m².
double trim(const Polygon& polygon, const TrimParams& params, std::vector<Segment>& pieces);

}  // namespace swallowtail::coverage::detail
