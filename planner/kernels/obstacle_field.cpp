#include "planner/kernels/obstacle_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

namespace swallowtail::planner {
namespace {

/// Kept beyond what the certifier asks for, so that its one-sided tolerance does not refuse a touching path.
double with_reserve(double required_m) { return required_m * (1.0 + 1e-4) + 1e-5; }

/// Directions spread evenly over the sphere (Fibonacci lattice) after the six axes.
const std::array<Vec3, ObstacleField::kDirections>& directions() {
  static const auto kTable = [] {
    std::array<Vec3, ObstacleField::kDirections> table;
    table[0] = Vec3::UnitX();
    table[1] = -Vec3::UnitX();
    table[2] = Vec3::UnitY();
    table[3] = -Vec3::UnitY();
    table[4] = Vec3::UnitZ();
    table[5] = -Vec3::UnitZ();
    const auto n = static_cast<double>(table.size() - 6);
    for (std::size_t i = 6; i < table.size(); ++i) {
      const double k = static_cast<double>(i - 6) + 0.5;
      const double z = 1.0 - 2.0 * k / n;
      const double angle = std::numbers::pi * (1.0 + std::sqrt(5.0)) * k;
      const double r = std::sqrt(1.0 - z * z);
      table[i] = Vec3(r * std::cos(angle), r * std::sin(angle), z);
    }
    return table;
  }();
  return kTable;
}

/// Without std::hypot's care for overflow, which costs ten times as much.
double length(double a, double b) { return std::sqrt(a * a + b * b); }

/// A rectangle |u| ≤ hu, |v| ≤ hv: signed distance and its gradient.
double rectangle_distance(double u, double v, double hu, double hv, double& gu, double& gv) {
  const double du = std::abs(u) - hu;
  const double dv = std::abs(v) - hv;
  gu = 0.0;
  gv = 0.0;
  const double su = u < 0.0 ? -1.0 : 1.0;
  const double sv = v < 0.0 ? -1.0 : 1.0;
  if (du > 0.0 && dv > 0.0) {
    const double d = length(du, dv);
    gu = su * du / d;
    gv = sv * dv / d;
    return d;
  }
  if (du > dv) {
    gu = su;
    return du;
  }
  gv = sv;
  return dv;
}

double cylinder_distance(const Vec3& p, double radius, double height, Vec3& normal) {
  const double r = length(p.x(), p.y());
  double gr = 0.0;
  double gz = 0.0;
  const double d = rectangle_distance(r, p.z() - 0.5 * height, radius, 0.5 * height, gr, gz);
  normal = r > 0.0 ? Vec3(gr * p.x() / r, gr * p.y() / r, gz) : Vec3(gr, 0.0, gz);
  return d;
}

double cone_distance(const Vec3& p, double radius, double height, Vec3& normal) {
  const double r = length(p.x(), p.y());
  const Vec2 q(r, p.z());
  const Vec2 base(std::min(r, radius), 0.0);
  const Vec2 slant(-radius, height);
  const double s = std::clamp((q - Vec2(radius, 0.0)).dot(slant) / slant.squaredNorm(), 0.0, 1.0);
  const Vec2 side = Vec2(radius, 0.0) + s * slant;
  const Vec2 outward = Vec2(height, radius).normalized();
  const bool inside = p.z() >= 0.0 && outward.dot(q - Vec2(radius, 0.0)) <= 0.0;
  const double to_base = (q - base).norm();
  const double to_side = (q - side).norm();
  Vec2 g = to_base < to_side ? Vec2(0.0, -1.0) : outward;
  const double d = std::min(to_base, to_side);
  if (!inside && d > 0.0) g = (to_base < to_side ? Vec2(q - base) : Vec2(q - side)) / d;
  normal = r > 0.0 ? Vec3(g.x() * p.x() / r, g.x() * p.y() / r, g.y()) : Vec3(g.x(), 0.0, g.y());
  return inside ? -d : d;
}

double box_distance(const Vec3& p, const Vec3& half, Vec3& normal) {
  const Vec3 d = p.cwiseAbs() - half;
  const Vec3 sign = p.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; });
  const Vec3 outside = d.cwiseMax(0.0);
  const double far = outside.norm();
  if (far > 0.0) {
    normal = sign.cwiseProduct(outside) / far;
    return far;
  }
  Eigen::Index axis = 0;
  const double depth = d.maxCoeff(&axis);
  normal.setZero();
  normal[axis] = sign[axis];
  return depth;
}

}  // namespace

