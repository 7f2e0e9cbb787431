#include "planner/scenario/detail/section.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace swallowtail::planner::detail {
namespace {

using Kind = ScenarioError::Kind;

std::string number_text(double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return error == std::errc() ? std::string(buffer, end) : "?";
}

std::string range_rule(Range range, std::string_view noun) {
  const bool has_max = range.max < std::numeric_limits<double>::max();
  const bool has_min = range.min > -std::numeric_limits<double>::max();
  std::string rule = "must be " + std::string(noun);
  if (has_min) rule += (range.above_min ? " above " : " of at least ") + number_text(range.min);
  if (has_min && has_max) rule += " and at most " + number_text(range.max);
  if (!has_min && has_max) rule += " of at most " + number_text(range.max);
  return rule;
}

bool is_inside(double value, Range range) {
  return value <= range.max && (range.above_min ? value > range.min : value >= range.min);
}

bool is_word_for_non_finite(std::string_view text) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  if (!text.empty() && text.front() == '.') text.remove_prefix(1);
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower == "inf" || lower == "nan" || lower == "infinity";
}

/// The whole scalar as a number of the YAML core schema (decimal only).
std::optional<double> to_number(const RawNode& node) {
  if (node.kind != RawNode::Kind::kScalar || node.quoted) return std::nullopt;
  std::string_view text = node.scalar;
  if (text.size() > 1 && text.front() == '+' && text[1] != '-')
    text.remove_prefix(1);  // from_chars knows no plus
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  if (error != std::errc()) return std::nullopt;
  if (!std::isfinite(value)) return std::nullopt;  // "inf" and "nan" are told apart by the caller
  return value;
}

bool is_truth_word(std::string_view text) {
  return text == "true" || text == "false" || text == "True" || text == "False" || text == "TRUE" ||
         text == "FALSE";
}

/// Quoted, or plain and nothing else in YAML's core schema.
bool is_text(const RawNode& node) {
  return node.kind == RawNode::Kind::kScalar &&
         (node.quoted ||
          !(to_number(node) || is_word_for_non_finite(node.scalar) || is_truth_word(node.scalar)));
}

/// A number's unit is the last word of its key.
std::string_view stem_of(std::string_view key) {
  const std::size_t at = key.rfind('_');
  return at == std::string_view::npos ? key : key.substr(0, at);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::string unknown_key_rule(std::string_view key, const std::set<std::string, std::less<>>& known) {
  for (const std::string& candidate : known) {
    const bool has_unit = candidate.find('_') != std::string::npos;
    if (has_unit && (stem_of(candidate) == key || stem_of(candidate) == stem_of(key))) {
      return "is an unknown key: wrong or missing unit, it is " + candidate;
    }
  }
  for (const std::string& candidate : known) {
    if (key.size() < 40 && edit_distance(candidate, key) <= 2)
      return "is an unknown key; " + candidate + " is meant?";
  }
  std::string all;
  for (const std::string& candidate : known) all += (all.empty() ? "" : ", ") + candidate;
  return "is an unknown key; known are " + all;
}

}  // namespace

void ErrorLog::add(Kind kind, int line, std::string key, std::string value, std::string rule) {
  errors_.push_back({kind, file_, line, std::move(key), std::move(value), std::move(rule)});
}

ScenarioErrors ErrorLog::take() {
  std::ranges::stable_sort(errors_, {}, &ScenarioError::line);
  return {std::exchange(errors_, {})};
}

Section::Section(const RawNode& node, std::string path, ErrorLog& log)
    : node_(&node), path_(std::move(path)), log_(&log), is_map_(node.kind == RawNode::Kind::kMap) {
  if (!is_map_) {
    log_->add(Kind::kType, node.line, path_, shown(node), "must be a map of keys");
    return;
  }
  std::set<std::string_view> seen;
  for (std::size_t i = 0; i < node.keys.size(); ++i) {
    if (!seen.insert(node.keys[i]).second) {
      log_->add(Kind::kDuplicate, node.key_lines[i], path_of(node.keys[i]), shown(node.items[i]),
                "stands twice in its map");
    }
  }
}

std::string Section::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

