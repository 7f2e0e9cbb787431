#include "planner/world/detail/raster_pyramid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace swallowtail::planner::detail {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

float round_up(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) < v ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

/// Least value for s in [0, 1].
template <class Parabola>
double least(const Parabola& p) {
  double value = std::min(p.at(0.0), p.at(1.0));
  if (p.h2 > 0.0) {
    const double s = -p.h1 / (2.0 * p.h2);
    if (s > 0.0 && s < 1.0) value = std::min(value, p.at(s));
  }
  return value;
}

/// Length of {s in [0, 1]: value ≤ 0}.
template <class Parabola>
double share_not_positive(const Parabola& p) {
  const auto clipped = [](double s) { return std::clamp(s, 0.0, 1.0); };
  if (p.h2 == 0.0) {
    if (p.h1 == 0.0) return p.h0 <= 0.0 ? 1.0 : 0.0;
    const double root = clipped(-p.h0 / p.h1);
    return p.h1 > 0.0 ? root : 1.0 - root;
  }
  const double discriminant = p.h1 * p.h1 - 4.0 * p.h0 * p.h2;
  if (!(discriminant > 0.0)) return p.h2 < 0.0 ? 1.0 : 0.0;
  // The root that does not cancel, and its partner by their product.
  const double q = -0.5 * (p.h1 + std::copysign(std::sqrt(discriminant), p.h1));
  const double first = clipped(std::min(q / p.h2, p.h0 / q));
  const double second = clipped(std::max(q / p.h2, p.h0 / q));
  return p.h2 > 0.0 ? second - first : 1.0 - (second - first);
}

}  // namespace

RasterPyramid::RasterPyramid(const TerrainGrid& grid) : grid_(&grid) {
  int rows = grid.rows - 1;
  int cols = grid.cols - 1;
  while (rows > 1 || cols > 1) {
    const int level = top();
    Level next{(rows + 1) / 2, (cols + 1) / 2, {}};
    next.blocks.reserve(static_cast<std::size_t>(next.rows) * static_cast<std::size_t>(next.cols));
    for (int r = 0; r < next.rows; ++r) {
      for (int c = 0; c < next.cols; ++c) {
        Block joined = block(level, 2 * r, 2 * c);
        for (const auto& [dr, dc] : {std::array{0, 1}, std::array{1, 0}, std::array{1, 1}}) {
          if (2 * r + dr >= rows || 2 * c + dc >= cols) continue;
          const Block part = block(level, 2 * r + dr, 2 * c + dc);
          joined = {std::min(joined.min_m, part.min_m), std::max(joined.max_m, part.max_m),
                    std::max(joined.slope, part.slope)};
        }
        next.blocks.push_back(joined);
      }
    }
    rows = next.rows;
    cols = next.cols;
    levels_.push_back(std::move(next));
  }
  max_slope_ = static_cast<double>(block(top(), 0, 0).slope);
}

RasterPyramid::Cell RasterPyramid::cell(int row, int col) const {
  const float* south = grid_->elevation_m.data() + static_cast<std::ptrdiff_t>(row) * grid_->cols + col;
  const float* north = south + grid_->cols;
  return {south[0], south[1], north[0], north[1]};
}

// The gradient is linear along each edge, so its length is greatest at a corner.
double RasterPyramid::slope_of_cell(int row, int col) const {
  const Cell z = cell(row, col);
  const double east = std::max(std::abs(z.se - z.sw), std::abs(z.ne - z.nw));
  const double north = std::max(std::abs(z.nw - z.sw), std::abs(z.ne - z.se));
  return std::hypot(east, north) / grid_->cell_size_m;
}

RasterPyramid::Block RasterPyramid::block_of_cell(int row, int col) const {
  const Cell z = cell(row, col);
  return {static_cast<float>(std::min({z.sw, z.se, z.nw, z.ne})),
          static_cast<float>(std::max({z.sw, z.se, z.nw, z.ne})), round_up(slope_of_cell(row, col))};
}

