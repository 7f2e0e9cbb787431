#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "planner/base/result.hpp"

namespace swallowtail::swarm {

/// One tunable of an algorithm: what it is called on the command line, where it lives, what it may be, where
/// its default comes from.
struct Parameter {
  std::string_view name;
  std::variant<int*, double*> value;
  double min = 0.0;
  double max = 0.0;
  std::string_view source;

  double get() const;
  bool is_integer() const { return std::holds_alternative<int*>(value); }
};

/// The tunables of a params struct; they point into it.
using Parameters = std::vector<Parameter>;

/// Refuses a value out of range (or no number at all); the message names parameter, value and range.
Status check(const Parameters& parameters);

/// Sets one by name. Errors: no such name (the known ones are named), not a number, out of range.
Status set(const Parameters& parameters, std::string_view name, double value);

}  // namespace swallowtail::swarm
