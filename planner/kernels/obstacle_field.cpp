#include "planner/kernels/obstacle_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/kernels/detail/shapes.hpp"

namespace swallowtail::planner {

using detail::BoxShape;
using detail::ConeShape;
using detail::CylinderShape;
using detail::FieldSolid;
using detail::MeshShape;
using detail::SolidKind;

namespace {

/// Kept beyond what the certifier asks for, so that its one-sided tolerance does not refuse a touching path:
/// a share of the distance and of the obstacle's size, so that a scaled scene keeps its scaled distances.
double with_reserve(double required_m, double size_m) { return required_m * (1.0 + 1e-4) + 5e-6 * size_m; }

using Real = double;
using Mask = bool;
inline double broadcast(double v) { return v; }
inline double select(bool m, double a, double b) { return m ? a : b; }
inline double largest(double a, double b) { return a > b ? a : b; }
inline double smallest(double a, double b) { return a < b ? a : b; }
inline double absolute(double a) { return std::abs(a); }
inline bool any(bool m) { return m; }
inline double root(double a) { return std::sqrt(a); }
#include "planner/kernels/detail/signed_distance.inl"

Vec3 level_over(const Vec3& p, double level, double up) {
  const double rho = root(p.x() * p.x() + p.y() * p.y());
  return rho > 0.0 ? Vec3(level * p.x() / rho, level * p.y() / rho, up) : Vec3(level, 0.0, up);
}

Vec3 box_normal(const Vec3& p, const Vec3& half) {
  const Vec3 over = p.cwiseAbs() - half;
  const Vec3 sign = p.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; });
  const Vec3 outside = over.cwiseMax(0.0);
  if (const double away = outside.norm(); away > 0.0) return sign.cwiseProduct(outside) / away;
  Eigen::Index axis = 0;
  over.maxCoeff(&axis);
  Vec3 normal = Vec3::Zero();
  normal[axis] = sign[axis];
  return normal;
}

Vec3 cylinder_normal(const Vec3& p, double radius, double height) {
  const double rho = root(p.x() * p.x() + p.y() * p.y());
  const Vec3 in_plane = box_normal(Vec3(rho, 0.0, p.z() - 0.5 * height), Vec3(radius, radius, 0.5 * height));
  return level_over(p, in_plane.x(), in_plane.z());
}

/// In the half plane (ρ, z): from the apex, the rim, the side or the base, as in the kernel.
Vec3 cone_normal(const Vec3& p, const FieldSolid& cone) {
  const Vec2 from_rim(root(p.x() * p.x() + p.y() * p.y()) - cone.radius_m, p.z());
  const Vec2 side(cone.height_m / cone.slant_m, cone.radius_m / cone.slant_m);
  const double over_side = side.dot(from_rim);
  const double up_side = side.x() * from_rim.y() - side.y() * from_rim.x();
  Vec2 n = -p.z() > over_side ? Vec2(0.0, -1.0) : side;
  if (over_side > 0.0 && up_side > cone.slant_m) {
    n = Vec2(from_rim.x() + cone.radius_m, p.z() - cone.height_m).normalized();
  } else if (p.z() < 0.0 || (over_side > 0.0 && up_side < 0.0)) {
    n = Vec2(std::max(from_rim.x(), 0.0), p.z()).normalized();
  }
  return level_over(p, n.x(), n.y());
}

Vec3 mesh_normal(const Vec3& p, const MeshShape& mesh) {
  double greatest = -std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::UnitZ();
  for (std::size_t k = 0; k < mesh.count; ++k) {
    const Vec3 direction(mesh.directions + 3 * k);
    const double d = direction.dot(p) - mesh.supports[k];
    if (d > greatest) {
      greatest = d;
      normal = direction;
    }
  }
  return normal;
}

