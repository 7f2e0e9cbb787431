#pragma once

#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::planner {

/// Vertices in order, local metres; the first is not repeated at the end.
struct Area {
  std::vector<Vec2> outline;
  std::vector<std::vector<Vec2>> holes;
};

/// Convex polygons of at most kMaxPrismCorners corners, counter-clockwise, that make up the area and do not
/// overlap beyond their borders: GEOS' constrained Delaunay triangulation, its triangles joined while they
/// stay convex [HERTEL-MEHLHORN]. Errors (kBadInput): an area that is not a valid polygon.
Result<std::vector<std::vector<Vec2>>> convex_parts(const Area& area);
inline constexpr std::size_t kMaxPrismCorners = 64;

}  // namespace swallowtail::planner
