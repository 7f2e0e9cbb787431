#pragma once

#include <optional>
#include <vector>

#include "coverage/field/sub_cells.hpp"
#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"

namespace swallowtail::coverage {

struct ScenarioFields {
  std::vector<Field> fields;  ///< chosen, in the scenario's local frame, moved to place_at_m
  std::optional<planner::GeoOrigin>
      origin;  ///< of that frame: the scenario's, else the file's own; none when the file is in local metres
  std::vector<Polygon> no_fly{};  ///< of the same file and of the scenario's no_fly, in the same frame
};

/// The fields a scenario's coverage asks for. Errors: no coverage section, as read_fields, a field id that
/// the file does not have.
Result<ScenarioFields> fields_of(const planner::Scenario& scenario);

/// How they are to be flown.
FieldRules rules_of(const planner::CoverageSpec& spec);

}  // namespace swallowtail::coverage
