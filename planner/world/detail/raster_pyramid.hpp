#pragma once

#include <vector>

#include "planner/world/terrain.hpp"

namespace swallowtail::planner::detail {

/// A flight in grid coordinates (u = column, v = row): start + t·step at z_m + t·climb_m for t in [0, 1].
struct RasterSegment {
  Vec2 start;
  Vec2 step;
  double z_m = 0.0;
  double climb_m = 0.0;
};

/// Minima, maxima and slopes of a raster over blocks of 2^L × 2^L cells, so that questions about large areas
/// descend only where they must. All rectangles and segments are in grid coordinates and inside the raster.
/// Borrows the grid.
class RasterPyramid {
 public:
  explicit RasterPyramid(const TerrainGrid& grid);

  double height_at(const Vec2& uv) const;
  /// The lesser of `best` and the least height above the ground for t in [t0, t1].
  double min_height_above(const RasterSegment& segment, double t0, double t1, double best) const;
  /// Length of {t in [t0, t1]: at or below the ground}.
  double share_below(const RasterSegment& segment, double t0, double t1) const;
  double max_in(const Vec2& lo, const Vec2& hi) const;
  double min_in(const Vec2& lo, const Vec2& hi) const;
  /// Over all cells that the closed rectangle touches.
  double max_slope_in(const Vec2& lo, const Vec2& hi) const;
  double max_slope() const { return max_slope_; }

 private:
  struct Block {
    float min_m = 0.0F;
    float max_m = 0.0F;
    float slope = 0.0F;  ///< rounded up
  };
  struct Level {
    int rows = 0;
    int cols = 0;
    std::vector<Block> blocks;
  };
  /// One cell's four corners: south-west, south-east, north-west, north-east.
  struct Cell {
    double sw, se, nw, ne;
  };

  Cell cell(int row, int col) const;
  Block block_of_cell(int row, int col) const;
  Block block(int level, int row, int col) const;
  int top() const { return static_cast<int>(levels_.size()); }

  /// Height above a cell's patch at t0 + s·(t1 − t0): h0 + s·h1 + s²·h2.
  struct Parabola {
    double h0, h1, h2;
    double at(double s) const { return h0 + s * (h1 + s * h2); }
  };
  Parabola above_cell(const RasterSegment& segment, int row, int col, double t0, double t1) const;
  /// Goes down from a block: leaves out the pieces for which skip(level, row, col, t0, t1), calls leaf(row,
  /// col, t0, t1) for each cell that is left, in the order in which the segment crosses them.
  template <class Skip, class Leaf>
  void descend(const RasterSegment& segment, int level, int row, int col, double t0, double t1,
               const Skip& skip, const Leaf& leaf) const;
  template <class Visit>
  void visit(int level, int row, int col, const Vec2& lo, const Vec2& hi, Visit&& visit_block) const;
  double slope_of_cell(int row, int col) const;

  const TerrainGrid* grid_;
  std::vector<Level> levels_;  ///< levels_[L − 1] holds the blocks of 2^L × 2^L cells
  double max_slope_ = 0.0;
};

}  // namespace swallowtail::planner::detail
