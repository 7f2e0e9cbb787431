#pragma once

#include <span>

#include "planner/base/vec.hpp"
#include "planner/world/prisms.hpp"

namespace swallowtail::planner {

/// The robot's map of where it may drive is no finer.
inline constexpr double kOffNoDrive_m = 3.0;

/// Whether a place lies in one of the areas, or within kOffNoDrive_m of its border.
bool is_in_or_near(std::span<const Area> areas, const Vec2& place);

}  // namespace swallowtail::planner
