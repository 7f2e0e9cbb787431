#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/vec.hpp"
#include "planner/scenario/detail/raw_tree.hpp"
#include "planner/scenario/errors.hpp"

namespace swallowtail::planner::detail {

enum class Need { kRequired, kOptional };

/// Closed interval, or open below.
struct Range {
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
  bool above_min = false;  ///< the value must be greater than min
};
inline constexpr Range from_to(double min, double max) { return {min, max, false}; }
inline constexpr Range above_to(double min, double max) { return {min, max, true}; }

/// Collects errors of one file.
class ErrorLog {
 public:
  explicit ErrorLog(std::string file) : file_(std::move(file)) {}
  void add(ScenarioError::Kind kind, int line, std::string key, std::string value, std::string rule);
  bool empty() const { return errors_.empty(); }
  /// Sorted by line; leaves the log empty.
  ScenarioErrors take();

 private:
  std::string file_;
  std::vector<ScenarioError> errors_;
};

/// A map of the file being read key by key. Each read writes its target only when the value is right and logs
/// an error when it is not; `finish` logs the keys that nobody asked for.
class Section {
 public:
  /// `node` must outlive the section. A node that is no map is logged and then reads as an empty one without
  /// further errors.
  Section(const RawNode& node, std::string path, ErrorLog& log);

  bool is_map() const { return is_map_; }
  int line() const { return node_->line; }
  /// Line of the value of a key that is there, else of the map.
  int line_of(std::string_view key) const;
  std::string path_of(std::string_view key) const;
  bool has(std::string_view key);

  bool number(std::string_view key, Need need, Range range, double& out);
  bool number(std::string_view key, Need need, Range range, std::optional<double>& out);
  bool angle_deg(std::string_view key, Need need, Range range_deg, double& out_rad);
  bool integer(std::string_view key, Need need, Range range, std::uint32_t& out);
  bool integer(std::string_view key, Need need, Range range, int& out);
  bool text(std::string_view key, Need need, std::string& out);
  bool choice(std::string_view key, Need need, std::initializer_list<std::string_view> allowed,
              std::string& out);
  /// Lists of two or three numbers, each within `range`.
  bool vector(std::string_view key, Need need, Range range, Vec2& out);
  bool vector(std::string_view key, Need need, Range range, Vec3& out);
  /// Numbers under free names.
  bool numbers_by_name(std::string_view key, Need need, Range range,
                       std::vector<std::pair<std::string, double>>& out);
  /// Node and path of each item; empty when the key is not there or is no list.
  struct Item {
    const RawNode* node = nullptr;
    std::string path;
  };
  std::vector<Item> list(std::string_view key, Need need, std::size_t min_count, std::size_t max_count);
  /// Items of the list at `key`, 0 when there is none.
  std::size_t count(std::string_view key);
  std::optional<Section> section(std::string_view key, Need need);
  const RawNode* raw(std::string_view key, Need need);

  void fail(ScenarioError::Kind kind, std::string_view key, std::string rule);
  void finish();

  /// Readers of single nodes, for items of lists.
  static bool read_number(const RawNode& node, const std::string& path, Range range, ErrorLog& log,
                          double& out);
  static bool read_vector(const RawNode& node, const std::string& path, Range range, ErrorLog& log,
                          std::size_t count, double* out);

  ErrorLog& log() { return *log_; }

 private:
  const RawNode* node_;
  std::string path_;
  ErrorLog* log_;
  bool is_map_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace swallowtail::planner::detail
