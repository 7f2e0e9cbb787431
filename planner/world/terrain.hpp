#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::planner {

/// An elevation raster. Sample (r, c) stands at (origin_m.x + c·cell_size_m, origin_m.y + r·cell_size_m);
/// rows go north, row by row in memory.
struct TerrainGrid {
  Vec2 origin_m = Vec2::Zero();
  double cell_size_m = 1.0;
  int rows = 0;
  int cols = 0;
  std::vector<float> elevation_m;
};

/// A mountain of the analytic terrain [BOA Eq. 7, sign corrected]: height_m · exp(−((x − x_m)² + (y − y_m)²)
/// / spread_m2).
struct Mountain {
  double x_m = 0.0;
  double y_m = 0.0;
  double height_m = 0.0;
  double spread_m2 = 20.0;
};

/// The ground: a continuous surface, bilinear between the samples of a raster; outside the raster its edge is
/// continued. Immutable, and cheap to copy. A coordinate that is not a number gives NaN; whoever compares
/// with the answer must let NaN fail.
class Terrain {
 public:
  /// A plane at one elevation.
  static Terrain flat(double elevation_m);
  /// Errors: fewer than 2×2 samples, a wrong count, a cell size that is not positive, an elevation that is
  /// not finite or beyond ±1e4 m.
  static Result<Terrain> from_grid(TerrainGrid grid);

  double height_at(double x_m, double y_m) const;

  /// Least of (z − ground) over the straight segment a–b: exact (quadratic in each cell that the segment
  /// crosses), no peak is stepped over. A pyramid of maxima leaves out whatever lies too low to matter, so
  /// that long segments over large rasters stay cheap.
  double min_height_above(const Vec3& a, const Vec3& b) const;
  /// The lesser of that and `cap_m`; the quicker, the lower the cap.
  double min_height_above(const Vec3& a, const Vec3& b, double cap_m) const;

  /// Length of the part of the segment that lies at or below the ground, exact to rounding [BOA Eq. 14].
  double length_below(const Vec3& a, const Vec3& b) const;

  /// Greatest and least ground elevation under the axis-aligned rectangle, exact.
  double max_in(const Vec2& lo, const Vec2& hi) const;
  double min_in(const Vec2& lo, const Vec2& hi) const;

  /// Greatest slope (rise over run) of the whole surface; 0 for a plane.
  double max_slope() const;
  /// An upper bound of the slope under the rectangle: the greatest of every raster cell that it touches.
  double max_slope_in(const Vec2& lo, const Vec2& hi) const;

  bool is_flat() const { return grid_ == nullptr; }
  double flat_elevation_m() const { return flat_elevation_m_; }
  /// Greatest and least sample of each block of cells × cells raster cells, borders included, row by row; for
  /// kernels that walk the raster themselves. Lives as long as this or any copy; all 0 for a plane.
  struct Blocks {
    const float* max_m = nullptr;
    const float* min_m = nullptr;
    int rows = 0;
    int cols = 0;
    int cells = 0;
  };
  Blocks blocks() const;
  /// The raster behind it, which lives as long as this or any copy; nullptr for a plane.
  const TerrainGrid* grid() const;

 private:
  struct Raster;
  double flat_elevation_m_ = 0.0;
  std::shared_ptr<const Raster> grid_;
};

/// Samples the sum of the mountains on a raster that spans lo … hi (at least; whole cells). Errors: a number
/// that is not finite, a spread or a cell size that is not positive, lo not below hi, more than 5e7 samples.
Result<Terrain> mountains_terrain(const std::vector<Mountain>& mountains, const Vec2& lo, const Vec2& hi,
                                  double cell_size_m);

}  // namespace swallowtail::planner
