#include "planner/swarm/parameter.hpp"

#include <cmath>
#include <sstream>

#include "planner/base/checks.hpp"

namespace swallowtail::swarm {
namespace {

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

Status check_value(const Parameter& parameter, double value) {
  if (is_within(value, parameter.min, parameter.max)) return {};
  return bad_input("The parameter '" + std::string(parameter.name) + "' is " + text(value) + "; it must be " +
                   text(parameter.min) + " to " + text(parameter.max) + ".");
}

}  // namespace

double Parameter::get() const {
  return std::visit([](const auto* v) { return static_cast<double>(*v); }, value);
}

Status check(const Parameters& parameters) {
  for (const Parameter& parameter : parameters) {
    if (Status status = check_value(parameter, parameter.get()); !status) return status;
  }
  return {};
}

Status set(const Parameters& parameters, std::string_view name, double value) {
  std::string known;
  for (const Parameter& parameter : parameters) {
    known += (known.empty() ? "" : ", ") + std::string(parameter.name);
    if (parameter.name != name) continue;
    if (Status status = check_value(parameter, value); !status) return status;
    if (auto* const* integer = std::get_if<int*>(&parameter.value)) {
      if (value != std::floor(value)) {
        return bad_input("The parameter '" + std::string(name) + "' is " + text(value) +
                         "; it must be a whole number.");
      }
      **integer = static_cast<int>(value);
    } else {
      *std::get<double*>(parameter.value) = value;
    }
    return {};
  }
  return bad_input("There is no parameter '" + std::string(name) + "'; known are: " + known + ".");
}

}  // namespace swallowtail::swarm
