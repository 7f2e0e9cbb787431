#include "planner/replan/nearby_solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace swallowtail::planner {
namespace {

constexpr int kMostCells = 512;  ///< along an axis

}  // namespace

NearbySolids::NearbySolids(const ObstacleField& field) : field_(field) {
  if (field.size() > kFew) {
    fill_cells();
    return;
  }
  always_.resize(field.size());
  std::iota(always_.begin(), always_.end(), 0U);
}

void NearbySolids::fill_cells() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec2 lo = Vec2::Constant(kFar);
  Vec2 hi = Vec2::Constant(-kFar);
  std::vector<std::uint32_t> standing;
  for (std::uint32_t i = 0; i < field_.size(); ++i) {
    if (field_.moves(i)) {
      always_.push_back(i);
      continue;
    }
    standing.push_back(i);
    const Vec2 center = field_.ball_center_m(i, 0.0).head<2>();
    lo = lo.cwiseMin(center);
    hi = hi.cwiseMax(center);
  }
  seen_.assign(field_.size(), 0);
  if (standing.empty()) return;
  const Vec2 span = (hi - lo).cwiseMax(1e-300);
  cell_m_ = std::max(std::sqrt(2.0 * span.x() * span.y() / static_cast<double>(standing.size())),
                     span.maxCoeff() / kMostCells);
  origin_m_ = lo;
  cols_ = static_cast<int>(span.x() / cell_m_) + 1;
  rows_ = static_cast<int>(span.y() / cell_m_) + 1;
  // What reaches beyond the outermost centres is listed in the outermost cells.
  const auto each_cell = [&](std::uint32_t i, auto&& visit) {
    const Vec2 center = field_.ball_center_m(i, 0.0).head<2>();
    const double reach = field_.ball_radius_m(i) + field_.required_m(i);
    const auto index = [&](double at, int count) {
      return std::clamp(static_cast<int>(std::floor(at / cell_m_)), 0, count - 1);
    };
    const Vec2 from = center - origin_m_;
    for (int r = index(from.y() - reach, rows_); r <= index(from.y() + reach, rows_); ++r) {
      for (int c = index(from.x() - reach, cols_); c <= index(from.x() + reach, cols_); ++c) {
        visit(static_cast<std::size_t>(r) * static_cast<std::size_t>(cols_) + static_cast<std::size_t>(c));
      }
    }
  };
  cell_begin_.assign(static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_) + 1, 0);
  for (const std::uint32_t i : standing) each_cell(i, [&](std::size_t cell) { ++cell_begin_[cell + 1]; });
  std::partial_sum(cell_begin_.begin(), cell_begin_.end(), cell_begin_.begin());
  in_cells_.resize(cell_begin_.back());
  std::vector<std::uint32_t> next(cell_begin_.begin(), cell_begin_.end() - 1);
  for (const std::uint32_t i : standing) each_cell(i, [&](std::size_t cell) { in_cells_[next[cell]++] = i; });
}

void NearbySolids::take_cell(int col, int row) {
  const auto cell =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) + static_cast<std::size_t>(col);
  for (std::uint32_t k = cell_begin_[cell]; k < cell_begin_[cell + 1]; ++k) {
    const std::uint32_t solid = in_cells_[k];
    if (seen_[solid] == query_) continue;
    seen_[solid] = query_;
    found_.push_back(solid);
  }
}

std::span<const std::uint32_t> NearbySolids::along(const Vec3& a, const Vec3& b, double cap_m) {
  if (cols_ == 0) return always_;
  ++query_;
  found_.assign(always_.begin(), always_.end());
  const Vec2 p = a.head<2>() - origin_m_;
  const Vec2 d = b.head<2>() - a.head<2>();
  const auto index = [&](double at, int count) {
    return std::clamp(static_cast<int>(std::floor(at / cell_m_)), 0, count - 1);
  };
  const int first = index(std::min(p.y(), p.y() + d.y()) - cap_m, rows_);
  const int last = index(std::max(p.y(), p.y() + d.y()) + cap_m, rows_);
  for (int row = first; row <= last; ++row) {
    // The part of the hop within the row, widened by the cap.
    double from = 0.0;
    double to = 1.0;
    if (d.y() != 0.0) {
      // The outermost rows stand for all that lies beyond them.
      const double south = row == 0 ? -std::numeric_limits<double>::infinity() : row * cell_m_ - cap_m;
      const double north =
          row == rows_ - 1 ? std::numeric_limits<double>::infinity() : (row + 1) * cell_m_ + cap_m;
      const double s = (south - p.y()) / d.y();
      const double n = (north - p.y()) / d.y();
      from = std::clamp(std::min(s, n), 0.0, 1.0);
      to = std::clamp(std::max(s, n), 0.0, 1.0);
    }
    const double x0 = p.x() + from * d.x();
    const double x1 = p.x() + to * d.x();
    const int left = index(std::min(x0, x1) - cap_m, cols_);
    const int right = index(std::max(x0, x1) + cap_m, cols_);
    for (int col = left; col <= right; ++col) take_cell(col, row);
  }
  std::sort(found_.begin(), found_.end());
  return found_;
}

}  // namespace swallowtail::planner
