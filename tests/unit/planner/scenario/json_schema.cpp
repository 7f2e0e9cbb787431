#include "tests/unit/planner/scenario/json_schema.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace swallowtail::test {
namespace {

using nlohmann::json;

class Checker {
 public:
  explicit Checker(const json& root) : root_(root) {}

  bool check(const json& schema, const json& value, const std::string& at) {
    for (const auto& [word, rule] : schema.items()) {
      if (!check_word(word, rule, schema, value, at)) {
        if (why_.empty()) why_ = at + " breaks " + word;
        return false;
      }
    }
    return true;
  }
  const std::string& why() const { return why_; }

 private:
  bool check_word(const std::string& word, const json& rule, const json& schema, const json& value,
                  const std::string& at) {
    static const std::set<std::string> kNotes = {"$schema", "$defs", "title", "description"};
    if (kNotes.contains(word)) return true;
    if (word == "$ref")
      return check(root_.at(json::json_pointer(rule.get<std::string>().substr(1))), value, at);
    if (word == "type") return is_of_type(rule, value);
    if (word == "const") return value == rule;
    if (word == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
    if (word == "oneOf") return check_one_of(rule, value, at);
    if (word == "minimum") return !value.is_number() || value.get<double>() >= rule.get<double>();
    if (word == "maximum") return !value.is_number() || value.get<double>() <= rule.get<double>();
    if (word == "exclusiveMinimum") return !value.is_number() || value.get<double>() > rule.get<double>();
    if (word == "minLength")
      return !value.is_string() || value.get<std::string>().size() >= rule.get<std::size_t>();
    if (word == "maxLength")
      return !value.is_string() || value.get<std::string>().size() <= rule.get<std::size_t>();
    if (word == "minItems") return !value.is_array() || value.size() >= rule.get<std::size_t>();
    if (word == "maxItems") return !value.is_array() || value.size() <= rule.get<std::size_t>();
    if (word == "items") return check_items(rule, value, at);
    if (word == "required") return check_required(rule, value);
    if (word == "properties") return check_properties(rule, value, at);
    if (word == "additionalProperties") return check_additional(rule, schema, value, at);
    throw std::logic_error("the test's schema checker does not know " + word);
  }

  static bool is_of_type(const json& rule, const json& value) {
    if (rule.is_array()) {
      for (const json& one : rule) {
        if (is_of_type(one, value)) return true;
      }
      return false;
    }
    const auto type = rule.get<std::string>();
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "number") return value.is_number();
    if (type == "integer") return value.is_number_integer();
    if (type == "boolean") return value.is_boolean();
    throw std::logic_error("unknown type " + type);
  }

  bool check_one_of(const json& rule, const json& value, const std::string& at) {
    int count = 0;
    for (const json& one : rule) {
      Checker inner(root_);
      if (inner.check(one, value, at)) ++count;
    }
    return count == 1;
  }

  bool check_items(const json& rule, const json& value, const std::string& at) {
    if (!value.is_array()) return true;
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (!check(rule, value[i], at + "[" + std::to_string(i) + "]")) return false;
    }
    return true;
  }

  static bool check_required(const json& rule, const json& value) {
    if (!value.is_object()) return true;
    for (const json& key : rule) {
      if (!value.contains(key.get<std::string>())) return false;
    }
    return true;
  }

  bool check_properties(const json& rule, const json& value, const std::string& at) {
    if (!value.is_object()) return true;
    for (const auto& [key, inner] : rule.items()) {
      if (value.contains(key) && !check(inner, value[key], at + "." + key)) return false;
    }
    return true;
  }

  bool check_additional(const json& rule, const json& schema, const json& value, const std::string& at) {
    if (!value.is_object()) return true;
    for (const auto& [key, inner] : value.items()) {
      if (schema.contains("properties") && schema["properties"].contains(key)) continue;
      if (rule == false) return false;
      if (!check(rule, inner, at + "." + key)) return false;
    }
    return true;
  }

  const json& root_;
  std::string why_;
};

}  // namespace

bool conforms(const json& schema, const json& value, std::string& why) {
  Checker checker(schema);
  const bool ok = checker.check(schema, value, "");
  why = checker.why();
  return ok;
}

}  // namespace swallowtail::test
