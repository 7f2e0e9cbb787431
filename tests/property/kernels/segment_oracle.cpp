#include "tests/property/kernels/segment_oracle.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/oracle.hpp"

namespace swallowtail::test {
namespace {

/// For a point inside.
double depth_m(const planner::Shape& shape, const Vec3& x) {
  const double rho = std::hypot(x.x(), x.y());
  if (const auto* s = std::get_if<planner::Sphere>(&shape)) return s->radius_m - x.norm();
  if (const auto* c = std::get_if<planner::Cylinder>(&shape))
    return std::min({c->radius_m - rho, x.z(), c->height_m - x.z()});
  if (const auto* c = std::get_if<planner::Cone>(&shape)) {
    const double half_opening = std::atan2(c->radius_m, c->height_m);
    const double below_apex = c->height_m - x.z();
    return std::min(x.z(), std::cos(half_opening) * (below_apex * std::tan(half_opening) - rho));
  }
  const auto& box = std::get<planner::Box>(shape);
  const double c = std::cos(box.yaw_rad);
  const double s = std::sin(box.yaw_rad);
  return std::min({box.size_m.x() / 2.0 - std::abs(c * x.x() + s * x.y()),
                   box.size_m.y() / 2.0 - std::abs(c * x.y() - s * x.x()),
                   box.size_m.z() / 2.0 - std::abs(x.z())});
}

}  // namespace

double signed_point_distance_m(const planner::Shape& shape, const Vec3& x) {
  const double outside = point_distance_m(shape, x);
  return outside > 0.0 ? outside : -depth_m(shape, x);
}

double signed_segment_distance_m(const planner::Shape& shape, const Vec3& p, const Vec3& q) {
  double lo = 0.0;
  double hi = 1.0;
  const auto at = [&](double s) { return signed_point_distance_m(shape, (1.0 - s) * p + s * q); };
  double least = std::min(at(lo), at(hi));
  for (int i = 0; i < 200; ++i) {
    const double left = lo + (hi - lo) / 3.0;
    const double right = hi - (hi - lo) / 3.0;
    const double at_left = at(left);
    const double at_right = at(right);
    least = std::min({least, at_left, at_right});
    (at_left < at_right ? hi : lo) = at_left < at_right ? right : left;
  }
  return least;
}

}  // namespace swallowtail::test
