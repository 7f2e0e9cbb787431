#include "planner/world/terrain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/base/checks.hpp"
#include "planner/world/detail/raster_pyramid.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kMaxElevation_m = 1e4;
constexpr double kMaxSamples = 5e7;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

struct Terrain::Raster {
  explicit Raster(TerrainGrid g) : grid(std::move(g)), pyramid(grid) {}

  /// Grid coordinates: column u, row v, with the edge continued.
  Vec2 to_grid(const Vec2& p_m) const { return (p_m - grid.origin_m) * per_metre; }
  Vec2 to_grid_clamped(const Vec2& p_m) const {
    return to_grid(p_m).cwiseMax(0.0).cwiseMin(Vec2(grid.cols - 1.0, grid.rows - 1.0));
  }

  /// Calls stretch(segment, t0, t1) for the pieces of a–b between which it enters or leaves the raster's
  /// column or row range: beyond, the edge is continued, and the segment runs along it.
  template <class Stretch>
  void for_each_stretch(const Vec3& a, const Vec3& b, Stretch&& stretch) const {
    const Vec2 start = to_grid(a.head<2>());
    const Vec2 step = to_grid(b.head<2>()) - start;
    const Vec2 last(grid.cols - 1.0, grid.rows - 1.0);
    const Vec2 end = start + step;
    if (start.minCoeff() >= 0.0 && end.minCoeff() >= 0.0 && (start.array() <= last.array()).all() &&
        (end.array() <= last.array()).all()) {
      return stretch(detail::RasterSegment{start, step, a.z(), b.z() - a.z()}, 0.0, 1.0);
    }
    std::array<double, 6> cuts = {0.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    std::size_t count = 1;
    for (int axis = 0; axis < 2; ++axis) {
      for (const double line : {0.0, last[axis]}) {
        const double t = (line - start[axis]) / step[axis];
        if (t > 0.0 && t < 1.0) cuts[count++] = t;
      }
    }
    std::sort(cuts.begin(), cuts.end());  // those not used are 1 and stay at the end
    for (std::size_t i = 0; i < count; ++i) {
      const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
      detail::RasterSegment segment{start, step, a.z(), b.z() - a.z()};
      for (int axis = 0; axis < 2; ++axis) {
        const double at = start[axis] + step[axis] * middle;
        if (at >= 0.0 && at <= last[axis]) continue;
        segment.start[axis] = at < 0.0 ? 0.0 : last[axis];
        segment.step[axis] = 0.0;
      }
      stretch(segment, cuts[i], cuts[i + 1]);
    }
  }

  TerrainGrid grid;
  double per_metre = 1.0 / grid.cell_size_m;
  detail::RasterPyramid pyramid;
};

Terrain Terrain::flat(double elevation_m) {
  Terrain terrain;
  terrain.flat_elevation_m_ = elevation_m;
  return terrain;
}

Result<Terrain> Terrain::from_grid(TerrainGrid grid) {
  if (grid.rows < 2 || grid.cols < 2) {
    return bad_input(
        fmt::format("The terrain has {} × {} samples; it needs at least 2 × 2.", grid.rows, grid.cols));
  }
  const auto count = static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.cols);
  if (grid.elevation_m.size() != count) {
    return bad_input(fmt::format("The terrain has {} elevations; {} rows × {} columns need {}.",
                                 grid.elevation_m.size(), grid.rows, grid.cols, count));
  }
  if (!is_positive(grid.cell_size_m)) {
    return bad_input(
        fmt::format("The terrain's cell size is {} m; it must be positive and finite.", grid.cell_size_m));
  }
  if (!is_finite(grid.origin_m)) return bad_input("The terrain's origin is not finite.");
  const auto bad = std::find_if(grid.elevation_m.begin(), grid.elevation_m.end(),
                                [](float z) { return !is_within(z, -kMaxElevation_m, kMaxElevation_m); });
  if (bad != grid.elevation_m.end()) {
    const auto index = bad - grid.elevation_m.begin();
    return bad_input(
        fmt::format("The terrain's elevation at row {}, column {} is {} m; it must lie within ±{} m.",
                    index / grid.cols, index % grid.cols, *bad, kMaxElevation_m));
  }
  Terrain terrain;
  terrain.grid_ = std::make_shared<const Raster>(std::move(grid));
  return terrain;
}

double Terrain::height_at(double x_m, double y_m) const {
  if (std::isnan(x_m) || std::isnan(y_m)) return kNan;
  if (!grid_) return flat_elevation_m_;
  return grid_->pyramid.height_at(grid_->to_grid_clamped(Vec2(x_m, y_m)));
}

double Terrain::min_height_above(const Vec3& a, const Vec3& b) const {
  return min_height_above(a, b, std::numeric_limits<double>::infinity());
}

