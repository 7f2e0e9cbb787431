#include "planner/scenario/errors.hpp"

namespace swallowtail::planner {

std::string ScenarioError::text() const {
  std::string out = file + ":" + std::to_string(line) + ": ";
  if (!key.empty()) out += key + ": ";
  if (!value.empty()) out += value + ": ";
  return out + rule;
}

const char* name(ScenarioError::Kind kind) {
  switch (kind) {
    case ScenarioError::Kind::kType:
      return "type";
    case ScenarioError::Kind::kUnknownKey:
      return "unknown_key";
    case ScenarioError::Kind::kMissingKey:
      return "missing_key";
    case ScenarioError::Kind::kNotFinite:
      return "not_finite";
    case ScenarioError::Kind::kRange:
      return "range";
    case ScenarioError::Kind::kSyntax:
      return "syntax";
    case ScenarioError::Kind::kRelation:
      return "relation";
    case ScenarioError::Kind::kDuplicate:
      return "duplicate";
    case ScenarioError::Kind::kFile:
      return "file";
  }
  return "unknown";
}

std::string ScenarioErrors::text() const {
  std::string out;
  for (const ScenarioError& error : errors) out += error.text() + "\n";
  return out;
}

}  // namespace swallowtail::planner