Nearest nearest_on_ray(const FieldSolid& solid, const Ray& ray, const double* supports, double enough_m) {
  const double tolerance =
      detail::kDistanceTolerance *
      (root(ray.d.x * ray.d.x + ray.d.y * ray.d.y + ray.d.z * ray.d.z) + solid.ball_radius_m);
  switch (solid.kind) {
    case SolidKind::kSphere:
      break;
    case SolidKind::kCylinder:
      return nearest_to(detail::cylinder_of(solid), ray, tolerance, enough_m);
    case SolidKind::kCone:
      return nearest_to(detail::cone_of(solid), ray, tolerance, enough_m);
    case SolidKind::kBox:
      return nearest_to(detail::box_of(solid), ray, tolerance, enough_m);
    case SolidKind::kMesh:
      return nearest_to(detail::mesh_of(solid, supports), ray, tolerance, enough_m);
  }
  const double square = ray.d.x * ray.d.x + ray.d.y * ray.d.y + ray.d.z * ray.d.z;
  const double s = nearest_on(ray.p, ray.d, divide(1.0, square));
  const RealPoint x = ray.at(s);
  return {root(x.x * x.x + x.y * x.y + x.z * x.z) - solid.radius_m, s};
}

/// Unit normal at p in the solid's frame.
Vec3 normal_at(const FieldSolid& solid, const Vec3& p, const double* supports) {
  switch (solid.kind) {
    case SolidKind::kSphere:
      break;
    case SolidKind::kCylinder:
      return cylinder_normal(p, solid.radius_m, solid.height_m);
    case SolidKind::kCone:
      return cone_normal(p, solid);
    case SolidKind::kBox:
      return box_normal(p, solid.half_m);
    case SolidKind::kMesh:
      return mesh_normal(p, detail::mesh_of(solid, supports));
  }
  const double away = p.norm();
  return away > 0.0 ? Vec3(p / away) : Vec3(Vec3::UnitZ());
}

/// The flight relative to the solid, in the solid's frame, as far as the solid lasts.
struct RelativeFlight {
  Ray ray;
  double share;  ///< of the flight
};

RelativeFlight relative_flight(const FieldSolid& solid, const Vec3& a, double t0_s, const Vec3& b,
                               double t1_s) {
  const double end_s = std::min(t1_s, std::max(t0_s, solid.valid_until_s));
  const double share = t1_s > t0_s ? (end_s - t0_s) / (t1_s - t0_s) : 1.0;
  const Vec3 p = a - solid.position_m - solid.velocity_mps * t0_s;
  const Vec3 d = share * (b - a) - solid.velocity_mps * (end_s - t0_s);
  const auto turned = [&](const Vec3& v) {
    return RealPoint{solid.cos_yaw * v.x() + solid.sin_yaw * v.y(),
                     solid.cos_yaw * v.y() - solid.sin_yaw * v.x(), v.z()};
  };
  return {{turned(p), turned(d)}, share};
}

}  // namespace

ObstacleField::ObstacleField(std::shared_ptr<const World> world, const VehicleLimits& limits)
    : world_(std::move(world)), radius_m_(with_reserve(limits.clearance_m(), 0.0)) {
  set_slope_share(0.0);
  const auto obstacles = world_->obstacles();
  double latest_news_s = 0.0;
  for (const Obstacle& obstacle : obstacles) {
    if (!detail::stands_for_ever(obstacle)) anything_moves_ = true;
    if (obstacle.moves()) latest_news_s = std::max(latest_news_s, obstacle.state_time_s);
  }
  solids_.reserve(obstacles.size());
  standing_tree_ = add_solids(limits, true, 0.0);
  standing_ = solids_.size();
  timed_tree_ = add_solids(limits, false, latest_news_s);
}

detail::BallTree ObstacleField::add_solids(const VehicleLimits& limits, bool standing, double time_s) {
  struct Chosen {
    const Obstacle* obstacle;
    detail::Ball ball;
    double required_m;
  };
  std::vector<Chosen> chosen;
  std::vector<detail::MovingBall> balls;
  chosen.reserve(standing ? world_->obstacles().size() : 0);
  balls.reserve(chosen.capacity());
  for (const Obstacle& obstacle : world_->obstacles()) {
    if (detail::stands_for_ever(obstacle) != standing) continue;
    const detail::Ball ball = detail::ball_of(obstacle.shape);
    const double required_m =
        with_reserve(limits.clearance_m() + obstacle.extra_m(), bounding_radius_m(obstacle.shape));
    chosen.push_back({&obstacle, ball, required_m});
    balls.push_back(
        {obstacle.position_at(time_s) + ball.offset_m, obstacle.velocity_mps, ball.radius_m + required_m});
  }
  std::vector<std::uint32_t> order;
  detail::BallTree tree(balls, time_s, order);
  for (const std::uint32_t i : order)
    solids_.push_back(
        detail::field_solid(*chosen[i].obstacle, chosen[i].ball, chosen[i].required_m, supports_));
  return tree;
}