const RawNode* Section::raw(std::string_view key, Need need) {
  asked_.emplace(key);
  if (!is_map_) return nullptr;
  const auto it = std::ranges::find(node_->keys, key);
  if (it != node_->keys.end()) return &node_->items[static_cast<std::size_t>(it - node_->keys.begin())];
  if (need == Need::kRequired) log_->add(Kind::kMissingKey, node_->line, path_of(key), "", "is missing");
  return nullptr;
}

bool Section::has(std::string_view key) { return raw(key, Need::kOptional) != nullptr; }

int Section::line_of(std::string_view key) const {
  const auto it = std::ranges::find(node_->keys, key);
  return it == node_->keys.end() ? node_->line
                                 : node_->key_lines[static_cast<std::size_t>(it - node_->keys.begin())];
}

bool Section::read_number(const RawNode& node, const std::string& path, Range range, ErrorLog& log,
                          double& out) {
  const std::optional<double> value = to_number(node);
  if (!value) {
    const bool non_finite =
        node.kind == RawNode::Kind::kScalar && !node.quoted && is_word_for_non_finite(node.scalar);
    log.add(non_finite ? Kind::kNotFinite : Kind::kType, node.line, path, shown(node),
            non_finite ? "must be finite" : range_rule(range, "a number"));
    return false;
  }
  if (!std::isfinite(*value)) {
    log.add(Kind::kNotFinite, node.line, path, shown(node), "must be finite");
    return false;
  }
  if (!is_inside(*value, range)) {
    log.add(Kind::kRange, node.line, path, shown(node), range_rule(range, "a number"));
    return false;
  }
  out = *value;
  return true;
}

bool Section::read_vector(const RawNode& node, const std::string& path, Range range, ErrorLog& log,
                          std::size_t count, double* out) {
  if (node.kind != RawNode::Kind::kList || node.items.size() != count) {
    log.add(Kind::kType, node.line, path, shown(node),
            count == 2 ? "must be a list [x, y]" : "must be a list [x, y, z]");
    return false;
  }
  bool ok = true;
  for (std::size_t i = 0; i < count; ++i) {
    ok = read_number(node.items[i], path + "[" + std::to_string(i) + "]", range, log, out[i]) && ok;
  }
  return ok;
}

bool Section::number(std::string_view key, Need need, Range range, double& out) {
  const RawNode* node = raw(key, need);
  return node != nullptr && read_number(*node, path_of(key), range, *log_, out);
}

bool Section::number(std::string_view key, Need need, Range range, std::optional<double>& out) {
  double value = 0.0;
  if (!number(key, need, range, value)) return false;
  out = value;
  return true;
}

bool Section::angle_deg(std::string_view key, Need need, Range range_deg, double& out_rad) {
  double value_deg = 0.0;
  if (!number(key, need, range_deg, value_deg)) return false;
  out_rad = value_deg * std::numbers::pi / 180.0;
  return true;
}

bool Section::integer(std::string_view key, Need need, Range range, std::uint32_t& out) {
  const RawNode* node = raw(key, need);
  if (node == nullptr) return false;
  const std::optional<double> value = to_number(*node);
  if (!value || !std::isfinite(*value) || *value != std::floor(*value)) {
    log_->add(Kind::kType, node->line, path_of(key), shown(*node), range_rule(range, "a whole number"));
    return false;
  }
  if (!is_inside(*value, range)) {
    log_->add(Kind::kRange, node->line, path_of(key), shown(*node), range_rule(range, "a whole number"));
    return false;
  }
  out = static_cast<std::uint32_t>(*value);
  return true;
}

bool Section::integer(std::string_view key, Need need, Range range, int& out) {
  std::uint32_t value = 0;
  if (!integer(key, need, range, value)) return false;
  out = static_cast<int>(value);
  return true;
}

bool Section::text(std::string_view key, Need need, std::string& out) {
  const RawNode* node = raw(key, need);
  if (node == nullptr) return false;
  constexpr std::size_t kMaxText = 200;
  if (!is_text(*node) || node->scalar.empty() || node->scalar.size() > kMaxText) {
    log_->add(is_text(*node) ? Kind::kRange : Kind::kType, node->line, path_of(key), shown(*node),
              "must be text of 1 to 200 bytes (in quotes if it looks like a number)");
    return false;
  }
  out = node->scalar;
  return true;
}

