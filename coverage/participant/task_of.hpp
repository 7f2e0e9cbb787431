#pragma once

#include <memory>

#include "coverage/ground/ground_travel.hpp"
#include "coverage/schedule/task.hpp"
#include "idl/data/types.hpp"
#include "planner/base/result.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::coverage {

/// Strips and transfers keep so far off no-fly areas: the planner, which certifies, asks for less.
inline constexpr double kOffNoFly_m = 0.05;

/// The task as the wire says it, which has passed data::validate; its no-fly areas are wider by kOffNoFly_m.
/// The ground robot's ways are left out (travel_of). Errors (kBadInput): a field or no-fly area that is not a
/// valid polygon, named.
Result<Task> task_of(const data::CoverageTask& task);

/// The ground robot's ways; none for straight ones over open ground. Errors: see RoadNetwork and RoughGround;
/// a no-drive area that is not a valid polygon.
Result<std::shared_ptr<const GroundTravel>> travel_of(const data::CoverageTask& task,
                                                      const planner::Terrain& terrain);

}  // namespace swallowtail::coverage
