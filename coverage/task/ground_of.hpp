#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "coverage/field/polygon.hpp"
#include "coverage/ground/ground_travel.hpp"
#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/world/raster_file.hpp"

namespace swallowtail::coverage {

/// What a scenario's charger says of the ground in files.
struct RobotGround {
  std::vector<std::vector<Vec2>> roads;
  std::vector<Polygon> closed;  ///< clean
};
/// Errors: see read_roads and read_fields; a forbidden polygon that is not valid.
Result<RobotGround> read_robot_ground(const planner::ChargerSpec& charger,
                                      const std::optional<planner::GeoOrigin>& origin);

/// The ground robot's ways, as a scenario's charger has them; none for straight ones over open ground.
/// `ground` is where it may be, `origin` of the local frame. Errors: see read_robot_ground, RoadNetwork,
/// RoughGround.
Result<std::shared_ptr<const GroundTravel>> ground_of(const planner::ChargerSpec& charger, const Box& ground,
                                                      const std::optional<planner::GeoOrigin>& origin,
                                                      const planner::Terrain& terrain);

}  // namespace swallowtail::coverage
