#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/world/obstacle.hpp"

namespace swallowtail::planner::detail {

/// A straight segment p–q and what box tests need of it.
class SegmentProbe {
 public:
  SegmentProbe(const Vec3& p_m, const Vec3& q_m);

  /// False only if the segment stays farther than `reach_m` from the box: no axis of the box and no axis
  /// square to the segment and one of those separates it from the box widened by the reach.
  bool comes_near(const Extent& box, double reach_m) const;
  /// Distance from a point, to rounding.
  double distance_to(const Vec3& x_m) const;

 private:
  Vec3 middle_, half_, reach_;
  Vec3 p_, along_;
  double inverse_square_;
};

/// Axis-aligned boxes in a binary tree, each half the boxes of its parent along the axis on which their
/// centres are spread most. Small, built in one go, never changed.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Extent> boxes);

  /// Calls visit(index) for the boxes that the probe may come nearer to than the bound; visit answers the
  /// bound from there on.
  template <class Visit>
  void visit_near(const SegmentProbe& probe, double bound_m, Visit&& visit) const {
    if (!nodes_.empty()) descend(0, probe, bound_m, visit);
  }

 private:
  static constexpr std::uint32_t kLeafSize = 6;
  /// Its left child follows it; a leaf has none and holds boxes_[first … first + count).
  struct Node {
    Extent box;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t right = 0;
  };

  struct Centre {
    float at[3];
    std::uint32_t box;
  };
  void split(std::vector<Centre>& centres, std::uint32_t first, std::uint32_t count);
  Extent around(std::uint32_t first, std::uint32_t count) const;
  template <class Visit>
  void descend(std::uint32_t at, const SegmentProbe& probe, double& bound_m, Visit&& visit) const {
    const Node& node = nodes_[at];
    if (!probe.comes_near(node.box, bound_m)) return;
    if (node.right == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        if (probe.comes_near(boxes_[i], bound_m)) bound_m = visit(order_[i]);
      }
      return;
    }
    descend(at + 1, probe, bound_m, visit);
    descend(node.right, probe, bound_m, visit);
  }

  std::vector<std::uint32_t> order_;  ///< what was given, leaf by leaf
  std::vector<Extent> boxes_;         ///< in that order
  std::vector<Node> nodes_;
};

}  // namespace swallowtail::planner::detail
