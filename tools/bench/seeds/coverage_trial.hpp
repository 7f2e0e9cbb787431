#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "coverage/field/sub_cells.hpp"

namespace swallowtail::bench {

/// Whether sub-cells of one height are all linked, besides the X nearest [COV 4.1], or not [COV 5.5].
enum class Layers : std::uint8_t { kLinked, kNearestOnly };

/// The parameters of [COV 5.1] where nothing else is said: one unit of energy and of time for each metre
/// flown, nothing kept in reserve, the robot at a fifth of the aircraft's speed.
struct CoverageSetting {
  double d_max = 500.0;
  int levels = 20;     ///< k
  int neighbours = 5;  ///< X
  Layers layers = Layers::kLinked;
  double altitude_per_m = 0.0;  ///< consumption aloft grows by so much for each metre of height [COV 5.2]
  std::uint64_t iterations_most = 0;  ///< of the solver; 0: its own number
};

/// What the document's own method makes of it: the layered graph, its tour, its cost.
struct CoverageTrial {
  double cost = 0.0;    ///< infinite: no tour
  double cpu_ms = 0.0;  ///< to build the graph and to solve it
  int vertices = 0;
  std::size_t edges = 0;
  int recharges = 0;       ///< arcs of the tour that are not flown through
  int height_changes = 0;  ///< between sub-cells that follow each other
  /// The same order with the battery continuous and the robot's driving counted; infinite: cannot be flown.
  double scheduled_cost = 0.0;
};

/// Begins on the ground at the origin. Charging takes r = 2 per unit, landing 45 and taking off 5. Departs
/// from [COV] in what LayeredGraph departs in, and in the second that a stop to turn or to climb takes.
CoverageTrial run_coverage_trial(const std::vector<coverage::SubCell>& cells, const CoverageSetting& setting,
                                 std::uint64_t seed);

}  // namespace swallowtail::bench
