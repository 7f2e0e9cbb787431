#pragma once

#include <memory>

#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/world/terrain.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::planner {

/// Builds the ground: reads the raster, or samples the mountains over the bounds. Errors: as read_terrain and
/// mountains_terrain.
Result<Terrain> load_terrain(const Scenario& scenario);

/// The world as it is at t = 0: terrain, the obstacles known at the start, bounds. Errors: as load_terrain
/// and World::make.
Result<std::shared_ptr<const World>> load_world(const Scenario& scenario);

/// Where the vehicle stands at t = 0: start_m, or on the ground at the charger's start.
Vec3 start_position_m(const Scenario& scenario, const Terrain& terrain);

}  // namespace swallowtail::planner
