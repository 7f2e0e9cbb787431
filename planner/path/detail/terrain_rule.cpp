#include "planner/path/detail/terrain_rule.hpp"

#include <algorithm>
#include <cmath>

#include "planner/path/certifier.hpp"

namespace swallowtail::planner::detail {
namespace {

/// One segment under judgement.
struct Judge {
  const Terrain& terrain;
  Vec3 a;
  Vec3 move;
  double clearance_m;

  /// Neither condition is a comparison that NaN would pass.
  std::optional<TerrainFault> judge(double from, double to) const {
    const Vec3 start = a + move * from;
    const Vec3 end = a + move * to;
    const Vec2 lo = start.cwiseMin(end).head<2>().array() - clearance_m;
    const Vec2 hi = start.cwiseMax(end).head<2>().array() + clearance_m;
    const double height = terrain.min_height_above(start, end);
    if (!(height > 0.0)) return TerrainFault{middle(from, to), height, terrain.max_slope_in(lo, hi)};
    // Ground that rises by at most s over each metre stays h / √(1 + s²) away from what stands h above it.
    const double slope = terrain.max_slope_in(lo, hi);
    if (height >= clearance_m * std::sqrt(1.0 + slope * slope)) return std::nullopt;
    if (std::min(start.z(), end.z()) - terrain.max_in(lo, hi) >= clearance_m) return std::nullopt;
    if (!(height >= clearance_m) || !((end - start).norm() > kTerrainPiece_m))
      return TerrainFault{middle(from, to), height, slope};
    if (auto fault = judge(from, middle(from, to))) return fault;
    return judge(middle(from, to), to);
  }

  static double middle(double from, double to) { return 0.5 * (from + to); }
};

}  // namespace

std::optional<TerrainFault> find_terrain_fault(const Terrain& terrain, const Vec3& a, const Vec3& b,
                                               double clearance_m) {
  const Vec2 lo = a.cwiseMin(b).head<2>().array() - clearance_m;
  const Vec2 hi = a.cwiseMax(b).head<2>().array() + clearance_m;
  // Most flights are far above everything: one look at the pyramid's top tells.
  if (std::min(a.z(), b.z()) - terrain.max_in(lo, hi) >= clearance_m) return std::nullopt;
  return Judge{terrain, a, b - a, clearance_m}.judge(0.0, 1.0);
}

}  // namespace swallowtail::planner::detail
