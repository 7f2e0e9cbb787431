#include "planner/world/detail/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::planner::detail {
namespace {

/// Boxes count as nearer by this share of the numbers at hand: more than rounding takes away.
constexpr double kRounding = 1e-12;

}  // namespace

SegmentProbe::SegmentProbe(const Vec3& p_m, const Vec3& q_m)
    : middle_(0.5 * (p_m + q_m)),
      half_(0.5 * (q_m - p_m)),
      reach_(half_.cwiseAbs()),
      p_(p_m),
      along_(q_m - p_m),
      inverse_square_(along_.squaredNorm() > 0.0 ? 1.0 / along_.squaredNorm() : 0.0) {}

bool SegmentProbe::comes_near(const Extent& box, double reach_m) const {
  const Vec3 size = 0.5 * (box.max_m - box.min_m);
  const Vec3 apart = middle_ - 0.5 * (box.max_m + box.min_m);
  const double room = kRounding * (1.0 + middle_.cwiseAbs().sum() + apart.cwiseAbs().sum() + size.sum());
  const Vec3 wide = size.array() + (reach_m + room);
  if (((apart.cwiseAbs() - reach_).array() > wide.array()).any()) return false;
  const auto separates = [&](int i, int j) {
    const double gap = std::abs(half_[i] * apart[j] - half_[j] * apart[i]);
    const double slack = kRounding * (reach_[i] * std::abs(apart[j]) + reach_[j] * std::abs(apart[i]));
    return gap > wide[i] * reach_[j] + wide[j] * reach_[i] + slack;
  };
  return !separates(0, 1) && !separates(1, 2) && !separates(2, 0);
}

double SegmentProbe::distance_to(const Vec3& x_m) const {
  const Vec3 from = p_ - x_m;
  const double s = std::clamp(-from.dot(along_) * inverse_square_, 0.0, 1.0);
  return (from + s * along_).norm();
}

BoxTree::BoxTree(std::span<const Extent> boxes) {
  if (boxes.empty()) return;
  std::vector<Centre> centres;
  centres.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const Eigen::Vector3f centre = (0.5 * (boxes[i].min_m + boxes[i].max_m)).cast<float>();
    centres.push_back({{centre.x(), centre.y(), centre.z()}, i});
  }
  nodes_.reserve(boxes.size());
  split(centres, 0, static_cast<std::uint32_t>(centres.size()));
  order_.reserve(boxes.size());
  boxes_.reserve(boxes.size());
  for (const Centre& centre : centres) {
    order_.push_back(centre.box);
    boxes_.push_back(boxes[centre.box]);
  }
  // Children stand behind their parents.
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    if (node->right == 0) {
      node->box = around(node->first, node->count);
      continue;
    }
    const Extent& left = (node - 1)->box;
    const Extent& right = nodes_[node->right].box;
    node->box = {left.min_m.cwiseMin(right.min_m), left.max_m.cwiseMax(right.max_m)};
  }
}

Extent BoxTree::around(std::uint32_t first, std::uint32_t count) const {
  Extent box = boxes_[first];
  for (std::uint32_t i = first + 1; i < first + count; ++i) {
    box.min_m = box.min_m.cwiseMin(boxes_[i].min_m);
    box.max_m = box.max_m.cwiseMax(boxes_[i].max_m);
  }
  return box;
}

void BoxTree::split(std::vector<Centre>& centres, std::uint32_t first, std::uint32_t count) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, first, count, 0});
  if (count <= kLeafSize) return;
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
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  split(centres, first + left, count - left);
}

}  // namespace swallowtail::planner::detail