ObstacleField::ObstacleField(std::shared_ptr<const World> world, const VehicleLimits& limits)
    : world_(std::move(world)), radius_m_(with_reserve(limits.clearance_m())) {
  set_slope_share(0.0);
  for (const Obstacle& obstacle : world_->obstacles()) {
    Solid solid;
    solid.id = obstacle.id;
    solid.velocity_mps = obstacle.velocity_mps;
    solid.position_m = obstacle.position_at(0.0);
    solid.valid_until_s = obstacle.valid_until_s;
    solid.required_m = with_reserve(limits.clearance_m() + obstacle.margin_m);
    anything_moves_ = anything_moves_ || obstacle.moves() || std::isfinite(obstacle.valid_until_s);
    double yaw = 0.0;
    if (const auto* sphere = std::get_if<Sphere>(&obstacle.shape)) {
      solid.radius_m = sphere->radius_m;
    } else if (const auto* cylinder = std::get_if<Cylinder>(&obstacle.shape)) {
      solid.kind = Kind::kCylinder;
      solid.radius_m = cylinder->radius_m;
      solid.height_m = cylinder->height_m;
    } else if (const auto* cone = std::get_if<Cone>(&obstacle.shape)) {
      solid.kind = Kind::kCone;
      solid.radius_m = cone->radius_m;
      solid.height_m = cone->height_m;
    } else if (const auto* box = std::get_if<Box>(&obstacle.shape)) {
      solid.kind = Kind::kBox;
      solid.half_m = 0.5 * box->size_m;
      yaw = box->yaw_rad;
    } else if (const auto* mesh = std::get_if<ConvexMesh>(&obstacle.shape)) {
      solid.kind = Kind::kMesh;
      solid.first_support = supports_.size();
      yaw = mesh->yaw_rad;
      for (const Vec3& direction : directions()) {
        double support = -std::numeric_limits<double>::infinity();
        for (const Vec3& v : mesh->vertices_m) support = std::max(support, direction.dot(v));
        supports_.push_back(support);
      }
    }
    solid.cos_yaw = std::cos(yaw);
    solid.sin_yaw = std::sin(yaw);
    const Extent box = extent(obstacle.shape);
    solid.half_extent_m = 0.5 * (box.max_m - box.min_m);
    solid.ball_offset_m = 0.5 * (box.min_m + box.max_m);
    solid.ball_radius_m = std::min(0.5 * (box.max_m - box.min_m).norm(),
                                   bounding_radius_m(obstacle.shape) + solid.ball_offset_m.norm());
    if (solid.kind == Kind::kSphere) solid.ball_radius_m = solid.radius_m;
    solids_.push_back(solid);
  }
}

Vec3 ObstacleField::ball_center_m(std::size_t i, double time_s) const {
  const Solid& solid = solids_[i];
  return solid.position_m + solid.velocity_mps * time_s + solid.ball_offset_m;
}

double ObstacleField::half_width_m(std::size_t i, const Vec3& direction) const {
  return std::min(solids_[i].ball_radius_m, solids_[i].half_extent_m.dot(direction.cwiseAbs()));
}

