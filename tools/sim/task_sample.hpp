#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coverage/field/sub_cells.hpp"
#include "idl/data/types.hpp"
#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::sim {

inline constexpr std::uint32_t kTaskId = 1;

struct TaskSample {
  data::CoverageTask task;  ///< without origin, start, seed and has_terrain
  std::optional<planner::GeoOrigin> origin;
  std::vector<coverage::Field> fields;    ///< of the task, cleaned
  std::vector<coverage::Polygon> no_fly;  ///< of the task, cleaned
  std::vector<std::string> refused;       ///< fields that no polygon can be made of, with the reason
};

/// All that a scenario's coverage asks for, as the wire carries it. Errors: fields, no-fly areas, roads or
/// closed ground that cannot be read or are not valid, no field that can be planned, more than the data
/// contract holds.
Result<TaskSample> task_sample(const planner::Scenario& scenario, const planner::Terrain& terrain);

}  // namespace swallowtail::sim
