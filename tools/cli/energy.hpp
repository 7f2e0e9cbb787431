#pragma once

#include "coverage/energy/model.hpp"
#include "planner/path/path.hpp"

namespace swallowtail::cli {

/// Energy that a timed path takes: each segment by its time, its mean altitude and the power of its velocity;
/// with rates, a sloped one by the rate of its steeper part.
double energy_of(const planner::TimedPath& path, const coverage::EnergyModel& model);

}  // namespace swallowtail::cli
