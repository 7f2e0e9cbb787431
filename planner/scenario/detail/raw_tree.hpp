#pragma once

#include <string>
#include <vector>

namespace swallowtail::planner::detail {

/// A YAML document as it stands in the file: nothing interpreted, every node with its line. Keys may repeat.
struct RawNode {
  enum class Kind { kNull, kScalar, kList, kMap };
  Kind kind = Kind::kNull;
  int line = 0;
  bool quoted = false;  ///< a scalar in quotes is text whatever it looks like
  std::string scalar;
  std::vector<RawNode> items;     ///< of a list; the values of a map
  std::vector<std::string> keys;  ///< of a map, as many as items
  std::vector<int> key_lines;
};

struct RawTree {
  RawNode root;
  bool ok = true;
  int error_line = 0;
  std::string error;  ///< rule that the text breaks
};

/// Refuses what is no YAML, more than one document, anchors, aliases, tags, keys that are not scalars,
/// nesting deeper than 32 and more than 200,000 nodes.
RawTree parse_raw_tree(const std::string& text);

/// "a map", "a list of 3", the scalar itself (shortened): what error messages show as the value.
std::string shown(const RawNode& node);

}  // namespace swallowtail::planner::detail
