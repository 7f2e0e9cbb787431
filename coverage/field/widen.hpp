#pragma once

#include <span>
#include <vector>

#include "coverage/field/polygon.hpp"
#include "planner/base/result.hpp"

namespace swallowtail::coverage {

/// The union of the areas and of what lies nearer to them than `by_m` (corners stay corners), as clean
/// polygons; holes narrower than twice that close. Errors (kBadInput): an area that is not a valid polygon,
/// named by its place in the list.
Result<std::vector<Polygon>> widened(std::span<const Polygon> areas, double by_m);

}  // namespace swallowtail::coverage
