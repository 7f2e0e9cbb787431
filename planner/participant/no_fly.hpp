#pragma once

#include <vector>

#include "idl/data/types.hpp"
#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"
#include "planner/world/prisms.hpp"

namespace swallowtail::planner {

/// The task's areas of one kind, in its order.
std::vector<Area> areas_of(const data::CoverageTask& task, data::AreaKind kind);

/// Certified paths keep so far off no-fly areas, less than coverage plans do; radius and margin of the
/// vehicle count for nothing there, because strips end at their borders.
inline constexpr double kOffNoFly_m = 0.02;
inline constexpr std::size_t kMaxNoFlyParts = 8192;

/// The task's no-fly areas as convex polygons. Errors (kBadInput): an area that is not a valid polygon, one
/// wider than 1e5 m, more than kMaxNoFlyParts parts.
Result<std::vector<std::vector<Vec2>>> no_fly_parts(const data::CoverageTask& task);

}  // namespace swallowtail::planner