RasterPyramid::Block RasterPyramid::block(int level, int row, int col) const {
  if (level == 0) return block_of_cell(row, col);
  const Level& blocks = levels_[static_cast<std::size_t>(level) - 1];
  return blocks.blocks[static_cast<std::size_t>(row) * static_cast<std::size_t>(blocks.cols) +
                       static_cast<std::size_t>(col)];
}

double RasterPyramid::height_at(const Vec2& uv) const {
  const int col = std::clamp(static_cast<int>(uv.x()), 0, grid_->cols - 2);
  const int row = std::clamp(static_cast<int>(uv.y()), 0, grid_->rows - 2);
  const double fu = uv.x() - col;
  const double fv = uv.y() - row;
  const Cell z = cell(row, col);
  return (1.0 - fv) * ((1.0 - fu) * z.sw + fu * z.se) + fv * ((1.0 - fu) * z.nw + fu * z.ne);
}

double RasterPyramid::min_height_above(const RasterSegment& segment, double t0, double t1,
                                       double best) const {
  const auto skip = [&](int level, int row, int col, double from, double to) {
    const double lowest = segment.z_m + std::min(segment.climb_m * from, segment.climb_m * to);
    return lowest - static_cast<double>(block(level, row, col).max_m) >= best;
  };
  const auto leaf = [&](int row, int col, double from, double to) {
    best = std::min(best, least(above_cell(segment, row, col, from, to)));
  };
  descend(segment, top(), 0, 0, t0, t1, skip, leaf);
  return best;
}

double RasterPyramid::share_below(const RasterSegment& segment, double t0, double t1) const {
  double share = 0.0;
  const auto skip = [&](int level, int row, int col, double from, double to) {
    const double z0 = segment.z_m + segment.climb_m * from;
    const double z1 = segment.z_m + segment.climb_m * to;
    const Block b = block(level, row, col);
    if (std::min(z0, z1) > static_cast<double>(b.max_m)) return true;
    if (!(std::max(z0, z1) < static_cast<double>(b.min_m))) return false;
    share += to - from;
    return true;
  };
  const auto leaf = [&](int row, int col, double from, double to) {
    share += (to - from) * share_not_positive(above_cell(segment, row, col, from, to));
  };
  descend(segment, top(), 0, 0, t0, t1, skip, leaf);
  return share;
}

template <class Skip, class Leaf>
void RasterPyramid::descend(const RasterSegment& segment, int level, int row, int col, double t0, double t1,
                            const Skip& skip, const Leaf& leaf) const {
  if (skip(level, row, col, t0, t1)) return;
  if (level == 0) return leaf(row, col, t0, t1);
  // Cut where the segment crosses the block's two middle lines; each piece lies in one quarter.
  const int half = 1 << (level - 1);
  const Vec2 middle((2 * col + 1) * static_cast<double>(half), (2 * row + 1) * static_cast<double>(half));
  std::array<double, 4> cuts = {t0, t1, t1, t1};
  std::size_t count = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double t = (middle[axis] - segment.start[axis]) / segment.step[axis];
    if (t > t0 && t < t1) cuts[count++] = t;
  }
  if (count == 3 && cuts[1] > cuts[2]) std::swap(cuts[1], cuts[2]);
  cuts[count] = t1;
  const int child_rows = level == 1 ? grid_->rows - 1 : levels_[static_cast<std::size_t>(level) - 2].rows;
  const int child_cols = level == 1 ? grid_->cols - 1 : levels_[static_cast<std::size_t>(level) - 2].cols;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 at = segment.start + segment.step * (0.5 * (cuts[i] + cuts[i + 1]));
    const int child_row = std::min(2 * row + (at.y() >= middle.y() ? 1 : 0), child_rows - 1);
    const int child_col = std::min(2 * col + (at.x() >= middle.x() ? 1 : 0), child_cols - 1);
    descend(segment, level - 1, child_row, child_col, cuts[i], cuts[i + 1], skip, leaf);
  }
}