double ObstacleField::mesh_distance(const Solid& solid, const Vec3& p, Vec3& normal) const {
  double greatest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < kDirections; ++k) {
    const double d = directions()[k].dot(p) - supports_[solid.first_support + k];
    if (d > greatest) {
      greatest = d;
      normal = directions()[k];
    }
  }
  return greatest;
}

double ObstacleField::signed_distance(const Solid& solid, const Vec3& p, Vec3& normal) const {
  switch (solid.kind) {
    case Kind::kSphere: {
      const double d = p.norm();
      normal = d > 0.0 ? Vec3(p / d) : Vec3(Vec3::UnitZ());
      return d - solid.radius_m;
    }
    case Kind::kCylinder:
      return cylinder_distance(p, solid.radius_m, solid.height_m, normal);
    case Kind::kCone:
      return cone_distance(p, solid.radius_m, solid.height_m, normal);
    case Kind::kBox:
      return box_distance(p, solid.half_m, normal);
    case Kind::kMesh:
      break;
  }
  return mesh_distance(solid, p, normal);
}

bool ObstacleField::near(std::size_t i, const Vec3& a, double t0_s, const Vec3& b, double t1_s,
                         double cap_m) const {
  const Solid& solid = solids_[i];
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
  const Solid& solid = solids_[i];
  const double end_s = std::min(t1_s, std::max(t0_s, solid.valid_until_s));
  const double share = t1_s > t0_s ? (end_s - t0_s) / (t1_s - t0_s) : 1.0;
  const auto turned = [&](const Vec3& v) {
    return Vec3(solid.cos_yaw * v.x() + solid.sin_yaw * v.y(), solid.cos_yaw * v.y() - solid.sin_yaw * v.x(),
                v.z());
  };
  const Vec3 p = turned(a - solid.position_m - solid.velocity_mps * t0_s);
  const Vec3 d = turned(share * (b - a) - solid.velocity_mps * (end_s - t0_s));
  Approach result;
  double s = 0.0;
  if (solid.kind == Kind::kSphere) {
    const double length2 = d.squaredNorm();
    s = length2 > 0.0 ? std::clamp(-p.dot(d) / length2, 0.0, 1.0) : 0.0;
    result.signed_distance_m = signed_distance(solid, p + s * d, result.normal);
  } else {
    // The signed distance to a convex solid is convex along the segment: its slope changes sign once.
    double lo = 0.0;
    double hi = 1.0;
    result.signed_distance_m = std::numeric_limits<double>::infinity();
    const auto probe = [&](double at) {
      Vec3 normal;
      const double distance = signed_distance(solid, p + at * d, normal);
      if (distance < result.signed_distance_m) {
        result.signed_distance_m = distance;
        result.normal = normal;
        s = at;
      }
      return normal.dot(d);
    };
    if (probe(0.0) < 0.0 && probe(1.0) > 0.0) {
      for (int k = 0; k < kBisections; ++k) {
        const double middle = 0.5 * (lo + hi);
        (probe(middle) < 0.0 ? lo : hi) = middle;
      }
    }
  }
  result.fraction = s * share;
  const Vec3 n = result.normal;
  result.normal = Vec3(solid.cos_yaw * n.x() - solid.sin_yaw * n.y(),
                       solid.cos_yaw * n.y() + solid.sin_yaw * n.x(), n.z());
  return result;
}

double ObstacleField::violation_m(std::size_t i, const Vec3& a, double t0_s, const Vec3& b,
                                  double t1_s) const {
  if (!near(i, a, t0_s, b, t1_s, 0.0)) return 0.0;
  return std::max(0.0, solids_[i].required_m - approach(i, a, t0_s, b, t1_s).signed_distance_m);
}

double ObstacleField::violation_m(const Vec3& a, double t0_s, const Vec3& b, double t1_s) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < solids_.size(); ++i) sum += violation_m(i, a, t0_s, b, t1_s);
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
  return std::max(0.0, ground_clearance_m_ - terrain.min_height_above(a, b));
}

}  // namespace swallowtail::planner
