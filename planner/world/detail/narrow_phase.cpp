#include "planner/world/detail/narrow_phase.hpp"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "planner/world/detail/solid.hpp"

namespace swallowtail::planner::detail {
namespace {

/// GJK stops when a step gains less than this.
constexpr double kGjkTolerance_m = 1e-9;
/// A plane that proves less than the witness points claim by more than this share of (1 + distance) sends the
/// query to bisection.
constexpr double kAgreement = 2e-7;
/// Taken off every distance: what rounding may add.
constexpr double kRounding = 1e-12;
constexpr int kBisections = 60;

/// FCL's shapes have their centre where ours have their base.
struct FclShape {
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
  double raised_m = 0.0;
};

FclShape to_fcl(const Shape& shape) {
  if (const auto* s = std::get_if<Sphere>(&shape)) return {std::make_shared<fcl::Sphered>(s->radius_m), 0.0};
  if (const auto* c = std::get_if<Cylinder>(&shape)) {
    return {std::make_shared<fcl::Cylinderd>(c->radius_m, c->height_m), 0.5 * c->height_m};
  }
  if (const auto* c = std::get_if<Cone>(&shape))
    return {std::make_shared<fcl::Coned>(c->radius_m, c->height_m), 0.5 * c->height_m};
  if (const auto* b = std::get_if<Box>(&shape)) return {std::make_shared<fcl::Boxd>(b->size_m), 0.0};
  // GJK asks a convex body for its extreme vertices only, and without faces FCL looks through all of them: no
  // hull has to be built, vertices inside it do no harm.
  const auto* mesh = std::get_if<ConvexMesh>(&shape);
  auto vertices = std::make_shared<const std::vector<Vec3>>(mesh->vertices_m);
  return {std::make_shared<fcl::Convexd>(vertices, 0, std::make_shared<const std::vector<int>>(), false),
          0.0};
}

fcl::DistanceRequestd distance_request() {
  fcl::DistanceRequestd request;
  request.enable_nearest_points = true;
  request.enable_signed_distance = false;  // below zero FCL's answer is of no use here
  request.rel_err = 0.0;
  request.abs_err = 0.0;
  request.distance_tolerance = kGjkTolerance_m;
  request.gjk_solver_type = fcl::GST_LIBCCD;
  return request;
}

/// The segment as a capsule of no radius, its axis along z in its own frame.
fcl::Transform3d capsule_pose(const Vec3& p, const Vec3& q) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  const Vec3 along = q - p;
  const double length = along.norm();
  if (length > 0.0)
    pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), along / length).toRotationMatrix();
  pose.translation() = 0.5 * (p + q);
  return pose;
}

double fraction_of(const Vec3& x, const Vec3& p, const Vec3& q) {
  const Vec3 along = q - p;
  const double square = along.squaredNorm();
  return square > 0.0 ? std::clamp((x - p).dot(along) / square, 0.0, 1.0) : 0.0;
}

}  // namespace

// A fraction that rounding puts off by e metres along the segment gives a distance too great by at most e,
// and e is some 1e-16 of the coordinates.
Approach sphere_to_segment(const Sphere& sphere, const Vec3& p_m, const Vec3& q_m) {
  const double fraction = fraction_of(Vec3::Zero(), p_m, q_m);
  const double away = (p_m + (q_m - p_m) * fraction).norm() - sphere.radius_m;
  const double scale = 1.0 + sphere.radius_m + p_m.norm() + q_m.norm();
  return {std::max(0.0, away - kRounding * scale), fraction};
}

struct NarrowShape::Impl {
  explicit Impl(const Shape& shape) : solid(shape), fcl(to_fcl(shape)), request(distance_request()) {
    fcl_pose.translation().z() = fcl.raised_m;
  }

  Vec3 to_own_frame(const Vec3& x) const {
    if (solid.yaw_rad() == 0.0) return x;
    const double c = std::cos(solid.yaw_rad());
    const double s = std::sin(solid.yaw_rad());
    return {c * x.x() + s * x.y(), c * x.y() - s * x.x(), x.z()};
  }

  /// Width of the slab across `direction` that separates segment and solid; 0 or less: it separates nothing.
  /// Never above their distance.
  double proven(const Vec3& direction, const Vec3& p, const Vec3& q) const {
    const double norm = direction.norm();
    if (!(norm > 0.0) || !std::isfinite(norm)) return 0.0;
    const Vec3 n = direction / norm;
    const double near = std::min(n.dot(p), n.dot(q));
    const double far = solid.support(n);
    return near - far - kRounding * (1.0 + std::abs(near) + std::abs(far) + p.norm() + q.norm());
  }

