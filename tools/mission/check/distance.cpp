#include "tools/mission/check/distance.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::check {
namespace {

double dot(const P3& a, const P3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
P3 minus(const P3& a, const P3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
P3 toward(const P3& a, const P3& b, double s) {
  return {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), a.z + s * (b.z - a.z)};
}

double to_cylinder(const P3& p, double radius, double height) {
  const double out = std::max(std::hypot(p.x, p.y) - radius, 0.0);
  const double over = std::max({p.z - height, -p.z, 0.0});
  return std::hypot(out, over);
}

/// In the half plane (distance from the axis, height) a cone is a right triangle.
double to_cone(const P3& p, double radius, double height) {
  const double rho = std::hypot(p.x, p.y);
  if (p.z <= 0.0) return std::hypot(std::max(rho - radius, 0.0), p.z);
  if (rho <= radius * (1.0 - p.z / height)) return 0.0;
  const double along = (rho - radius) * -radius + p.z * height;
  const double s = std::clamp(along / (radius * radius + height * height), 0.0, 1.0);
  return std::hypot(rho - radius * (1.0 - s), p.z - s * height);
}

double to_box(const P3& p, const P3& size) {
  return std::hypot(std::max(std::abs(p.x) - size.x / 2, 0.0), std::max(std::abs(p.y) - size.y / 2, 0.0),
                    std::max(std::abs(p.z) - size.z / 2, 0.0));
}

/// Least norm over the hull of (vertices − p): Wolfe-free, by Frank–Wolfe steps with exact line search, which
/// close in on it from outside; the support bound gives what is certain.
double to_hull(const P3& p, const std::vector<P3>& vertices) {
  if (vertices.empty()) return std::numeric_limits<double>::infinity();
  P3 nearest = minus(vertices.front(), p);
  double certain = 0.0;
  for (int step = 0; step < 2000; ++step) {
    const double norm2 = dot(nearest, nearest);
    if (norm2 < 1e-12) return 0.0;
    const P3* support = &vertices.front();
    for (const P3& v : vertices) {
      if (dot(minus(v, p), nearest) < dot(minus(*support, p), nearest)) support = &v;
    }
    const P3 corner = minus(*support, p);
    certain = std::max(certain, dot(corner, nearest) / std::sqrt(norm2));
    const P3 edge = minus(corner, nearest);
    const double edge2 = dot(edge, edge);
    if (edge2 < 1e-18 || std::sqrt(norm2) - certain < 1e-3) break;
    nearest = toward(nearest, corner, std::clamp(-dot(nearest, edge) / edge2, 0.0, 1.0));
  }
  return std::max(certain, 0.0);
}

P3 turned(const P3& p, double yaw_rad) {
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  return {c * p.x + s * p.y, -s * p.x + c * p.y, p.z};
}

}  // namespace

double distance_m(const Solid& solid, const P3& point, double time_s) {
  const double age = time_s - solid.since_s;
  const P3 local = {point.x - solid.at.x - solid.velocity_mps.x * age,
                    point.y - solid.at.y - solid.velocity_mps.y * age,
                    point.z - solid.at.z - solid.velocity_mps.z * age};
  switch (solid.shape) {
    case data::ObstacleShape::kSphere:
      return std::max(std::sqrt(dot(local, local)) - solid.radius_m, 0.0);
    case data::ObstacleShape::kCylinder:
      return to_cylinder(local, solid.radius_m, solid.height_m);
    case data::ObstacleShape::kCone:
      return to_cone(local, solid.radius_m, solid.height_m);
    case data::ObstacleShape::kBox:
      return to_box(turned(local, solid.yaw_rad), solid.size_m);
    case data::ObstacleShape::kMesh:
      return to_hull(turned(local, solid.yaw_rad), solid.vertices);
  }
  return 0.0;
}

}  // namespace swallowtail::check
