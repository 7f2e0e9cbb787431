#include "planner/replan/ground_probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace swallowtail::planner {
namespace {

/// One walk along a segment, in grid coordinates (u east, v north, in cells).
struct Walk {
  const TerrainGrid& grid;
  Vec2 start;
  Vec2 step;
  double z_m;
  double climb_m;
  GroundContact best{std::numeric_limits<double>::infinity(), 0.0, Vec2::Zero()};

  /// The bilinear patch of the cell under the share `middle` from t0 to t1: height is quadratic there.
  void cell(double t0, double t1) {
    const Vec2 at = start + step * (0.5 * (t0 + t1));
    const int col = std::clamp(static_cast<int>(std::floor(at.x())), 0, grid.cols - 2);
    const int row = std::clamp(static_cast<int>(std::floor(at.y())), 0, grid.rows - 2);
    const float* south = grid.elevation_m.data() + static_cast<std::ptrdiff_t>(row) * grid.cols + col;
    const float* north = south + grid.cols;
    const double sw = south[0];
    const double east = south[1] - sw;
    const double up = north[0] - sw;
    const double twist = sw - south[1] - north[0] + north[1];
    const float top = std::max(std::max(south[0], south[1]), std::max(north[0], north[1]));
    if (z_m + climb_m * (climb_m < 0.0 ? t1 : t0) - static_cast<double>(top) >= best.height_m) return;
    const auto inside = [&](double t) {
      const Vec2 f = start + step * t;
      return Vec2(std::clamp(f.x() - col, 0.0, 1.0), std::clamp(f.y() - row, 0.0, 1.0));
    };
    const auto look = [&](double t) {
      const Vec2 f = inside(t);
      const double height = z_m + climb_m * t - (sw + east * f.x() + up * f.y() + twist * f.x() * f.y());
      if (height >= best.height_m) return;
      best = {height, t, Vec2(east + twist * f.y(), up + twist * f.x()) / grid.cell_size_m};
    };
    look(t0);
    look(t1);
    const double curvature = -twist * step.x() * step.y();
    if (curvature <= 0.0) return;
    const Vec2 f = inside(t0);
    const double fall =
        climb_m - (east * step.x() + up * step.y() + twist * (f.x() * step.y() + f.y() * step.x()));
    const double t = t0 - fall / (2.0 * curvature);
    if (t > t0 && t < t1) look(t);
  }
};

/// The shares at which a coordinate crosses whole numbers, one after the other.
struct Crossings {
  double at = std::numeric_limits<double>::infinity();
  double every = 0.0;

  Crossings(double start, double step, double from) {
    if (step == 0.0) return;
    every = 1.0 / std::abs(step);
    const double here = start + step * from;
    const double next = step > 0.0 ? std::floor(here) + 1.0 : std::ceil(here) - 1.0;
    at = (next - start) / step;
  }
};

}  // namespace

GroundContact lowest_over(const Terrain& terrain, const Vec3& a, const Vec3& b, double from, double to) {
  const TerrainGrid* grid = terrain.grid();
  if (grid == nullptr) {
    const double at = b.z() < a.z() ? to : from;
    return {a.z() + at * (b.z() - a.z()) - terrain.flat_elevation_m(), at, Vec2::Zero()};
  }
  const double inverse = 1.0 / grid->cell_size_m;
  Walk walk{*grid, (a.head<2>() - grid->origin_m) * inverse, (b - a).head<2>() * inverse, a.z(),
            b.z() - a.z()};
  Crossings u(walk.start.x(), walk.step.x(), from);
  Crossings v(walk.start.y(), walk.step.y(), from);
  double t = from;
  while (t < to) {
    const double next = std::min({u.at, v.at, to});
    walk.cell(t, std::max(next, t));
    if (u.at <= next) u.at += u.every;
    if (v.at <= next) v.at += v.every;
    t = next;
  }
  if (from >= to) walk.cell(from, from);
  return walk.best;
}

double height_to_keep_m(const Terrain& terrain, const Vec2& p, double clearance_m) {
  if (terrain.is_flat()) return clearance_m;
  const Vec2 lo = p.array() - clearance_m;
  const Vec2 hi = p.array() + clearance_m;
  const double slope = terrain.max_slope_in(lo, hi);
  const double by_slope = clearance_m * std::sqrt(1.0 + slope * slope);
  if (by_slope <= 1.05 * clearance_m) return by_slope;
  return std::min(by_slope, terrain.max_in(lo, hi) - terrain.height_at(p.x(), p.y()) + clearance_m);
}

}  // namespace swallowtail::planner
