#include "planner/world/detail/raster_pyramid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace swallowtail::planner::detail {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr int kSide = RasterPyramid::kSide;
/// Segments are followed over blocks of which they cross at most so many along an axis.
constexpr int kMostBlocks = 40;

}  // namespace

inline RasterPyramid::Cell RasterPyramid::cell(int row, int col) const {
  const float* south = grid_->elevation_m.data() + static_cast<std::ptrdiff_t>(row) * grid_->cols + col;
  const float* north = south + grid_->cols;
  return {south[0], south[1], north[0], north[1]};
}

double RasterPyramid::height_at(const Vec2& uv) const {
  const int col = std::clamp(static_cast<int>(uv.x()), 0, grid_->cols - 2);
  const int row = std::clamp(static_cast<int>(uv.y()), 0, grid_->rows - 2);
  const double fu = uv.x() - col;
  const double fv = uv.y() - row;
  const Cell z = cell(row, col);
  return (1.0 - fv) * ((1.0 - fu) * z.sw + fu * z.se) + fv * ((1.0 - fu) * z.nw + fu * z.ne);
}

inline double RasterPyramid::ground(const Cell& z, double fu, double fv) {
  const double south = z.sw + fu * (z.se - z.sw);
  const double north = z.nw + fu * (z.ne - z.nw);
  return south + fv * (north - south);
}

/// A segment on its way over the raster, by axis: column, row.
struct RasterPyramid::Way {
  explicit Way(const RasterSegment& segment)
      : start{segment.start.x(), segment.start.y()},
        step{segment.step.x(), segment.step.y()},
        z_m(segment.z_m),
        climb_m(segment.climb_m) {
    for (int axis = 0; axis < 2; ++axis) inverse[axis] = stands(axis) ? 0.0 : 1.0 / step[axis];
  }

  double at(int axis, double t) const { return start[axis] + step[axis] * t; }
  double height(double t) const { return z_m + climb_m * t; }
  /// An inverse would overflow: nothing is crossed.
  bool stands(int axis) const { return std::abs(step[axis]) < 1e-200; }

  /// Squares of `cells` × `cells`, counts[0] in a row, counts[1] rows: calls enter(index, place, t_in, t_out)
  /// for each one between t0 and t1, in order; place: column and row in squares.
  template <class Enter>
  void march(int cells, const int (&counts)[2], double t0, double t1, const Enter& enter) const;

  double start[2], step[2], inverse[2];
  double z_m, climb_m;
};

template <class Enter>
void RasterPyramid::Way::march(int cells, const int (&counts)[2], double t0, double t1,
                               const Enter& enter) const {
  int place[2], direction[2], left[2];
  double next[2], interval[2];
  for (int axis = 0; axis < 2; ++axis) {
    const auto square = [&](double t) {
      return std::clamp(static_cast<int>(at(axis, t) / cells), 0, counts[axis] - 1);
    };
    place[axis] = square(t0);
    const int end = stands(axis) ? place[axis] : square(t1);
    direction[axis] = end < place[axis] ? -1 : 1;
    left[axis] = std::abs(end - place[axis]);
    const int line = (place[axis] + (direction[axis] > 0 ? 1 : 0)) * cells;
    next[axis] = left[axis] > 0 ? (line - start[axis]) * inverse[axis] : kInf;
    interval[axis] = cells * std::abs(inverse[axis]);
  }
  const int stride[2] = {direction[0], direction[1] * counts[0]};
  int index = place[1] * counts[0] + place[0];
  double t = t0;
  const auto cross = [&](int axis) {
    const double t_out = std::max(t, std::min(next[axis], t1));
    enter(index, place, t, t_out);
    t = t_out;
    index += stride[axis];
    place[axis] += direction[axis];
    left[axis] -= 1;
    next[axis] = left[axis] > 0 ? next[axis] + interval[axis] : kInf;
  };
  for (int steps = left[0] + left[1]; steps > 0; --steps) {
    if (next[1] < next[0]) {
      cross(1);
    } else {
      cross(0);
    }
  }
  enter(index, place, t, t1);
}

/// Height above ground along the way through one cell: h_in at t_in, h_out at t_out, between them the chord
/// and a parabola: h(s) = h_in + s·(h_out − h_in) − bend·s·(1 − s), s from 0 to 1.
struct RasterPyramid::Piece {
  double t_in, t_out;
  double h_in, h_out;
  double bend;

