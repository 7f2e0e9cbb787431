#pragma once

#include "coverage/gtsp/solver.hpp"

namespace swallowtail::gtsp::proof {

/// After a search: raises the solution's lower bound within `work` elementary steps, and proves the tour best
/// or replaces it with the best where that succeeds. Leaves proved solutions alone. Instances of more than
/// kMaxWalkCells vertices × clusters get the bound of nearest_ways().
void settle(const Instance& instance, const Options& options, double work, Solution& solution);

/// Half of the cheapest ways into and out of one vertex of each cluster, summed: a lower bound on closed
/// tours without anything fixed. O(n·k) for instances of points, O(arcs) otherwise.
double nearest_ways(const Instance& instance);

}  // namespace swallowtail::gtsp::proof
