#pragma once

#include <string>
#include <utility>
#include <variant>

#include "planner/scenario/errors.hpp"
#include "planner/scenario/scenario.hpp"

namespace swallowtail::planner {

/// A scenario or everything that is wrong with its file.
class [[nodiscard]] ScenarioResult {
 public:
  ScenarioResult(Scenario scenario) : state_(std::move(scenario)) {}    // NOLINT(google-explicit-constructor)
  ScenarioResult(ScenarioErrors errors) : state_(std::move(errors)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }
  const Scenario& value() const& { return std::get<0>(state_); }
  Scenario&& value() && { return std::get<0>(std::move(state_)); }
  const Scenario& operator*() const& { return value(); }
  const Scenario* operator->() const { return &value(); }
  const ScenarioErrors& errors() const { return std::get<1>(state_); }

 private:
  std::variant<Scenario, ScenarioErrors> state_;
};

/// Reads and validates a scenario file in three steps: text, raw tree with line numbers, typed structs. All
/// errors at once: a key that is unknown, missing, of the wrong type or unit, not finite, out of range or at
/// odds with another; an id used twice; a named file that is not there. A file of more than 8 MB, or one with
/// aliases or tags, is refused.
ScenarioResult read_scenario(const std::string& path);

/// The same of a text in memory; files that it names are looked for in `folder`, errors carry `file`.
ScenarioResult parse_scenario(const std::string& text, const std::string& file, const std::string& folder);

}  // namespace swallowtail::planner
