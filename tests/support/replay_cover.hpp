#pragma once

#include <string>
#include <vector>

#include "tests/support/replay_oracle.hpp"

namespace swallowtail::test_support {

/// Fields not covered by lines at their height, and lines where none may be: outside their field (beyond a
/// slanted border where they see nothing of it, if the rules let them beyond), over holes and no-fly areas,
/// in a headland that is skipped, too near to the ground. `worst_share`: of the field that is covered least.
std::vector<std::string> faults_of_cover(const coverage::Task& task, const coverage::Plan& plan,
                                         const ReplayQuestion& question, double& worst_share);

/// Flights over a hole or no-fly area in which the way neither begins nor ends.
std::vector<std::string> faults_of_way(const coverage::Task& task, const std::vector<Vec3>& way);

/// Flights between legs of one field that leave it, where nothing but itself bounds it; on another, if they
/// begin and end on its border too.
std::vector<std::string> faults_of_way_inside(const coverage::Task& task, const std::vector<Vec3>& way);

}  // namespace swallowtail::test_support
