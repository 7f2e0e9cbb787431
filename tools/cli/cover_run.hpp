#pragma once

#include <vector>

#include "coverage/fleet/fleet.hpp"
#include "tools/cli/cover_answer.hpp"

namespace swallowtail::cli {

/// Plans one task: with one aircraft, or one entry for each of several. A plan that check_cover refuses is no
/// plan; without one there is a single entry, with the reason. `options` have a clock. Borrows `task`.
std::vector<Covered> cover_task(const coverage::Task& task, const planner::Terrain& terrain,
                                const coverage::PlanOptions& options, const coverage::FleetOptions& fleet);

}  // namespace swallowtail::cli
