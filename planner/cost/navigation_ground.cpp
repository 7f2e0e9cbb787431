#include "planner/cost/navigation_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swallowtail::planner {
namespace {

/// Parameters at which a coordinate crosses the lines k·spacing, one after the other.
struct Crossings {
  Crossings(double start, double delta, double spacing, double from) {
    if (delta == 0.0) return;
    step = std::abs(spacing / delta);
    const double at = (start + from * delta) / spacing;
    const double line = delta > 0.0 ? std::floor(at) + 1.0 : std::ceil(at) - 1.0;
    next = (line * spacing - start) / delta;
    if (next <= from) next += step;
  }
  double next = std::numeric_limits<double>::infinity();
  double step = 0.0;
};

void note(double height_m, double low_m, double high_m, BandExcess& worst) {
  worst.below_m = std::max(worst.below_m, low_m - height_m);
  worst.above_m = std::max(worst.above_m, height_m - high_m);
}

}  // namespace

NavigationGround::NavigationGround(const Terrain& terrain) : terrain_(terrain) {
  const TerrainGrid* grid = terrain_.grid();
  if (grid == nullptr) return;
  block_cols_ = (grid->cols - 2) / kBlock + 1;
  block_rows_ = (grid->rows - 2) / kBlock + 1;
  for (int r = 0; r < block_rows_; ++r) {
    for (int c = 0; c < block_cols_; ++c) {
      float min = std::numeric_limits<float>::infinity();
      float max = -min;
      for (int i = r * kBlock; i <= std::min((r + 1) * kBlock, grid->rows - 1); ++i) {
        for (int j = c * kBlock; j <= std::min((c + 1) * kBlock, grid->cols - 1); ++j) {
          const float v = grid->elevation_m[static_cast<std::size_t>(i) * grid->cols + j];
          min = std::min(min, v);
          max = std::max(max, v);
        }
      }
      block_min_m_.push_back(min);
      block_max_m_.push_back(max);
    }
  }
}

int NavigationGround::clamped_cell(double coordinate, int cells) const {
  return static_cast<int>(std::clamp(std::floor(coordinate), 0.0, static_cast<double>(cells - 1)));
}

BandExcess NavigationGround::excess(const Vec3& a, const Vec3& b, double low_m, double high_m) const {
  BandExcess worst;
  const TerrainGrid* grid = terrain_.grid();
  if (grid == nullptr) {
    note(a.z() - terrain_.flat_elevation_m(), low_m, high_m, worst);
    note(b.z() - terrain_.flat_elevation_m(), low_m, high_m, worst);
    return worst;
  }
  // In units of cells from the raster's origin.
  const double cell_m = grid->cell_size_m;
  const Vec3 p((a.x() - grid->origin_m.x()) / cell_m, (a.y() - grid->origin_m.y()) / cell_m, a.z());
  const Vec3 d((b.x() - a.x()) / cell_m, (b.y() - a.y()) / cell_m, b.z() - a.z());
  Crossings x(p.x(), d.x(), kBlock, 0.0);
  Crossings y(p.y(), d.y(), kBlock, 0.0);
  for (double from = 0.0; from < 1.0;) {
    const double to = std::min({x.next, y.next, 1.0});
    const double middle = 0.5 * (from + to);
    const int col = clamped_cell(p.x() + middle * d.x(), grid->cols - 1) / kBlock;
    const int row = clamped_cell(p.y() + middle * d.y(), grid->rows - 1) / kBlock;
    const auto block = static_cast<std::size_t>(row) * block_cols_ + col;
    const double z0 = p.z() + from * d.z();
    const double z1 = p.z() + to * d.z();
    if (std::min(z0, z1) - block_max_m_[block] < low_m || std::max(z0, z1) - block_min_m_[block] > high_m) {
      walk_cells(p, d, from, to, low_m, high_m, worst);
    }
    if (x.next <= to) x.next += x.step;
    if (y.next <= to) y.next += y.step;
    from = to;
  }
  return worst;
}

void NavigationGround::walk_cells(const Vec3& p, const Vec3& d, double from, double to, double low_m,
                                  double high_m, BandExcess& worst) const {
  const TerrainGrid& grid = *terrain_.grid();
  Crossings x(p.x(), d.x(), 1.0, from);
  Crossings y(p.y(), d.y(), 1.0, from);
  const auto sample = [&grid](int row, int col) {
    return static_cast<double>(grid.elevation_m[static_cast<std::size_t>(row) * grid.cols + col]);
  };
  while (from < to) {
    const double end = std::min({x.next, y.next, to});
    const double middle = 0.5 * (from + end);
    const int col = clamped_cell(p.x() + middle * d.x(), grid.cols - 1);
    const int row = clamped_cell(p.y() + middle * d.y(), grid.rows - 1);
    const double g00 = sample(row, col);
    const double g10 = sample(row, col + 1) - g00;
    const double g01 = sample(row + 1, col) - g00;
    const double g11 = sample(row + 1, col + 1) - g00 - g10 - g01;
    // Beyond the raster its edge goes on.
    const auto height = [&](double t) {
      const double u = std::clamp(p.x() + t * d.x() - col, 0.0, 1.0);
      const double v = std::clamp(p.y() + t * d.y() - row, 0.0, 1.0);
      return p.z() + t * d.z() - (g00 + g10 * u + g01 * v + g11 * u * v);
    };
    const double h0 = height(from);
    const double hm = height(middle);
    const double h1 = height(end);
    note(h0, low_m, high_m, worst);
    note(h1, low_m, high_m, worst);
    // The parabola through the three heights, s = −1 … 1: its vertex if that lies within.
    const double curve = h0 - 2.0 * hm + h1;
    const double slope = 0.5 * (h1 - h0);
    if (std::abs(slope) < std::abs(curve)) note(hm - 0.5 * slope * slope / curve, low_m, high_m, worst);
    if (x.next <= end) x.next += x.step;
    if (y.next <= end) y.next += y.step;
    from = end;
  }
}

}  // namespace swallowtail::planner
