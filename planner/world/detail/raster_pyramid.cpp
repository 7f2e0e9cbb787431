#include "planner/world/detail/raster_pyramid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace swallowtail::planner::detail {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr int kSide = RasterPyramid::kSide;
/// Segments of up to so many cells along an axis are followed over the smallest blocks only.
constexpr double kShort = 48.0;

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

/// One coordinate of a walk: when it leaves a block, and to which side.
struct RasterPyramid::Axis {
  Axis(double from, double step)
      : start(from),
        slope(step),
        stands(std::abs(step) < kStill),
        inverse(stands ? 0.0 : 1.0 / step),
        never(stands ? kInf : 0.0),
        direction(step < 0.0 ? -1 : 1),
        far_side(step < 0.0 ? 0 : 1) {}

  double at(double t) const { return start + slope * t; }
  /// When the walk leaves block `index` of that many cells.
  double exit(int index, int cells) const { return ((index + far_side) * cells - start) * inverse + never; }
  /// Whether block `index`, just entered, is the first of its parent on the way.
  bool enters_parent(int index) const { return (index & 1) != far_side; }

  static constexpr double kStill = 1e-200;  ///< its inverse would overflow
  double start;
  double slope;
  bool stands;
  double inverse;
  double never;
  int direction;
  int far_side;
};

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
void RasterPyramid::walk_cells(const RasterSegment& segment, const Axis& u, const Axis& v,
                               const Crossing& crossing, const Take& take) const {
  const auto [row, col, t_in, t_out] = crossing;
  const int first_col = col * kSide;
  const int first_row = row * kSide;
  const int last_col = std::min(first_col + kSide, grid_->cols - 1) - 1;
  const int last_row = std::min(first_row + kSide, grid_->rows - 1) - 1;
  int c = std::clamp(static_cast<int>(u.at(t_in)), first_col, last_col);
  int r = std::clamp(static_cast<int>(v.at(t_in)), first_row, last_row);
  const double turn = -u.slope * v.slope;
  double h_in = segment.z_m + segment.climb_m * t_in - ground(cell(r, c), u.at(t_in) - c, v.at(t_in) - r);
  double t = t_in;
  while (c >= first_col && c <= last_col && r >= first_row && r <= last_row) {
    const double tu = u.exit(c, 1);
    const double tv = v.exit(r, 1);
    const double next = std::max(t, std::min(std::min(tu, tv), t_out));
    const Cell z = cell(r, c);
    const double h_out = segment.z_m + segment.climb_m * next - ground(z, u.at(next) - c, v.at(next) - r);
    const double span = next - t;
    take(Piece{t, next, h_in, h_out, turn * span * span * (z.sw - z.se - z.nw + z.ne)});
    if (next >= t_out) return;
    h_in = h_out;
    t = next;
    if (tu <= tv) {
      c += u.direction;
    } else {
      r += v.direction;
    }
  }
}

template <class Enter>
void RasterPyramid::walk_lowest(const RasterSegment& segment, const Axis& u, const Axis& v, double t0,
                                double t1, const Enter& enter) const {
  const Level& level = levels_.front();
  int col = std::clamp(static_cast<int>(u.at(t0)), 0, grid_->cols - 2) / kSide;
  int row = std::clamp(static_cast<int>(v.at(t0)), 0, grid_->rows - 2) / kSide;
  double t = t0;
  double z = segment.z_m + segment.climb_m * t;
  while (col >= 0 && col < level.cols && row >= 0 && row < level.rows) {
    const double tu = u.exit(col, kSide);
    const double tv = v.exit(row, kSide);
    const double t_out = std::max(t, std::min(std::min(tu, tv), t1));
    const double z_out = segment.z_m + segment.climb_m * t_out;
    enter(level.index(row, col), Crossing{row, col, t, t_out}, z, z_out);
    if (t_out >= t1) return;
    t = t_out;
    z = z_out;
    col += tu <= tv ? u.direction : 0;
    row += tu <= tv ? 0 : v.direction;
  }
}

