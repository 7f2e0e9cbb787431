#include "planner/cost/smoothness.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace swallowtail::planner {
namespace {

/// Corners between shorter segments than this share of the unit count as if they were so long: the formula
/// would grow without bound.
constexpr double kShortest = 1e-3;

}  // namespace

double turn_rad(const PathBatch::Hop& before, const PathBatch::Hop& after, int lane) {
  const Vec3 a(before.dx[lane], before.dy[lane], before.dz[lane]);
  const Vec3 b(after.dx[lane], after.dy[lane], after.dz[lane]);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

void Smoothness::evaluate(const PathBatch& paths, Lanes& values) const {
  values.setZero();
  for (std::size_t i = 1; i < paths.hops(); ++i) {
    const Lanes mean = (0.5 * (paths.hop(i - 1).length + paths.hop(i).length) / unit_m_).max(kShortest);
    for (int lane = 0; lane < kLanes; ++lane) {
      values[lane] += turn_rad(paths.hop(i - 1), paths.hop(i), lane) / mean[lane];
    }
  }
}

}  // namespace swallowtail::planner
