#include "planner/kernels/detail/ball_tree.hpp"

#include <limits>
#include <numeric>

namespace swallowtail::planner::detail {
namespace {

constexpr std::uint32_t kLeafSize = 4;

}  // namespace

BallTree::BallTree(std::span<const MovingBall> balls, double reference_time_s,
                   std::vector<std::uint32_t>& order)
    : reference_time_s_(reference_time_s) {
  const auto count = static_cast<std::uint32_t>(balls.size());
  order.resize(count);
  std::iota(order.begin(), order.end(), 0U);
  if (count == 0) return;
  if (count <= kFew) {
    nodes_.push_back({.count = count, .next = 1, .is_leaf = true});
  } else {
    std::vector<Centre> centres;
    centres.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Eigen::Vector3f centre = balls[i].centre_m.cast<float>();
      centres.push_back({{centre.x(), centre.y(), centre.z()}, i});
    }
    nodes_.reserve(count);
    split(centres, 0, count);
    for (std::uint32_t i = 0; i < count; ++i) order[i] = centres[i].ball;
  }
  std::vector<MovingBall> in_order;
  in_order.reserve(count);
  for (const std::uint32_t i : order) in_order.push_back(balls[i]);
  for (BallNode& node : nodes_) enclose(node, std::span(in_order).subspan(node.first, node.count));
}

void BallTree::split(std::vector<Centre>& centres, std::uint32_t first, std::uint32_t count) {
  const std::size_t at = nodes_.size();
  nodes_.push_back({.first = first, .count = count, .is_leaf = count <= kLeafSize});
  if (count > kLeafSize) {
    const auto from = centres.begin() + first;
    Eigen::Array3f least = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
    Eigen::Array3f most = -least;
    for (auto centre = from; centre != from + count; ++centre) {
      least = least.min(Eigen::Map<const Eigen::Array3f>(centre->at));
      most = most.max(Eigen::Map<const Eigen::Array3f>(centre->at));
    }
    Eigen::Index axis = 0;
    (most - least).maxCoeff(&axis);
    const std::uint32_t left = count / 2;
    std::nth_element(from, from + left, from + count,
                     [axis](const Centre& a, const Centre& b) { return a.at[axis] < b.at[axis]; });
    split(centres, first, left);
    split(centres, first + left, count - left);
  }
  nodes_[at].next = static_cast<std::uint32_t>(nodes_.size());
}

void BallTree::enclose(BallNode& node, std::span<const MovingBall> balls) {
  Vec3 least = balls.front().centre_m;
  Vec3 most = least;
  Vec3 velocity = Vec3::Zero();
  for (const MovingBall& ball : balls) {
    least = least.cwiseMin(ball.centre_m);
    most = most.cwiseMax(ball.centre_m);
    velocity += ball.velocity_mps;
  }
  node.centre_m = 0.5 * (least + most);
  node.velocity_mps = velocity / static_cast<double>(balls.size());
  for (const MovingBall& ball : balls) {
    node.radius_m = std::max(node.radius_m, (ball.centre_m - node.centre_m).norm() + ball.radius_m);
    node.growth_mps = std::max(node.growth_mps, (ball.velocity_mps - node.velocity_mps).norm());
  }
  node.radius_m += kRoundingOfHop * node.centre_m.norm();
}

}  // namespace swallowtail::planner::detail
