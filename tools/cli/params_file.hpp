#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/swarm/registry.hpp"

namespace swallowtail::cli {

/// An optimiser's parameters as a user gives them; what is empty keeps its default.
struct ChosenParams {
  std::string algorithm;
  std::optional<int> midpoints;
  swarm::Settings settings;
};

/// The document of `tune`: `algorithm`, `midpoints`, `parameters: {name: number}`; other keys are passed
/// over. Nothing in it is trusted. Errors (kBadInput) name the file and the rule.
Result<ChosenParams> read_params(const std::string& path);

/// "key=value" with a number. Errors name the text and the rule.
Result<std::pair<std::string, double>> parse_setting(const std::string& text);

}  // namespace swallowtail::cli
