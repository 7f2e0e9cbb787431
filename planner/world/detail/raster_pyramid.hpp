#pragma once

#include <cstddef>
#include <memory>
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

/// Minima, maxima and slopes of a raster over blocks of 4·2^k × 4·2^k cells, so that questions about large
/// areas descend only where they must; blocks smaller than 4 × 4 are not worth their memory. All rectangles
/// and segments are in grid coordinates and inside the raster. Borrows the grid.
class RasterPyramid {
 public:
  static constexpr int kSide = 4;  ///< cells along the side of a smallest block

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
  double max_slope() const { return static_cast<double>(slope_[count_ - 1]); }
  Terrain::Blocks blocks() const {
    return {max_.get(), min_.get(), levels_.front().rows, levels_.front().cols, kSide};
  }

 private:
  struct Block {
    float min_m = 0.0F;
    float max_m = 0.0F;
    float slope = 0.0F;  ///< not below the true one
  };
  struct Level {
    int rows = 0;
    int cols = 0;
    int cells = 0;  ///< along a block's side
    std::size_t first = 0;
    std::size_t index(int row, int col) const {
      return first + static_cast<std::size_t>(row) * static_cast<std::size_t>(cols) +
             static_cast<std::size_t>(col);
    }
  };
  /// One cell's four corners: south-west, south-east, north-west, north-east.
  struct Cell {
    double sw, se, nw, ne;
  };
  /// The way through one block: when, and between which heights.
  struct Crossing {
    std::size_t index;
    double t_in, t_out;
    double z_low, z_high;
  };
  struct Way;
  struct Piece;

  void lay_out_levels();
  void fill_lowest();
  void join_level(const Level& below, const Level& level);
  Cell cell(int row, int col) const;
  static double ground(const Cell& cell, double fu, double fv);
  Block block_of_cell(int row, int col) const;
  Block block(std::size_t index) const { return {min_[index], max_[index], slope_[index]}; }

  /// The finest tier of blocks of which the way crosses few between t0 and t1.
  std::size_t first_tier(const Way& way, double t0, double t1) const;
  /// Calls enter(Crossing) for each block of the tier from t0 to t1, in order.
  template <class Enter>
  void walk_blocks(std::size_t tier, const Way& way, double t0, double t1, const Enter& enter) const;
  /// Calls take(Piece) for each cell from t0 to t1, in order.
  template <class Take>
  void walk_cells(const Way& way, double t0, double t1, const Take& take) const;
  double least_over(std::size_t tier, const Way& way, double t0, double t1, double best) const;
  double share_over(std::size_t tier, const Way& way, double t0, double t1) const;

  template <class Visit>
  void visit(std::size_t level, int row, int col, const Vec2& lo, const Vec2& hi, Visit&& visit_block) const;
  template <class Visit>
  void visit_cells(int row, int col, const Vec2& lo, const Vec2& hi, Visit&& visit_block) const;

  const TerrainGrid* grid_;
  std::vector<Level> levels_;  ///< smallest blocks first; the last is one block
  std::size_t count_ = 0;
  std::unique_ptr<float[]> min_, max_, slope_;
};

}  // namespace swallowtail::planner::detail