RasterPyramid::Parabola RasterPyramid::above_cell(const RasterSegment& segment, int row, int col, double t0,
                                                  double t1) const {
  const Cell z = cell(row, col);
  const double east = z.se - z.sw;
  const double north = z.nw - z.sw;
  const double twist = z.sw - z.se - z.nw + z.ne;
  const Vec2 corner(col, row);
  const Vec2 from = segment.start + segment.step * t0 - corner;
  const Vec2 span = segment.step * (t1 - t0);
  const double z0 = segment.z_m + segment.climb_m * t0;
  const double climb = segment.climb_m * (t1 - t0);
  return {z0 - (z.sw + east * from.x() + north * from.y() + twist * from.x() * from.y()),
          climb - (east * span.x() + north * span.y() + twist * (from.x() * span.y() + from.y() * span.x())),
          -twist * span.x() * span.y()};
}

/// Calls visit_block(level, row, col, block, is_inside) from the top; it answers whether to descend. Blocks
/// that the rectangle does not touch are left out.
template <class Visit>
void RasterPyramid::visit(int level, int row, int col, const Vec2& lo, const Vec2& hi,
                          Visit&& visit_block) const {
  const double size = static_cast<double>(1 << level);
  const Vec2 south_west(col * size, row * size);
  const Vec2 north_east =
      (south_west.array() + size).min(Eigen::Array2d(grid_->cols - 1.0, grid_->rows - 1.0));
  if ((lo.array() > north_east.array()).any() || (hi.array() < south_west.array()).any()) return;
  const bool inside = (lo.array() <= south_west.array()).all() && (hi.array() >= north_east.array()).all();
  if (!visit_block(level, row, col, block(level, row, col), inside) || level == 0) return;
  const int rows = level == 1 ? grid_->rows - 1 : levels_[static_cast<std::size_t>(level) - 2].rows;
  const int cols = level == 1 ? grid_->cols - 1 : levels_[static_cast<std::size_t>(level) - 2].cols;
  for (int r = 2 * row; r < std::min(2 * row + 2, rows); ++r) {
    for (int c = 2 * col; c < std::min(2 * col + 2, cols); ++c) visit(level - 1, r, c, lo, hi, visit_block);
  }
}

// A bilinear patch over a rectangle is greatest and least at the rectangle's corners.
double RasterPyramid::max_in(const Vec2& lo, const Vec2& hi) const {
  double best = std::max(height_at(lo), height_at(hi));
  visit(top(), 0, 0, lo, hi, [&](int level, int row, int col, const Block& b, bool inside) {
    if (static_cast<double>(b.max_m) <= best) return false;
    if (inside) {
      best = static_cast<double>(b.max_m);
      return false;
    }
    if (level == 0) {
      const Vec2 from = lo.cwiseMax(Vec2(col, row));
      const Vec2 to = hi.cwiseMin(Vec2(col + 1, row + 1));
      best = std::max({best, height_at(from), height_at(to), height_at(Vec2(from.x(), to.y())),
                       height_at(Vec2(to.x(), from.y()))});
    }
    return true;
  });
  return best;
}

double RasterPyramid::min_in(const Vec2& lo, const Vec2& hi) const {
  double best = std::min(height_at(lo), height_at(hi));
  visit(top(), 0, 0, lo, hi, [&](int level, int row, int col, const Block& b, bool inside) {
    if (static_cast<double>(b.min_m) >= best) return false;
    if (inside) {
      best = static_cast<double>(b.min_m);
      return false;
    }
    if (level == 0) {
      const Vec2 from = lo.cwiseMax(Vec2(col, row));
      const Vec2 to = hi.cwiseMin(Vec2(col + 1, row + 1));
      best = std::min({best, height_at(from), height_at(to), height_at(Vec2(from.x(), to.y())),
                       height_at(Vec2(to.x(), from.y()))});
    }
    return true;
  });
  return best;
}

double RasterPyramid::max_slope_in(const Vec2& lo, const Vec2& hi) const {
  double best = -kInf;
  visit(top(), 0, 0, lo, hi, [&](int level, int, int, const Block& b, bool inside) {
    if (static_cast<double>(b.slope) <= best) return false;
    if (!inside && level > 0) return true;
    best = static_cast<double>(b.slope);
    return false;
  });
  return std::max(best, 0.0);
}

}  // namespace swallowtail::planner::detail
