#pragma once

namespace swallowtail::coverage {

/// What a change of direction costs between lines.
struct TurnCost {
  double stop_m = 8.0;        ///< of a stop, as metres of flight
  double turn_max_rad = 1.0;  ///< no stop is needed for less
};

}  // namespace swallowtail::coverage
