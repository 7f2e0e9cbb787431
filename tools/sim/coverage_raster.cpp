#include "tools/sim/coverage_raster.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swallowtail::sim {
namespace {

/// Rounding of the height that is kept, and of the ends of a swath.
constexpr double kHeightSlack_m = 0.05;
constexpr double kEndSlack_m = 1e-6;
constexpr double kCellsPerSwath = 10.0;

double box_area_m2(const coverage::Field& field) {
  const coverage::Box box = coverage::bounds_of(field.polygon.outline);
  return (box.hi - box.lo).prod();
}

/// Where a row's centre line crosses the rings, in order; the field lies between the 1st and 2nd, 3rd and
/// 4th, ….
std::vector<double> crossings(const coverage::Polygon& polygon, double y_m) {
  std::vector<double> xs;
  const auto cross = [&](const coverage::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2& a = ring[i];
      const Vec2& b = ring[(i + 1) % ring.size()];
      if ((a.y() > y_m) == (b.y() > y_m)) continue;
      xs.push_back(a.x() + (y_m - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  };
  cross(polygon.outline);
  for (const coverage::Ring& hole : polygon.holes) cross(hole);
  std::ranges::sort(xs);
  return xs;
}

/// First and one-past-last index of the cells whose centres lie in [lo, hi].
std::pair<std::size_t, std::size_t> index_range(double lo_m, double hi_m, double cell_m, std::size_t count) {
  const double limit = static_cast<double>(count);
  const double first = std::clamp(std::ceil(lo_m / cell_m), 0.0, limit);
  const double last = std::clamp(std::floor(hi_m / cell_m) + 1.0, first, limit);
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

}  // namespace

CoverageRaster::CoverageRaster(std::span<const coverage::Field> fields, const planner::Terrain& terrain,
                               const SwathParams& params)
    : terrain_(terrain), params_(params) {
  double area_m2 = 0.0;
  for (const coverage::Field& field : fields) area_m2 += box_area_m2(field);
  const double least_m = std::sqrt(area_m2 / (0.9 * static_cast<double>(params.max_cells)));
  cell_m_ = std::max(least_m, std::min(params.finest_cell_m, params.sensor_width_m / kCellsPerSwath));
  for (const coverage::Field& field : fields) add_field(field);
}

void CoverageRaster::add_field(const coverage::Field& field) {
  const coverage::Box box = coverage::bounds_of(field.polygon.outline);
  Raster raster{.origin_m = box.lo + Vec2::Constant(0.5 * cell_m_),
                .rows = static_cast<std::size_t>(std::ceil((box.hi.y() - box.lo.y()) / cell_m_)),
                .cols = static_cast<std::size_t>(std::ceil((box.hi.x() - box.lo.x()) / cell_m_)),
                .height_m = field.height_m};
  raster.cells.assign(raster.rows * raster.cols, kOutside);
  mark(raster, field.polygon, kOpen);
  for (const coverage::Polygon& area : params_.no_fly) mark(raster, area, kOutside);
  if (params_.skipped_border_m > 0.0) skip_border(raster, field.polygon);
  inside_ += static_cast<std::size_t>(std::ranges::count(raster.cells, kOpen));
  rasters_.push_back(std::move(raster));
}

void CoverageRaster::mark(Raster& raster, const coverage::Polygon& polygon, Cell as) const {
  for (std::size_t row = 0; row < raster.rows; ++row) {
    const double y_m = raster.origin_m.y() + static_cast<double>(row) * cell_m_;
    const std::vector<double> xs = crossings(polygon, y_m);
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
      const auto [first, last] =
          index_range(xs[i] - raster.origin_m.x(), xs[i + 1] - raster.origin_m.x(), cell_m_, raster.cols);
      std::fill_n(raster.cells.begin() + static_cast<std::ptrdiff_t>(row * raster.cols + first), last - first,
                  as);
    }
  }
}

void CoverageRaster::skip_border(Raster& raster, const coverage::Polygon& polygon) const {
  for (std::size_t i = 0; i < raster.cells.size(); ++i) {
    if (raster.cells[i] != kOpen) continue;
    const Vec2 centre_m = raster.origin_m + cell_m_ * Vec2(static_cast<double>(i % raster.cols),
                                                           static_cast<double>(i / raster.cols));
    if (coverage::border_distance_m(polygon, centre_m) < params_.skipped_border_m) raster.cells[i] = kOutside;
  }
}

void CoverageRaster::stamp(const Vec3& from_m, const Vec3& to_m) {
  const auto height_m = [this](const Vec3& p) { return p.z() - terrain_.height_at(p.x(), p.y()); };
  const double at_from_m = height_m(from_m);
  const double at_to_m = height_m(to_m);
  const double allowed_m = params_.height_tolerance_m + kHeightSlack_m;
  for (Raster& raster : rasters_) {
    const bool kept = std::abs(at_from_m - raster.height_m) <= allowed_m &&
                      std::abs(at_to_m - raster.height_m) <= allowed_m;
    if (kept) stamp(raster, from_m.head<2>(), to_m.head<2>());
  }
}

void CoverageRaster::stamp(Raster& raster, const Vec2& from_m, const Vec2& to_m) {
  const double length_m = (to_m - from_m).norm();
  if (!(length_m > 0.0)) return;
  const Vec2 along = (to_m - from_m) / length_m;
  const double half_m = 0.5 * params_.sensor_width_m;
  const Vec2 side = half_m * Vec2(-along.y(), along.x());
  const Vec2 lo = from_m.cwiseMin(to_m) - side.cwiseAbs() - raster.origin_m;
  const Vec2 hi = from_m.cwiseMax(to_m) + side.cwiseAbs() - raster.origin_m;
  const auto [first_row, last_row] = index_range(lo.y() - cell_m_, hi.y() + cell_m_, cell_m_, raster.rows);
  const auto [first_col, last_col] = index_range(lo.x() - cell_m_, hi.x() + cell_m_, cell_m_, raster.cols);
  for (std::size_t row = first_row; row < last_row; ++row) {
    for (std::size_t col = first_col; col < last_col; ++col) {
      Cell& cell = raster.cells[row * raster.cols + col];
      if (cell != kOpen) continue;
      const Vec2 centre_m =
          raster.origin_m + cell_m_ * Vec2(static_cast<double>(col), static_cast<double>(row)) - from_m;
      const double forward_m = centre_m.dot(along);
      const double across_m = centre_m.x() * along.y() - centre_m.y() * along.x();
      if (forward_m < -kEndSlack_m || forward_m > length_m + kEndSlack_m) continue;
      if (std::abs(across_m) > half_m + kEndSlack_m) continue;
      cell = kSeen;
      ++seen_;
    }
  }
}

double CoverageRaster::covered_percent() const {
  return inside_ == 0 ? 0.0 : 100.0 * static_cast<double>(seen_) / static_cast<double>(inside_);
}

std::size_t CoverageRaster::cells() const {
  std::size_t count = 0;
  for (const Raster& raster : rasters_) count += raster.cells.size();
  return count;
}

}  // namespace swallowtail::sim