  double least() const {
    const double ends = std::min(h_in, h_out);
    const double slope = h_out - h_in - bend;
    if (!(bend > 0.0) || !(slope < 0.0) || !(slope + 2.0 * bend > 0.0)) return ends;
    return h_in - slope * slope / (4.0 * bend);
  }
  double share_below() const;
};

double RasterPyramid::Piece::share_below() const {
  const auto clipped = [](double s) { return std::clamp(s, 0.0, 1.0); };
  const double slope = h_out - h_in - bend;
  if (bend == 0.0) {
    if (slope == 0.0) return h_in <= 0.0 ? 1.0 : 0.0;
    const double root = clipped(-h_in / slope);
    return slope > 0.0 ? root : 1.0 - root;
  }
  const double discriminant = slope * slope - 4.0 * h_in * bend;
  if (!(discriminant > 0.0)) return bend < 0.0 ? 1.0 : 0.0;
  // The root that does not cancel, and its partner by their product.
  const double q = -0.5 * (slope + std::copysign(std::sqrt(discriminant), slope));
  const double first = clipped(std::min(q / bend, h_in / q));
  const double second = clipped(std::max(q / bend, h_in / q));
  return bend > 0.0 ? second - first : 1.0 - (second - first);
}

template <class Take>
void RasterPyramid::walk_cells(const Way& way, double t0, double t1, const Take& take) const {
  const double turn = -way.step[0] * way.step[1];
  const int counts[2] = {grid_->cols - 1, grid_->rows - 1};
  bool entered = false;
  double h_in = 0.0;
  way.march(1, counts, t0, t1, [&](int, const int(&place)[2], double t_in, double t_out) {
    const Cell z = cell(place[1], place[0]);
    const auto height = [&](double t) {
      return way.height(t) - ground(z, way.at(0, t) - place[0], way.at(1, t) - place[1]);
    };
    if (!entered) h_in = height(t_in);
    entered = true;
    const double h_out = height(t_out);
    const double span = t_out - t_in;
    take(Piece{t_in, t_out, h_in, h_out, turn * span * span * (z.sw - z.se - z.nw + z.ne)});
    h_in = h_out;
  });
}

template <class Enter>
void RasterPyramid::walk_blocks(std::size_t tier, const Way& way, double t0, double t1,
                                const Enter& enter) const {
  const Level& level = levels_[tier];
  const int counts[2] = {level.cols, level.rows};
  double z_in = way.height(t0);
  way.march(level.cells, counts, t0, t1, [&](int index, const int(&)[2], double t_in, double t_out) {
    const double z_out = way.height(t_out);
    enter(Crossing{level.first + static_cast<std::size_t>(index), t_in, t_out, std::min(z_in, z_out),
                   std::max(z_in, z_out)});
    z_in = z_out;
  });
}

std::size_t RasterPyramid::first_tier(const Way& way, double t0, double t1) const {
  const double reach = std::max(std::abs(way.step[0]), std::abs(way.step[1])) * (t1 - t0);
  std::size_t tier = 0;
  while (tier + 1 < levels_.size() && kMostBlocks * levels_[tier].cells < reach) ++tier;
  return tier;
}

// The most promising block is looked at first: what it shows rules out most others.
double RasterPyramid::least_over(std::size_t tier, const Way& way, double t0, double t1, double best) const {
  struct Candidate {
    double bound;
    Crossing crossing;
  };
  // Lines crossed are at most kMostBlocks + 1 along each axis, and one more of each by rounding.
  std::array<Candidate, 2 * kMostBlocks + 8> candidates;
  std::size_t count = 0;
  walk_blocks(tier, way, t0, t1, [&](const Crossing& crossing) {
    const double bound = crossing.z_low - static_cast<double>(max_[crossing.index]);
    candidates[count] = {bound, crossing};
    count += bound < best ? 1 : 0;  // no branch for the processor to guess
  });
  if (count == 0) return best;
  const auto look_at = [&](const Crossing& crossing) {
    if (tier > 0) {
      best = least_over(tier - std::min<std::size_t>(tier, 2), way, crossing.t_in, crossing.t_out, best);
    } else {
      walk_cells(way, crossing.t_in, crossing.t_out,
                 [&](const Piece& piece) { best = std::min(best, piece.least()); });
    }
  };
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < count; ++i)
    lowest = candidates[i].bound < candidates[lowest].bound ? i : lowest;
  look_at(candidates[lowest].crossing);
  for (std::size_t i = 0; i < count; ++i) {
    if (i != lowest && candidates[i].bound < best) look_at(candidates[i].crossing);
  }
  return best;
}