  /// The best that `direction` proves, as it is or turned square to the segment.
  double proven_about(const Vec3& direction, const Vec3& p, const Vec3& q) const {
    double best = std::max(0.0, proven(direction, p, q));
    const Vec3 along = q - p;
    if (const double square = along.squaredNorm(); square > 0.0) {
      best = std::max(best, proven(direction - along * (direction.dot(along) / square), p, q));
    }
    return best;
  }

  Approach bisect(const Vec3& p, const Vec3& q) const;
  bool gjk(const Vec3& p, const Vec3& q, Approach& out, double& claimed) const;

  Solid solid;
  FclShape fcl;
  fcl::DistanceRequestd request;
  fcl::Transform3d fcl_pose = fcl::Transform3d::Identity();
};

// The distance from a convex body is convex along a line: its derivative, the cosine to the nearest point's
// direction, changes sign once.
Approach NarrowShape::Impl::bisect(const Vec3& p, const Vec3& q) const {
  const Vec3 along = q - p;
  double lo = 0.0;
  double hi = 1.0;
  Approach best{0.0, 0.0};
  const auto slope_at = [&](double s, bool& touches) {
    const Vec3 x = p + along * s;
    const Vec3 away = x - solid.project(x);
    touches = away.squaredNorm() == 0.0;
    if (const double distance = proven_about(away, p, q); distance > best.distance_m) best = {distance, s};
    return away.dot(along);
  };
  bool touches = false;
  if (slope_at(0.0, touches) >= 0.0 || touches) return touches ? Approach{0.0, 0.0} : best;
  if (slope_at(1.0, touches) <= 0.0 || touches) return touches ? Approach{0.0, 1.0} : best;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (lo + hi);
    const double slope = slope_at(middle, touches);
    if (touches) return {0.0, middle};
    (slope < 0.0 ? lo : hi) = middle;
  }
  best.fraction = 0.5 * (lo + hi);
  return best;
}

bool NarrowShape::Impl::gjk(const Vec3& p, const Vec3& q, Approach& out, double& claimed) const {
  const fcl::Capsuled segment(0.0, (q - p).norm());
  fcl::DistanceResultd result;
  try {
    claimed = fcl::distance(static_cast<const fcl::CollisionGeometryd*>(&segment), capsule_pose(p, q),
                            fcl.geometry.get(), fcl_pose, request, result);
  } catch (const std::exception&) {
    return false;  // FCL throws where its simplex degenerates
  }
  if (!(claimed > 0.0)) return false;
  const Vec3 apart = result.nearest_points[0] - result.nearest_points[1];
  out.distance_m = std::max(proven_about(apart, p, q), proven_about(-apart, p, q));
  out.fraction = fraction_of(result.nearest_points[0], p, q);
  return true;
}

NarrowShape::NarrowShape(const Shape& shape) : impl_(std::make_unique<Impl>(shape)) {}
NarrowShape::~NarrowShape() = default;
NarrowShape::NarrowShape(NarrowShape&&) noexcept = default;
NarrowShape& NarrowShape::operator=(NarrowShape&&) noexcept = default;

Approach NarrowShape::to_segment(const Vec3& p_m, const Vec3& q_m) const {
  const Vec3 p = impl_->to_own_frame(p_m);
  const Vec3 q = impl_->to_own_frame(q_m);
  Approach approach;
  double claimed = 0.0;
  if (impl_->gjk(p, q, approach, claimed) && claimed - approach.distance_m <= kAgreement * (1.0 + claimed))
    return approach;
  const Approach bisected = impl_->bisect(p, q);
  return bisected.distance_m >= approach.distance_m ? bisected : approach;
}

Approach NarrowShape::by_gjk(const Vec3& p_m, const Vec3& q_m) const {
  Approach approach;
  double claimed = 0.0;
  impl_->gjk(impl_->to_own_frame(p_m), impl_->to_own_frame(q_m), approach, claimed);
  return approach;
}

Approach NarrowShape::by_bisection(const Vec3& p_m, const Vec3& q_m) const {
  return impl_->bisect(impl_->to_own_frame(p_m), impl_->to_own_frame(q_m));
}

}  // namespace swallowtail::planner::detail