double Terrain::min_height_above(const Vec3& a, const Vec3& b, double cap_m) const {
  if (!is_finite(a) || !is_finite(b)) return kNan;
  if (!grid_) return std::min(cap_m, std::min(a.z(), b.z()) - flat_elevation_m_);
  double best = cap_m;
  grid_->for_each_stretch(a, b, [&](const detail::RasterSegment& segment, double t0, double t1) {
    best = grid_->pyramid.min_height_above(segment, t0, t1, best);
  });
  return best;
}

double Terrain::length_below(const Vec3& a, const Vec3& b) const {
  if (!is_finite(a) || !is_finite(b)) return kNan;
  const double length = (b - a).norm();
  if (!grid_) {
    const double low = std::min(a.z(), b.z()) - flat_elevation_m_;
    const double high = std::max(a.z(), b.z()) - flat_elevation_m_;
    return high <= 0.0 ? length : low > 0.0 ? 0.0 : length * (-low / (high - low));
  }
  double share = 0.0;
  grid_->for_each_stretch(a, b, [&](const detail::RasterSegment& segment, double t0, double t1) {
    share += grid_->pyramid.share_below(segment, t0, t1);
  });
  return length * share;
}

double Terrain::max_in(const Vec2& lo, const Vec2& hi) const {
  if (lo.hasNaN() || hi.hasNaN()) return kNan;
  if (!grid_) return flat_elevation_m_;
  return grid_->pyramid.max_in(grid_->to_grid_clamped(lo.cwiseMin(hi)),
                               grid_->to_grid_clamped(lo.cwiseMax(hi)));
}

double Terrain::min_in(const Vec2& lo, const Vec2& hi) const {
  if (lo.hasNaN() || hi.hasNaN()) return kNan;
  if (!grid_) return flat_elevation_m_;
  return grid_->pyramid.min_in(grid_->to_grid_clamped(lo.cwiseMin(hi)),
                               grid_->to_grid_clamped(lo.cwiseMax(hi)));
}

double Terrain::max_slope() const { return grid_ ? grid_->pyramid.max_slope() : 0.0; }

double Terrain::max_slope_in(const Vec2& lo, const Vec2& hi) const {
  if (lo.hasNaN() || hi.hasNaN()) return kNan;
  if (!grid_) return 0.0;
  return grid_->pyramid.max_slope_in(grid_->to_grid_clamped(lo.cwiseMin(hi)),
                                     grid_->to_grid_clamped(lo.cwiseMax(hi)));
}

Terrain::Blocks Terrain::blocks() const { return grid_ ? grid_->pyramid.blocks() : Blocks{}; }

const TerrainGrid* Terrain::grid() const { return grid_ ? &grid_->grid : nullptr; }

Result<Terrain> mountains_terrain(const std::vector<Mountain>& mountains, const Vec2& lo, const Vec2& hi,
                                  double cell_size_m) {
  if (!is_positive(cell_size_m))
    return bad_input(fmt::format("The cell size is {} m; it must be positive and finite.", cell_size_m));
  if (!is_finite(lo) || !is_finite(hi) || !(lo.array() < hi.array()).all()) {
    return bad_input(fmt::format("The mountains' area ({}, {}) … ({}, {}) is empty or not finite.", lo.x(),
                                 lo.y(), hi.x(), hi.y()));
  }
  for (std::size_t i = 0; i < mountains.size(); ++i) {
    const Mountain& m = mountains[i];
    if (!is_finite(m.x_m) || !is_finite(m.y_m) || !is_finite(m.height_m) || !is_positive(m.spread_m2)) {
      return bad_input(
          fmt::format("Mountain {} must be finite with a positive spread (height {} m, spread {} m²).", i,
                      m.height_m, m.spread_m2));
    }
  }
  const Vec2 cells = ((hi - lo) / cell_size_m).array().ceil().max(1.0);
  if (!((cells.x() + 1.0) * (cells.y() + 1.0) <= kMaxSamples)) {
    return bad_input(
        fmt::format("The mountains' raster would need {:.3g} samples; at most {:.3g} are allowed.",
                    (cells.x() + 1.0) * (cells.y() + 1.0), kMaxSamples));
  }
  TerrainGrid grid;
  grid.origin_m = lo;
  grid.cell_size_m = cell_size_m;
  grid.cols = static_cast<int>(cells.x()) + 1;
  grid.rows = static_cast<int>(cells.y()) + 1;
  grid.elevation_m.reserve(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.cols));
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.cols; ++c) {
      const double x = lo.x() + c * cell_size_m;
      const double y = lo.y() + r * cell_size_m;
      double z = 0.0;
      for (const Mountain& m : mountains) {
        z += m.height_m * std::exp(-((x - m.x_m) * (x - m.x_m) + (y - m.y_m) * (y - m.y_m)) / m.spread_m2);
      }
      grid.elevation_m.push_back(static_cast<float>(z));
    }
  }
  return Terrain::from_grid(std::move(grid));
}

}  // namespace swallowtail::planner
