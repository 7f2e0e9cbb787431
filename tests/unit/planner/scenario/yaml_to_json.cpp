#include <cmath>
#include <cstdlib>

#include <yaml-cpp/yaml.h>

#include "tests/unit/planner/scenario/json_schema.hpp"

namespace swallowtail::test {
namespace {

nlohmann::json convert(const YAML::Node& node) {
  if (node.IsNull()) return nullptr;
  if (node.IsSequence()) {
    auto out = nlohmann::json::array();
    for (const auto& item : node) out.push_back(convert(item));
    return out;
  }
  if (node.IsMap()) {
    auto out = nlohmann::json::object();
    for (const auto& item : node) {
      if (!out.contains(item.first.Scalar())) out[item.first.Scalar()] = convert(item.second);
    }
    return out;
  }
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;
  if (text == "true" || text == "false") return text == "true";
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(number)) return text;
  if (number == std::floor(number) && std::abs(number) < 1e15) return static_cast<std::int64_t>(number);
  return number;
}

}  // namespace

nlohmann::json yaml_to_json(const std::string& text) { return convert(YAML::Load(text)); }

std::string json_to_yaml(const nlohmann::json& value) { return value.dump(); }

}  // namespace swallowtail::test