template <class Skip, class Enter>
void RasterPyramid::walk(const RasterSegment& segment, const Axis& u, const Axis& v, double t0, double t1,
                         const Skip& skip, const Enter& enter) const {
  // Blocks much larger than the segment say little about it.
  const double reach = std::max(std::abs(u.slope), std::abs(v.slope)) * (t1 - t0);
  std::size_t tier = 0;
  while (tier + 1 < levels_.size() && levels_[tier].cells < reach) ++tier;
  int col = std::clamp(static_cast<int>(u.at(t0)), 0, grid_->cols - 2) / levels_[tier].cells;
  int row = std::clamp(static_cast<int>(v.at(t0)), 0, grid_->rows - 2) / levels_[tier].cells;
  double t = t0;
  double z = segment.z_m + segment.climb_m * t;
  while (t < t1) {
    const Level& level = levels_[tier];
    const double tu = u.exit(col, level.cells);
    const double tv = v.exit(row, level.cells);
    const double t_out = std::max(t, std::min(std::min(tu, tv), t1));
    const double z_out = segment.z_m + segment.climb_m * t_out;
    if (!skip(level.index(row, col), t, z, t_out, z_out)) {
      if (tier > 0) {
        --tier;
        const Level& finer = levels_[tier];
        col = std::min(2 * col + (u.at(t) >= (2 * col + 1) * finer.cells ? 1 : 0), finer.cols - 1);
        row = std::min(2 * row + (v.at(t) >= (2 * row + 1) * finer.cells ? 1 : 0), finer.rows - 1);
        continue;
      }
      enter(level.index(row, col), Crossing{row, col, t, t_out}, z, z_out);
    }
    t = t_out;
    z = z_out;
    const bool across = tu <= tv;
    int& index = across ? col : row;
    index += across ? u.direction : v.direction;
    if (index < 0 || index >= (across ? level.cols : level.rows)) return;
    if (tier + 1 < levels_.size() && (across ? u : v).enters_parent(index)) {
      ++tier;
      col /= 2;
      row /= 2;
    }
  }
}

/// The blocks that may hold the least height. The most promising is looked at first: its cells rule out most
/// others.
class RasterPyramid::Candidates {
 public:
  static constexpr std::size_t kMost = 32;

  /// Kept only if `keep`: no branch for the processor to guess.
  void offer(double bound, const Crossing& crossing, bool keep) {
    blocks_[count_] = {bound, crossing};
    count_ += keep ? 1 : 0;
  }
  bool full() const { return count_ == kMost; }

  template <class LookAt>
  double look_at_all(double best, const LookAt& look_at) {
    if (count_ == 0) return best;
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < count_; ++i) lowest = blocks_[i].bound < blocks_[lowest].bound ? i : lowest;
    best = look_at(blocks_[lowest].crossing, best);
    for (std::size_t i = 0; i < count_; ++i) {
      if (i != lowest && blocks_[i].bound < best) best = look_at(blocks_[i].crossing, best);
    }
    count_ = 0;
    return best;
  }

 private:
  struct Block {
    double bound;
    Crossing crossing;
  };
  std::array<Block, kMost + 1> blocks_;
  std::size_t count_ = 0;
};

double RasterPyramid::min_height_above(const RasterSegment& segment, double t0, double t1,
                                       double best) const {
  const Axis u(segment.start.x(), segment.step.x());
  const Axis v(segment.start.y(), segment.step.y());
  const auto look_at = [&](const Crossing& crossing, double least) {
    walk_cells(segment, u, v, crossing, [&](const Piece& piece) { least = std::min(least, piece.least()); });
    return least;
  };
  const auto bound = [&](std::size_t index, double z_in, double z_out) {
    return std::min(z_in, z_out) - static_cast<double>(max_[index]);
  };
  Candidates candidates;
  const double reach = std::max(std::abs(u.slope), std::abs(v.slope)) * (t1 - t0);
  if (reach <= kShort) {
    walk_lowest(segment, u, v, t0, t1,
                [&](std::size_t index, const Crossing& crossing, double z_in, double z_out) {
                  const double least = bound(index, z_in, z_out);
                  candidates.offer(least, crossing, least < best && !candidates.full());
                });
    return candidates.look_at_all(best, look_at);
  }
  const auto skip = [&](std::size_t index, double, double z_in, double, double z_out) {
    return bound(index, z_in, z_out) >= best;
  };
  walk(segment, u, v, t0, t1, skip,
       [&](std::size_t index, const Crossing& crossing, double z_in, double z_out) {
         candidates.offer(bound(index, z_in, z_out), crossing, true);
         if (candidates.full()) best = candidates.look_at_all(best, look_at);
       });
  return candidates.look_at_all(best, look_at);
}

double RasterPyramid::share_below(const RasterSegment& segment, double t0, double t1) const {
  double share = 0.0;
  const Axis u(segment.start.x(), segment.step.x());
  const Axis v(segment.start.y(), segment.step.y());
  const auto skip = [&](std::size_t index, double t_in, double z_in, double t_out, double z_out) {
    if (std::min(z_in, z_out) > static_cast<double>(max_[index])) return true;
    if (!(std::max(z_in, z_out) < static_cast<double>(min_[index]))) return false;
    share += t_out - t_in;
    return true;
  };
  const auto take = [&](const Piece& piece) {
    if (std::min(piece.h_in, piece.h_out) - std::max(piece.bend, 0.0) > 0.0) return;
    share += (piece.t_out - piece.t_in) * piece.share_below();
  };
  walk(segment, u, v, t0, t1, skip, [&](std::size_t, const Crossing& crossing, double, double) {
    walk_cells(segment, u, v, crossing, take);
  });
  return share;
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
