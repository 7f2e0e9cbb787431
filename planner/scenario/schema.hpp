#pragma once

#include <string_view>

namespace swallowtail::planner {

/// The JSON Schema (draft 2020-12) of scenario files, schema.json of this folder: the authority on keys,
/// types and ranges. What a schema cannot say (relations between keys, ids that repeat, files that must
/// exist) only the reader checks.
std::string_view scenario_schema();

}  // namespace swallowtail::planner
