#pragma once

#include <vector>

#include "tools/bench/plan/subject.hpp"

namespace swallowtail::bench {

/// pagmo's pso, bee_colony, gaco, cmaes and nspso with their default parameters and 200 individuals, on the
/// variables, the box and the cost of the preset "default" (length and violation as two objectives for
/// nspso). A candidate is evaluated by the same kernels as ours, its hops eight at a time. One that stops by
/// itself begins again with a new population until its time is over.
std::vector<Subject> pagmo_subjects();

}  // namespace swallowtail::bench