double RasterPyramid::min_height_above(const RasterSegment& segment, double t0, double t1,
                                       double best) const {
  const Way way(segment);
  return least_over(first_tier(way, t0, t1), way, t0, t1, best);
}

double RasterPyramid::share_over(std::size_t tier, const Way& way, double t0, double t1) const {
  double share = 0.0;
  walk_blocks(tier, way, t0, t1, [&](const Crossing& crossing) {
    if (crossing.z_low > static_cast<double>(max_[crossing.index])) return;
    if (crossing.z_high < static_cast<double>(min_[crossing.index])) {
      share += crossing.t_out - crossing.t_in;
    } else if (tier > 0) {
      share += share_over(tier - 1, way, crossing.t_in, crossing.t_out);
    } else {
      walk_cells(way, crossing.t_in, crossing.t_out, [&](const Piece& piece) {
        if (std::min(piece.h_in, piece.h_out) - std::max(piece.bend, 0.0) > 0.0) return;
        share += (piece.t_out - piece.t_in) * piece.share_below();
      });
    }
  });
  return share;
}

double RasterPyramid::share_below(const RasterSegment& segment, double t0, double t1) const {
  const Way way(segment);
  return share_over(first_tier(way, t0, t1), way, t0, t1);
}

/// Calls visit_block(row, col, block, is_inside, is_cell) from the top; it answers whether to descend. Blocks
/// that the rectangle does not touch are left out.
template <class Visit>
void RasterPyramid::visit(std::size_t tier, int row, int col, const Vec2& lo, const Vec2& hi,
                          Visit&& visit_block) const {
  const Level& level = levels_[tier];
  const Vec2 south_west(col * level.cells, row * level.cells);
  const Vec2 north_east =
      (south_west.array() + level.cells).min(Eigen::Array2d(grid_->cols - 1.0, grid_->rows - 1.0));
  if ((lo.array() > north_east.array()).any() || (hi.array() < south_west.array()).any()) return;
  const bool inside = (lo.array() <= south_west.array()).all() && (hi.array() >= north_east.array()).all();
  if (!visit_block(row, col, block(level.index(row, col)), inside, false)) return;
  if (tier == 0) return visit_cells(row, col, lo, hi, visit_block);
  const Level& finer = levels_[tier - 1];
  for (int r = 2 * row; r < std::min(2 * row + 2, finer.rows); ++r) {
    for (int c = 2 * col; c < std::min(2 * col + 2, finer.cols); ++c)
      visit(tier - 1, r, c, lo, hi, visit_block);
  }
}

template <class Visit>
void RasterPyramid::visit_cells(int row, int col, const Vec2& lo, const Vec2& hi, Visit&& visit_block) const {
  for (int r = kSide * row; r < std::min(kSide * (row + 1), grid_->rows - 1); ++r) {
    if (lo.y() > r + 1 || hi.y() < r) continue;
    for (int c = kSide * col; c < std::min(kSide * (col + 1), grid_->cols - 1); ++c) {
      if (lo.x() > c + 1 || hi.x() < c) continue;
      const bool inside = lo.x() <= c && lo.y() <= r && hi.x() >= c + 1 && hi.y() >= r + 1;
      visit_block(r, c, block_of_cell(r, c), inside, true);
    }
  }
}

// A bilinear patch over a rectangle is greatest and least at the rectangle's corners.
double RasterPyramid::max_in(const Vec2& lo, const Vec2& hi) const {
  double best = std::max(height_at(lo), height_at(hi));
  visit(levels_.size() - 1, 0, 0, lo, hi, [&](int row, int col, const Block& b, bool inside, bool is_cell) {
    if (static_cast<double>(b.max_m) <= best) return false;
    if (inside) {
      best = static_cast<double>(b.max_m);
      return false;
    }
    if (is_cell) {
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
  visit(levels_.size() - 1, 0, 0, lo, hi, [&](int row, int col, const Block& b, bool inside, bool is_cell) {
    if (static_cast<double>(b.min_m) >= best) return false;
    if (inside) {
      best = static_cast<double>(b.min_m);
      return false;
    }
    if (is_cell) {
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
  double best = 0.0;
  visit(levels_.size() - 1, 0, 0, lo, hi, [&](int, int, const Block& b, bool inside, bool is_cell) {
    if (static_cast<double>(b.slope) <= best) return false;
    if (!inside && !is_cell) return true;
    best = static_cast<double>(b.slope);
    return false;
  });
  return best;
}

}  // namespace swallowtail::planner::detail
