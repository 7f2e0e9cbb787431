#pragma once

#include <memory>
#include <optional>

#include "coverage/field/polygon.hpp"
#include "coverage/ground/ground_travel.hpp"
#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/world/raster_file.hpp"

namespace swallowtail::coverage {

/// The ground robot's ways, as a scenario's charger has them; none for straight ones over open ground.
/// `ground` is where it may be, `origin` of the local frame. Errors: see read_roads, RoadNetwork,
/// read_fields, RoughGround; a forbidden polygon that is not valid.
Result<std::shared_ptr<const GroundTravel>> ground_of(const planner::ChargerSpec& charger, const Box& ground,
                                                      const std::optional<planner::GeoOrigin>& origin,
                                                      const planner::Terrain& terrain);

}  // namespace swallowtail::coverage
