#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "planner/world/detail/raster_pyramid.hpp"

namespace swallowtail::planner::detail {
namespace {

using Row = Eigen::ArrayXf;
using Samples = Eigen::Map<const Row>;

constexpr int kSide = RasterPyramid::kSide;
/// More than float arithmetic takes away from a slope: three roundings of differences and squares, halved by
/// the root, and three of the scale, 2⁻²⁴ each.
constexpr float kSlopeRoom = 1.0F + 5e-7F;

float slope_scale(const TerrainGrid& grid) { return kSlopeRoom / static_cast<float>(grid.cell_size_m); }

}  // namespace

RasterPyramid::RasterPyramid(const TerrainGrid& grid) : grid_(&grid) {
  lay_out_levels();
  min_ = std::make_unique_for_overwrite<float[]>(count_);
  max_ = std::make_unique_for_overwrite<float[]>(count_);
  slope_ = std::make_unique_for_overwrite<float[]>(count_);
  fill_lowest();
  for (std::size_t i = 1; i < levels_.size(); ++i) join_level(levels_[i - 1], levels_[i]);
}

void RasterPyramid::lay_out_levels() {
  Level level{(grid_->rows + kSide - 2) / kSide, (grid_->cols + kSide - 2) / kSide, kSide, 0};
  for (;;) {
    levels_.push_back(level);
    count_ = level.index(level.rows, 0);
    if (level.rows == 1 && level.cols == 1) return;
    level = {(level.rows + 1) / 2, (level.cols + 1) / 2, 2 * level.cells, count_};
  }
}

// Whole rows at a time, so that the compiler uses the registers' width: first over the rows of a block, then
// over its columns.
void RasterPyramid::fill_lowest() {
  const Level& level = levels_.front();
  const Eigen::Index cols = grid_->cols;
  const Eigen::Index cells = cols - 1;
  const float scale = slope_scale(*grid_);
  Row least(cols), most(cols), east(cells), east_south(cells), north(cols), steep(cells);
  const auto samples = [&](int row) {
    return Samples(grid_->elevation_m.data() + static_cast<std::ptrdiff_t>(row) * cols, cols);
  };
  for (int row = 0; row < level.rows; ++row) {
    const int first = row * kSide;
    const int last = std::min(first + kSide, grid_->rows - 1);
    least = samples(first);
    most = samples(first);
    steep.setZero();
    east_south = (samples(first).tail(cells) - samples(first).head(cells)).abs();
    for (int r = first; r < last; ++r) {
      const auto south = samples(r);
      const auto over = samples(r + 1);
      least = least.min(over);
      most = most.max(over);
      // The gradient is linear along each edge, so its length is greatest at a corner.
      east = (over.tail(cells) - over.head(cells)).abs();
      north = (over - south).abs();
      steep = steep.max(east.max(east_south).square() + north.head(cells).max(north.tail(cells)).square());
      east.swap(east_south);
    }
    for (int col = 0; col < level.cols; ++col) {
      const Eigen::Index from = static_cast<Eigen::Index>(col) * kSide;
      const Eigen::Index count = std::min<Eigen::Index>(kSide, cells - from);
      float lo = least[from + count];
      float hi = most[from + count];
      float slope = 0.0F;
      for (Eigen::Index c = from; c < from + count; ++c) {
        lo = std::min(lo, least[c]);
        hi = std::max(hi, most[c]);
        slope = std::max(slope, steep[c]);
      }
      const std::size_t at = level.index(row, col);
      min_[at] = lo;
      max_[at] = hi;
      slope_[at] = std::sqrt(slope) * scale;
    }
  }
}

void RasterPyramid::join_level(const Level& below, const Level& level) {
  for (int row = 0; row < level.rows; ++row) {
    for (int col = 0; col < level.cols; ++col) {
      Block joined = block(below.index(2 * row, 2 * col));
      for (int r = 2 * row; r < std::min(2 * row + 2, below.rows); ++r) {
        for (int c = 2 * col; c < std::min(2 * col + 2, below.cols); ++c) {
          const Block part = block(below.index(r, c));
          joined = {std::min(joined.min_m, part.min_m), std::max(joined.max_m, part.max_m),
                    std::max(joined.slope, part.slope)};
        }
      }
      const std::size_t at = level.index(row, col);
      min_[at] = joined.min_m;
      max_[at] = joined.max_m;
      slope_[at] = joined.slope;
    }
  }
}

RasterPyramid::Block RasterPyramid::block_of_cell(int row, int col) const {
  const float* s = grid_->elevation_m.data() + static_cast<std::ptrdiff_t>(row) * grid_->cols + col;
  const float* n = s + grid_->cols;
  const float east = std::max(std::abs(n[1] - n[0]), std::abs(s[1] - s[0]));
  const float north = std::max(std::abs(n[0] - s[0]), std::abs(n[1] - s[1]));
  return {std::min({s[0], s[1], n[0], n[1]}), std::max({s[0], s[1], n[0], n[1]}),
          std::sqrt(east * east + north * north) * slope_scale(*grid_)};
}

}  // namespace swallowtail::planner::detail
