#include "coverage/field/detail/point_grid.hpp"

#include <cmath>
#include <utility>

namespace swallowtail::coverage::detail {
namespace {

constexpr double kPointsPerSquare = 4.0;
constexpr double kMostSquaresPerSide = 500.0;

}  // namespace

PointGrid::PointGrid(std::vector<Vec2> points) : points_(std::move(points)) {
  if (points_.empty()) return;
  box_ = bounds_of(points_);
  const Vec2 extent = (box_.hi - box_.lo).cwiseMax(1.0);
  share_m2_ = extent.x() * extent.y() / static_cast<double>(points_.size());
  side_m_ = std::max(std::sqrt(share_m2_ * kPointsPerSquare), extent.maxCoeff() / kMostSquaresPerSide);
  columns_ = static_cast<std::size_t>(extent.x() / side_m_) + 1;
  rows_ = static_cast<std::size_t>(extent.y() / side_m_) + 1;
  const auto square = [this](const Vec2& p) {
    return index(p.y() - box_.lo.y(), rows_) * columns_ + index(p.x() - box_.lo.x(), columns_);
  };
  first_.assign(columns_ * rows_ + 1, 0);
  for (const Vec2& point : points_) ++first_[square(point) + 1];
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) first_[i + 1] += first_[i];
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  listed_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) listed_[next[square(points_[i])]++] = i;
}

}  // namespace swallowtail::coverage::detail
