#pragma once

#include <optional>

#include "planner/base/vec.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::planner::detail {

/// Where a flight comes too near to the ground.
struct TerrainFault {
  double fraction = 0.0;  ///< along the segment
  double height_m = 0.0;  ///< above ground there
  double slope = 0.0;     ///< the steepest within the clearance
};

/// The first piece of a–b for which it cannot be shown that no ground lies within clearance_m; none if it can
/// for all. See certifier.hpp for the two conditions.
std::optional<TerrainFault> find_terrain_fault(const Terrain& terrain, const Vec3& a, const Vec3& b,
                                               double clearance_m);

}  // namespace swallowtail::planner::detail
