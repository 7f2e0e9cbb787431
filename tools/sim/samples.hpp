#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coverage/field/sub_cells.hpp"
#include "idl/data/types.hpp"
#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/world/terrain.hpp"
#include "tools/sim/task_sample.hpp"

namespace swallowtail::sim {

inline constexpr std::uint32_t kTerrainMapId = 1;
inline constexpr int kTileSide = 120;  ///< samples; 57.6 kB of float

/// The ground as tiles of at most kTileSide × kTileSide samples, rows going north. None for a plane at z = 0,
/// which is what a task without terrain means; another plane becomes one small tile.
std::vector<data::TerrainTile> terrain_tiles(const planner::Terrain& terrain, const planner::Bounds& bounds,
                                             const data::GeoOrigin& origin);

data::Obstacle to_sample(const planner::Obstacle& obstacle, std::uint32_t revision);

/// What the scenario asks for. Fields that no polygon can be made of are left out with their reasons in
/// `refused`.
struct Mission {
  data::GeoOrigin origin;
  Vec3 start_m = Vec3::Zero();
  std::optional<data::CoverageTask> task;  ///< one of the two is there; a coverage goes before a goal
  std::optional<data::Goal> goal;
  std::vector<coverage::Field> fields;    ///< of the task, cleaned
  std::vector<coverage::Polygon> no_fly;  ///< of the task, cleaned
  std::vector<std::string> refused;
};

/// Errors: the fields, no-fly areas or the robot's ground cannot be read, none can be planned, more than the
/// data contract holds.
Result<Mission> make_mission(const planner::Scenario& scenario, const planner::Terrain& terrain,
                             std::uint64_t seed);

}  // namespace swallowtail::sim
