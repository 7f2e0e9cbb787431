#pragma once

#include <cstddef>
#include <vector>

#include "coverage/field/detail/lines.hpp"
#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage::detail {

/// The outline, then the holes.
std::vector<Ring> rings_of(const Polygon& polygon);

/// Rings in a tree of boxes: what a segment crosses is found among its near edges.
class RingTree {
 public:
  explicit RingTree(const std::vector<Ring>& rings);

  /// Adds to `crossings`, unordered, how far along the line from `from` through `to` rings cross it: all
  /// crossings between the two and some beyond. Returns whether those left out before `from` are odd in
  /// number. The same edges are told crossed as by looking at each.
  bool add_crossings(const Vec2& from, const Vec2& to, std::vector<double>& crossings) const;
  /// Adds how far along the line rings cross it, unordered.
  void add_crossings(const Line& line, std::vector<double>& crossings) const;
  /// Whether an edge crosses the segment.
  bool crosses(const Vec2& from, const Vec2& to) const;

 private:
  /// Of the tree, in preorder: of consecutive edges of one ring, or of whole rings.
  struct Node {
    Box box;
    std::size_t first = 0;  ///< vertices: edge k leads from k to k + 1
    std::size_t last = 0;
    std::size_t past = 0;  ///< the next node that is not below this one
    bool is_leaf = false;
  };
  struct Span {
    Box box;
    std::size_t first;
    std::size_t last;
  };

  void add_rings(std::vector<Span>& rings, std::size_t first, std::size_t past);
  void add_edges(std::size_t first, std::size_t last);
  void add_crossings_of(const Node& leaf, const Line& line, std::vector<double>& crossings) const;
  Box box_of(std::size_t first, std::size_t last) const;

  std::vector<Vec2> vertices_;  ///< ring after ring, each with its first again at its end
  std::vector<Node> nodes_;
};

/// As of the polygon whose rings they are.
std::vector<Interval> inside_of(const RingTree& rings, const Line& line);

}  // namespace swallowtail::coverage::detail
