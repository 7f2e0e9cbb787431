#pragma once

#include <memory>
#include <vector>

#include "planner/base/vec.hpp"
#include "planner/world/terrain.hpp"

namespace swallowtail::planner {

/// How far a segment leaves a band of heights above ground: by how much it dips below the lower edge and
/// rises above the upper one at its worst, 0 where it does not.
struct BandExcess {
  double below_m = 0.0;
  double above_m = 0.0;
  bool none() const { return below_m == 0.0 && above_m == 0.0; }
};

/// The ground as bands of heights need it: both extremes of (z − ground) along a segment, exact on the
/// bilinear surface (the height is quadratic within a cell). Blocks of cells with their extremes let most of
/// a segment be passed at once. Queries take no memory.
class NavigationGround {
 public:
  explicit NavigationGround(const Terrain& terrain);

  double height_at(double x_m, double y_m) const { return terrain_.height_at(x_m, y_m); }
  /// Exact where it is not 0; `low_m` and `high_m` above ground.
  BandExcess excess(const Vec3& a, const Vec3& b, double low_m, double high_m) const;

 private:
  static constexpr int kBlock = 8;  // cells along a side

  void walk_cells(const Vec3& a, const Vec3& d, double from, double to, double low_m, double high_m,
                  BandExcess& worst) const;
  int clamped_cell(double coordinate, int cells) const;

  Terrain terrain_;  // keeps the raster alive
  int block_cols_ = 0;
  int block_rows_ = 0;
  std::vector<float> block_min_m_;
  std::vector<float> block_max_m_;
};

}  // namespace swallowtail::planner
