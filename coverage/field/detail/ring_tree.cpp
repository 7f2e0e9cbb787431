#include "coverage/field/detail/ring_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swallowtail::coverage::detail {
namespace {

constexpr std::size_t kEdgesOfLeaf = 6;
/// A box that lies so much, as share of its distances, to one side of a line, lies there whatever rounding.
constexpr double kRounding = 1e-9;

/// Whether all of the box is to one side of the line.
bool is_aside(const Box& box, const Line& line) {
  const Vec2 middle = (box.lo + box.hi) / 2.0;
  const Vec2 half = (box.hi - box.lo) / 2.0;
  const double reach = half.x() * std::abs(line.along.y()) + half.y() * std::abs(line.along.x());
  const double scale = (middle - line.origin_m).cwiseAbs().sum() + half.sum();
  return std::abs(line.left_of(middle)) > reach + kRounding * scale;
}

}  // namespace

std::vector<Ring> rings_of(const Polygon& polygon) {
  std::vector<Ring> out{polygon.outline};
  out.insert(out.end(), polygon.holes.begin(), polygon.holes.end());
  return out;
}

RingTree::RingTree(const std::vector<Ring>& rings) {
  std::vector<Span> spans;
  for (const Ring& ring : rings) {
    const std::size_t first = vertices_.size();
    vertices_.insert(vertices_.end(), ring.begin(), ring.end());
    vertices_.push_back(ring.front());
    spans.push_back({bounds_of(ring), first, vertices_.size() - 1});
  }
  if (!spans.empty()) add_rings(spans, 0, spans.size());
}

Box RingTree::box_of(std::size_t first, std::size_t last) const {
  Box box{vertices_[first], vertices_[first]};
  for (std::size_t i = first + 1; i <= last; ++i) {
    box.lo = box.lo.cwiseMin(vertices_[i]);
    box.hi = box.hi.cwiseMax(vertices_[i]);
  }
  return box;
}

void RingTree::add_rings(std::vector<Span>& rings, std::size_t first, std::size_t past) {
  if (past - first == 1) {
    add_edges(rings[first].first, rings[first].last);
    return;
  }
  Box box = rings[first].box;
  for (std::size_t i = first; i < past; ++i) {
    box.lo = box.lo.cwiseMin(rings[i].box.lo);
    box.hi = box.hi.cwiseMax(rings[i].box.hi);
  }
  // A node of whole rings begins and ends at one place: what is crossed beside the segment is even in number.
  const std::size_t at = nodes_.size();
  nodes_.push_back({box, 0, 0, 0, false});
  const int axis = box.hi.x() - box.lo.x() > box.hi.y() - box.lo.y() ? 0 : 1;
  const std::size_t middle = (first + past) / 2;
  const auto place = [&](std::size_t i) { return rings.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(place(first), place(middle), place(past), [axis](const Span& a, const Span& b) {
    const double at_a = a.box.lo[axis] + a.box.hi[axis];
    const double at_b = b.box.lo[axis] + b.box.hi[axis];
    return at_a != at_b ? at_a < at_b : a.first < b.first;
  });
  add_rings(rings, first, middle);
  add_rings(rings, middle, past);
  nodes_[at].past = nodes_.size();
}

void RingTree::add_edges(std::size_t first, std::size_t last) {
  const std::size_t at = nodes_.size();
  const bool is_leaf = last - first <= kEdgesOfLeaf;
  nodes_.push_back({box_of(first, last), first, last, 0, is_leaf});
  if (!is_leaf) {
    const std::size_t middle = (first + last) / 2;
    add_edges(first, middle);
    add_edges(middle, last);
  }
  nodes_[at].past = nodes_.size();
}

void RingTree::add_crossings_of(const Node& leaf, const Line& line, std::vector<double>& crossings) const {
  double left_a = line.left_of(vertices_[leaf.first]);
  for (std::size_t i = leaf.first + 1; i <= leaf.last; ++i) {
    const double left_b = line.left_of(vertices_[i]);
    if ((left_a > 0.0) != (left_b > 0.0)) {
      const double a = line.along_of(vertices_[i - 1]);
      crossings.push_back(a + (line.along_of(vertices_[i]) - a) * left_a / (left_a - left_b));
    }
    left_a = left_b;
  }
}

bool RingTree::add_crossings(const Vec2& from, const Vec2& to, std::vector<double>& crossings) const {
  const Line line = line_through(from, to);
  const Vec2 lo = from.cwiseMin(to);
  const Vec2 hi = from.cwiseMax(to);
  bool odd = false;
  for (std::size_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    const bool is_left = node.box.hi.x() < lo.x();
    const bool is_right = node.box.lo.x() > hi.x();
    const bool is_below = node.box.hi.y() < lo.y();
    const bool is_above = node.box.lo.y() > hi.y();
    if (is_left || is_right || is_below || is_above) {
      const bool is_before = (is_left && line.along.x() > 0.0) || (is_right && line.along.x() < 0.0) ||
                             (is_below && line.along.y() > 0.0) || (is_above && line.along.y() < 0.0);
      if (is_before && node.first != node.last &&
          (line.left_of(vertices_[node.first]) > 0.0) != (line.left_of(vertices_[node.last]) > 0.0))
        odd = !odd;
      n = node.past;
      continue;
    }
    if (is_aside(node.box, line)) {
      n = node.past;
      continue;
    }
    ++n;
    if (!node.is_leaf) continue;
    add_crossings_of(node, line, crossings);
  }
  return odd;
}

void RingTree::add_crossings(const Line& line, std::vector<double>& crossings) const {
  for (std::size_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    const bool aside = is_aside(node.box, line);
    if (!aside && node.is_leaf) add_crossings_of(node, line, crossings);
    n = aside ? node.past : n + 1;
  }
}

bool RingTree::crosses(const Vec2& from, const Vec2& to) const {
  const Vec2 way = to - from;
  const double length = way.norm();
  if (!(length > 0.0)) return false;
  const Line line{from, way / length};
  const Vec2 lo = from.cwiseMin(to);
  const Vec2 hi = from.cwiseMax(to);
  for (std::size_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    const bool beside = node.box.lo.x() > hi.x() || node.box.hi.x() < lo.x() || node.box.lo.y() > hi.y() ||
                        node.box.hi.y() < lo.y();
    if (beside || is_aside(node.box, line)) {
      n = node.past;
      continue;
    }
    ++n;
    if (!node.is_leaf) continue;
    double before = cross(way, vertices_[node.first] - from);
    for (std::size_t i = node.first + 1; i <= node.last; ++i) {
      const double here = cross(way, vertices_[i] - from);
      if ((before > 0.0) != (here > 0.0)) {
        const Vec2 edge = vertices_[i] - vertices_[i - 1];
        if ((cross(edge, from - vertices_[i - 1]) > 0.0) != (cross(edge, to - vertices_[i - 1]) > 0.0))
          return true;
      }
      before = here;
    }
  }
  return false;
}

std::vector<Interval> inside_of(const RingTree& rings, const Line& line) {
  std::vector<double> crossings;
  rings.add_crossings(line, crossings);
  return inside_between(std::move(crossings));
}

}  // namespace swallowtail::coverage::detail
