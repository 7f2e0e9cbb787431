#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "coverage/field/polygon.hpp"

namespace swallowtail::coverage::detail {

/// Finds points by their distance from a place, by a grid over all of them.
class PointGrid {
 public:
  explicit PointGrid(std::vector<Vec2> points);

  /// take(point's number, its distance) for those no nearer than `from_m` and nearer than `to_m`, in an order
  /// that depends on the points alone.
  template <class Take>
  void for_each(const Vec2& place, double from_m, double to_m, const Take& take) const {
    if (points_.empty()) return;
    const std::size_t right = index(place.x() + to_m - box_.lo.x(), columns_);
    const std::size_t high = index(place.y() + to_m - box_.lo.y(), rows_);
    for (std::size_t row = index(place.y() - to_m - box_.lo.y(), rows_); row <= high; ++row) {
      for (std::size_t c = index(place.x() - to_m - box_.lo.x(), columns_); c <= right; ++c) {
        const Vec2 low = box_.lo + side_m_ * Vec2(static_cast<double>(c), static_cast<double>(row));
        const Vec2 far =
            (place - low).cwiseAbs().cwiseMax((place - low - Vec2::Constant(side_m_)).cwiseAbs());
        if (far.norm() < from_m) continue;
        const std::size_t square = row * columns_ + c;
        for (std::size_t k = first_[square]; k < first_[square + 1]; ++k) {
          const double distance = (points_[listed_[k]] - place).norm();
          if (distance >= from_m && distance < to_m) take(listed_[k], distance);
        }
      }
    }
  }

  /// None lies farther away.
  double farthest_m(const Vec2& place) const {
    return (place - box_.lo).cwiseAbs().cwiseMax((place - box_.hi).cwiseAbs()).norm();
  }
  /// Ground for each point, of the box around all.
  double share_m2() const { return share_m2_; }

 private:
  std::size_t index(double at_m, std::size_t count) const {
    return static_cast<std::size_t>(std::clamp(at_m / side_m_, 0.0, static_cast<double>(count - 1)));
  }

  std::vector<Vec2> points_;
  Box box_;
  double share_m2_ = 1.0;
  double side_m_ = 1.0;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::size_t> first_;   ///< by square, row by row, and one past the last
  std::vector<std::size_t> listed_;  ///< points, square by square
};

}  // namespace swallowtail::coverage::detail
