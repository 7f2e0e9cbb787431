#pragma once

#include <vector>

#include "tools/bench/plan/subject.hpp"

namespace swallowtail::bench {

/// OMPL with its default parameters in the box of the world, with our exact motion validator: RRTConnect and
/// what its path simplifier makes of the path, RRT*, InformedRRT*, BIT* and ABIT*. OMPL seeds all its random
/// numbers from one place, so runs wait for each other.
std::vector<Subject> ompl_subjects();

}  // namespace swallowtail::bench
