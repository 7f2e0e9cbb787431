#include "planner/cost/spso_cost.hpp"

#include <cmath>
#include <numbers>

#include "planner/cost/nmopso_cost.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kLimit_deg = 45.0;
constexpr double kDegrees = 180.0 / std::numbers::pi;

Vec2 level(const PathBatch::Hop& hop, int lane) { return {hop.dx[lane], hop.dy[lane]}; }

double corner_deg(const PathBatch& paths, std::size_t i, int lane) {
  Vec2 before = level(paths.hop(i - 1), lane);
  for (std::size_t k = i - 1; k-- > 0 && before == Vec2::Zero();) before = level(paths.hop(k), lane);
  Vec2 after = level(paths.hop(i), lane);
  for (std::size_t k = i + 1; k < paths.hops() && after == Vec2::Zero(); ++k)
    after = level(paths.hop(k), lane);
  const double cross = before.x() * after.y() - before.y() * after.x();
  const double dot = before.dot(after);
  double sum = 0.0;
  // Angles are taken only where they may be beyond the limit: cos 45° = sin 45°.
  if (std::abs(cross) > dot) {
    const double turn = std::atan2(std::abs(cross), dot) * kDegrees;
    if (turn > kLimit_deg) sum += turn;
  }
  const double climb = std::atan2(paths.hop(i).dz[lane], after.norm()) * kDegrees -
                       std::atan2(paths.hop(i - 1).dz[lane], before.norm()) * kDegrees;
  if (std::abs(climb) > kLimit_deg) sum += std::abs(climb);
  return sum;
}

/// False only if the change of climb angle cannot reach the limit and neither can the turn.
bool may_be_sharp(const PathBatch::Hop& a, const PathBatch::Hop& b, int lane) {
  // tan 22.4°: two climbs below it differ by less than 45°.
  constexpr double kTan = 0.412;
  const double la2 = a.dx[lane] * a.dx[lane] + a.dy[lane] * a.dy[lane];
  const double lb2 = b.dx[lane] * b.dx[lane] + b.dy[lane] * b.dy[lane];
  const double cross = a.dx[lane] * b.dy[lane] - a.dy[lane] * b.dx[lane];
  const double dot = a.dx[lane] * b.dx[lane] + a.dy[lane] * b.dy[lane];
  return la2 == 0.0 || lb2 == 0.0 || std::abs(cross) > 0.999 * dot ||
         a.dz[lane] * a.dz[lane] > kTan * kTan * la2 || b.dz[lane] * b.dz[lane] > kTan * kTan * lb2;
}

}  // namespace

void SpsoThreat::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  const double drone_m = scene_->limits.clearance_m();
  const double danger_m = 10.0 * drone_m;
  Lanes distance_m;
  for (std::size_t i = 0; i < paths.hops(); ++i) {
    for (const CostScene::Disc& disc : scene_->discs) {
      level_distances(paths.point(i), paths.hop(i), disc.center_m, distance_m);
      const Lanes depth = disc.radius_m + drone_m + danger_m - distance_m;
      values += (depth > danger_m).select(kSpsoInfeasible * (depth / danger_m), depth.max(0.0));
    }
  }
}

void SpsoAltitude::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  for (std::size_t i = 1; i + 1 < paths.points(); ++i) {
    const LanePoint& p = paths.point(i);
    for (int lane = 0; lane < kLanes; ++lane) {
      const double height = p.z[lane] - scene_->nearest_ground_m(p.x[lane], p.y[lane]);
      values[lane] += height < 0.0 ? kSpsoInfeasible - height : std::abs(height - middle_m_);
    }
  }
}

void SpsoSmoothness::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  for (std::size_t i = 1; i < paths.hops(); ++i) {
    for (int lane = 0; lane < kLanes; ++lane) {
      if (may_be_sharp(paths.hop(i - 1), paths.hop(i), lane)) values[lane] += corner_deg(paths, i, lane);
    }
  }
}

}  // namespace swallowtail::planner
