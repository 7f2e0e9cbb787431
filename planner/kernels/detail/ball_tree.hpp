#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/base/vec.hpp"

namespace swallowtail::planner::detail {

/// A ball that moves: at centre_m at the tree's reference time.
struct MovingBall {
  Vec3 centre_m = Vec3::Zero();
  Vec3 velocity_mps = Vec3::Zero();
  double radius_m = 0.0;
};

/// A straight flight in mission time.
struct TimedHop {
  Vec3 a, b;
  double t0_s, t1_s;
};

/// A ball that holds all balls of its range: it moves with their mean velocity and grows with the time from
/// the reference time, on both sides.
struct BallNode {
  Vec3 centre_m = Vec3::Zero();
  Vec3 velocity_mps = Vec3::Zero();
  double radius_m = 0.0;
  double growth_mps = 0.0;
  std::uint32_t first = 0;  ///< of its range, in the tree's order
  std::uint32_t count = 0;
  std::uint32_t next = 0;  ///< the node that follows if this one is left out
  bool is_leaf = false;
};

/// Balls in a binary tree, halved along the axis on which their centres are spread most, in the order of a
/// walk from left to right: whoever looks at the nodes one after the other meets the balls by rising index.
/// A tree of few balls has one leaf and keeps their order.
class BallTree {
 public:
  static constexpr std::uint32_t kFew = 16;

  BallTree() = default;
  /// `order` becomes the balls' old indexes in the tree's order.
  BallTree(std::span<const MovingBall> balls, double reference_time_s, std::vector<std::uint32_t>& order);

  std::span<const BallNode> nodes() const { return nodes_; }

  /// Calls visit(first, count) for the leaves that the hop may come nearer to than cap_m.
  template <class Visit>
  void visit_near(const TimedHop& hop, double cap_m, Visit&& visit) const {
    const double away_s =
        std::max(std::abs(hop.t0_s - reference_time_s_), std::abs(hop.t1_s - reference_time_s_));
    for (std::uint32_t i = 0; i < nodes_.size();) {
      const BallNode& node = nodes_[i];
      if (!comes_near(node, hop,
                      node.radius_m + (node.growth_mps > 0.0 ? node.growth_mps * away_s : 0.0) + cap_m)) {
        i = node.next;
        continue;
      }
      if (node.is_leaf) visit(node.first, node.count);
      ++i;
    }
  }

  /// Distances count as less by this share of the hop's length and of the reach: more than rounding takes.
  static constexpr double kRoundingOfHop = 1e-12;
  static constexpr double kRoundingOfReach = 1e-9;

 private:
  struct Centre {
    float at[3];
    std::uint32_t ball;
  };
  void split(std::vector<Centre>& centres, std::uint32_t first, std::uint32_t count);
  static void enclose(BallNode& node, std::span<const MovingBall> balls);
  bool comes_near(const BallNode& node, const TimedHop& hop, double reach_m) const {
    const Vec3 p = hop.a - (node.centre_m + node.velocity_mps * (hop.t0_s - reference_time_s_));
    const Vec3 d = hop.b - hop.a - node.velocity_mps * (hop.t1_s - hop.t0_s);
    const double square = d.squaredNorm();
    const double s = square > 0.0 ? std::clamp(-p.dot(d) / square, 0.0, 1.0) : 0.0;
    const double reach = reach_m * (1.0 + kRoundingOfReach) + kRoundingOfHop * std::sqrt(square);
    return !((p + s * d).squaredNorm() > reach * reach);
  }

  double reference_time_s_ = 0.0;
  std::vector<BallNode> nodes_;
};

}  // namespace swallowtail::planner::detail