bool Section::choice(std::string_view key, Need need, std::initializer_list<std::string_view> allowed,
                     std::string& out) {
  const RawNode* node = raw(key, need);
  if (node == nullptr) return false;
  if (node->kind == RawNode::Kind::kScalar &&
      std::ranges::find(allowed, std::string_view(node->scalar)) != allowed.end()) {
    out = node->scalar;
    return true;
  }
  std::string names;
  for (const std::string_view name : allowed) names += (names.empty() ? "" : ", ") + std::string(name);
  log_->add(node->kind == RawNode::Kind::kScalar ? Kind::kRange : Kind::kType, node->line, path_of(key),
            shown(*node), "must be one of " + names);
  return false;
}

bool Section::vector(std::string_view key, Need need, Range range, Vec2& out) {
  const RawNode* node = raw(key, need);
  Vec2 value = Vec2::Zero();
  if (node == nullptr || !read_vector(*node, path_of(key), range, *log_, 2, value.data())) return false;
  out = value;
  return true;
}

bool Section::vector(std::string_view key, Need need, Range range, Vec3& out) {
  const RawNode* node = raw(key, need);
  Vec3 value = Vec3::Zero();
  if (node == nullptr || !read_vector(*node, path_of(key), range, *log_, 3, value.data())) return false;
  out = value;
  return true;
}

bool Section::numbers_by_name(std::string_view key, Need need, Range range,
                              std::vector<std::pair<std::string, double>>& out) {
  const RawNode* node = raw(key, need);
  if (node == nullptr) return false;
  const Section names(*node, path_of(key), *log_);
  if (!names.is_map()) return false;
  bool ok = true;
  for (std::size_t i = 0; i < node->keys.size(); ++i) {
    double value = 0.0;
    ok = read_number(node->items[i], names.path_of(node->keys[i]), range, *log_, value) && ok;
    out.emplace_back(node->keys[i], value);
  }
  return ok;
}

std::vector<Section::Item> Section::list(std::string_view key, Need need, std::size_t min_count,
                                         std::size_t max_count) {
  const RawNode* node = raw(key, need);
  if (node == nullptr) return {};
  const bool is_list = node->kind == RawNode::Kind::kList;
  if (!is_list || node->items.size() < min_count || node->items.size() > max_count) {
    log_->add(
        is_list ? Kind::kRange : Kind::kType, node->line, path_of(key), shown(*node),
        "must be a list of " + std::to_string(min_count) + " to " + std::to_string(max_count) + " items");
    return {};
  }
  std::vector<Item> items;
  for (std::size_t i = 0; i < node->items.size(); ++i) {
    items.push_back({&node->items[i], path_of(key) + "[" + std::to_string(i) + "]"});
  }
  return items;
}

std::size_t Section::count(std::string_view key) {
  const RawNode* node = raw(key, Need::kOptional);
  return node != nullptr && node->kind == RawNode::Kind::kList ? node->items.size() : 0;
}

std::optional<Section> Section::section(std::string_view key, Need need) {
  const RawNode* node = raw(key, need);
  if (node == nullptr) return std::nullopt;
  return Section(*node, path_of(key), *log_);
}

void Section::fail(Kind kind, std::string_view key, std::string rule) {
  const auto it = std::ranges::find(node_->keys, key);
  const std::string value =
      it == node_->keys.end() ? "" : shown(node_->items[static_cast<std::size_t>(it - node_->keys.begin())]);
  log_->add(kind, line_of(key), key.empty() ? path_ : path_of(key), value, std::move(rule));
}

void Section::finish() {
  for (std::size_t i = 0; i < node_->keys.size(); ++i) {
    if (!asked_.contains(node_->keys[i])) {
      log_->add(Kind::kUnknownKey, node_->key_lines[i], path_of(node_->keys[i]), shown(node_->items[i]),
                unknown_key_rule(node_->keys[i], asked_));
    }
  }
}

}  // namespace swallowtail::planner::detail
