#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace swallowtail::test {

/// Whether `value` keeps to `schema` (the part of JSON Schema 2020-12 that planner/scenario/schema.json uses;
/// any other word in a schema throws). `why` names the first thing that does not.
bool conforms(const nlohmann::json& schema, const nlohmann::json& value, std::string& why);

/// YAML text as JSON by the rules of YAML's core schema: plain numbers are numbers, everything quoted is
/// text. Throws what yaml-cpp throws; a key that stands twice keeps its first value.
nlohmann::json yaml_to_json(const std::string& text);

/// JSON as YAML text (which JSON is, but for words such as 1e999 and .nan that a text value may stand for).
std::string json_to_yaml(const nlohmann::json& value);

}  // namespace swallowtail::test
