#pragma once

namespace swallowtail::planner::detail {

/// A raster and the extremes of its blocks of block_cells × block_cells cells (planner/world/terrain.hpp).
struct GroundView {
  const float* elevation_m;
  int rows, cols;
  double origin_x_m, origin_y_m, per_metre;
  const float* block_max_m;
  const float* block_min_m;
  int block_rows, block_cols, block_cells;
};

}  // namespace swallowtail::planner::detail
