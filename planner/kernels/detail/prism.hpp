#pragma once

#include <vector>

#include "planner/world/obstacle.hpp"

namespace swallowtail::planner::detail {

/// Outward unit normals of half-spaces that bound an upright prism: of its faces, and bevelled so that
/// neighbours on the side are no more than 30° apart, and the rims cut at 45°. Empty where the mesh is no
/// such prism, or has more sides than are worth it.
std::vector<Vec3> prism_directions(const ConvexMesh& mesh);

}  // namespace swallowtail::planner::detail