Vec3 ObstacleField::ball_center_m(std::size_t i, double time_s) const {
  const FieldSolid& solid = solids_[i];
  return solid.position_m + solid.velocity_mps * time_s + solid.ball_offset_m;
}

double ObstacleField::half_width_m(std::size_t i, const Vec3& direction) const {
  return std::min(solids_[i].ball_radius_m, solids_[i].half_extent_m.dot(direction.cwiseAbs()));
}

bool ObstacleField::near(std::size_t i, const Vec3& a, double t0_s, const Vec3& b, double t1_s,
                         double cap_m) const {
  const FieldSolid& solid = solids_[i];
  if (t0_s > solid.valid_until_s) return false;
  const Vec3 p = a - (solid.position_m + solid.velocity_mps * t0_s + solid.ball_offset_m);
  const Vec3 d = b - a - solid.velocity_mps * (t1_s - t0_s);
  const double length2 = d.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp(-p.dot(d) / length2, 0.0, 1.0) : 0.0;
  const double reach = solid.ball_radius_m + solid.required_m + cap_m;
  return (p + s * d).squaredNorm() < reach * reach;
}

Approach ObstacleField::approach(std::size_t i, const Vec3& a, double t0_s, const Vec3& b,
                                 double t1_s) const {
  const FieldSolid& solid = solids_[i];
  const RelativeFlight flight = relative_flight(solid, a, t0_s, b, t1_s);
  const Nearest nearest =
      nearest_on_ray(solid, flight.ray, supports_.data(), std::numeric_limits<double>::infinity());
  const RealPoint at = flight.ray.at(nearest.fraction);
  const Vec3 n = normal_at(solid, Vec3(at.x, at.y, at.z), supports_.data());
  return {nearest.distance, nearest.fraction * flight.share,
          Vec3(solid.cos_yaw * n.x() - solid.sin_yaw * n.y(), solid.cos_yaw * n.y() + solid.sin_yaw * n.x(),
               n.z())};
}

double ObstacleField::violation_m(std::size_t i, const Vec3& a, double t0_s, const Vec3& b,
                                  double t1_s) const {
  return near(i, a, t0_s, b, t1_s, 0.0) ? depth_m(i, a, t0_s, b, t1_s) : 0.0;
}

double ObstacleField::depth_m(std::size_t i, const Vec3& a, double t0_s, const Vec3& b, double t1_s) const {
  const FieldSolid& solid = solids_[i];
  const RelativeFlight flight = relative_flight(solid, a, t0_s, b, t1_s);
  const Nearest nearest = nearest_on_ray(solid, flight.ray, supports_.data(), solid.required_m);
  return std::max(0.0, solid.required_m - nearest.distance);
}

double ObstacleField::violation_m(const Vec3& a, double t0_s, const Vec3& b, double t1_s) const {
  double sum = 0.0;
  for_each_near(a, t0_s, b, t1_s, 0.0, [&](std::size_t i) { sum += depth_m(i, a, t0_s, b, t1_s); });
  return sum;
}

void ObstacleField::set_slope_share(double share) {
  const double slope = share * world_->terrain().max_slope();
  ground_clearance_m_ = radius_m_ * std::sqrt(1.0 + slope * slope);
}

double ObstacleField::terrain_violation_m(const Vec3& a, const Vec3& b) const {
  const Terrain& terrain = world_->terrain();
  if (terrain.is_flat()) {
    return std::max(0.0, ground_clearance_m_ - (std::min(a.z(), b.z()) - terrain.flat_elevation_m()));
  }
  return ground_clearance_m_ - terrain.min_height_above(a, b, ground_clearance_m_);
}

}  // namespace swallowtail::planner
