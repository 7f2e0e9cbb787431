#pragma once

#include "planner/path/path.hpp"
#include "planner/scenario/scenario.hpp"

namespace swallowtail::cli {

/// Energy that a timed path takes: each segment by its time and the rate of how it is flown (up, down, level,
/// standing); a sloped one by the rate of its steeper part.
double energy_of(const planner::TimedPath& path, const planner::EnergyRates& rates);

}  // namespace swallowtail::cli
