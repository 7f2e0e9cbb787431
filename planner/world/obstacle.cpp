#include "planner/world/obstacle.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/base/checks.hpp"

namespace swallowtail::planner {
namespace {

constexpr double kMaxSize_m = 1e5;
constexpr double kMaxSpeed_mps = 200.0;
/// A mesh thinner than this share of its width counts as flat.
constexpr double kMinThickness = 1e-6;

bool is_size(double v) { return is_positive(v) && v <= kMaxSize_m; }

Vec3 turned(const Vec3& v, double yaw_rad) {
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

/// Whether the vertices span a volume: the farthest from the first, the farthest from that line, the farthest
/// from that plane.
bool has_volume(const std::vector<Vec3>& vertices) {
  const Vec3& origin = vertices.front();
  const auto farthest = [&](auto&& distance) {
    return *std::max_element(vertices.begin(), vertices.end(),
                             [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
  };
  const Vec3 along = farthest([&](const Vec3& v) { return (v - origin).norm(); }) - origin;
  const double width = along.norm();
  if (!(width > 0.0)) return false;
  const Vec3 normal =
      along.cross(farthest([&](const Vec3& v) { return along.cross(v - origin).norm(); }) - origin);
  if (!(normal.norm() > kMinThickness * width * width)) return false;
  const Vec3 unit = normal.normalized();
  const auto off_plane = [&](const Vec3& v) { return std::abs(unit.dot(v - origin)); };
  return off_plane(farthest(off_plane)) > kMinThickness * width;
}

/// What is wrong with a shape; empty where nothing is.
struct ShapeFault {
  std::string operator()(const Sphere& s) const {
    return is_size(s.radius_m) ? "" : fmt::format("its radius is {} m", s.radius_m);
  }
  std::string operator()(const Cylinder& c) const { return round_body(c.radius_m, c.height_m); }
  std::string operator()(const Cone& c) const { return round_body(c.radius_m, c.height_m); }
  std::string operator()(const Box& b) const {
    if (!is_finite(b.yaw_rad)) return "its yaw is not finite";
    const bool good = is_size(b.size_m.x()) && is_size(b.size_m.y()) && is_size(b.size_m.z());
    return good ? "" : fmt::format("its size is {} × {} × {} m", b.size_m.x(), b.size_m.y(), b.size_m.z());
  }
  std::string operator()(const ConvexMesh& m) const {
    if (!is_finite(m.yaw_rad)) return "its yaw is not finite";
    if (m.vertices_m.size() < 4 || m.vertices_m.size() > kMaxVertices) {
      return fmt::format("it has {} vertices; 4 … {} are allowed", m.vertices_m.size(), kMaxVertices);
    }
    for (const Vec3& v : m.vertices_m) {
      if (!is_finite(v) || v.norm() > kMaxSize_m)
        return fmt::format("a vertex is at ({}, {}, {}) m", v.x(), v.y(), v.z());
    }
    return has_volume(m.vertices_m) ? "" : "its vertices lie in one plane";
  }

 private:
  static std::string round_body(double radius_m, double height_m) {
    if (!is_size(radius_m)) return fmt::format("its radius is {} m", radius_m);
    return is_size(height_m) ? "" : fmt::format("its height is {} m", height_m);
  }
};

struct BoundingRadius {
  double operator()(const Sphere& s) const { return s.radius_m; }
  double operator()(const Cylinder& c) const { return std::hypot(c.radius_m, c.height_m); }
  double operator()(const Cone& c) const { return std::max(c.radius_m, c.height_m); }
  double operator()(const Box& b) const { return 0.5 * b.size_m.norm(); }
  double operator()(const ConvexMesh& m) const {
    double radius = 0.0;
    for (const Vec3& v : m.vertices_m) radius = std::max(radius, v.norm());
    return radius;
  }
};

struct ExtentOf {
  Extent operator()(const Sphere& s) const {
    return {Vec3::Constant(-s.radius_m), Vec3::Constant(s.radius_m)};
  }
  Extent operator()(const Cylinder& c) const { return standing(c.radius_m, c.height_m); }
  Extent operator()(const Cone& c) const { return standing(c.radius_m, c.height_m); }
  Extent operator()(const Box& b) const {
    const Vec3 h = 0.5 * b.size_m;
    const double c = std::abs(std::cos(b.yaw_rad));
    const double s = std::abs(std::sin(b.yaw_rad));
    const Vec3 half(c * h.x() + s * h.y(), s * h.x() + c * h.y(), h.z());
    return {-half, half};
  }
  Extent operator()(const ConvexMesh& m) const {
    if (m.vertices_m.empty()) return {};
    Extent e{turned(m.vertices_m.front(), m.yaw_rad), turned(m.vertices_m.front(), m.yaw_rad)};
    for (const Vec3& v : m.vertices_m) {
      e.min_m = e.min_m.cwiseMin(turned(v, m.yaw_rad));
      e.max_m = e.max_m.cwiseMax(turned(v, m.yaw_rad));
    }
    return e;
  }

 private:
  static Extent standing(double radius_m, double height_m) {
    return {Vec3(-radius_m, -radius_m, 0.0), Vec3(radius_m, radius_m, height_m)};
  }
};

}  // namespace

Status validate(const Obstacle& obstacle) {
  const auto fault = [&](const std::string& what) {
    return bad_input(fmt::format("Obstacle {} is refused: {}.", obstacle.id, what));
  };
  if (const std::string shape = std::visit(ShapeFault{}, obstacle.shape); !shape.empty()) {
    return fault(fmt::format("{} (sizes must be positive and at most {:g} m)", shape, kMaxSize_m));
  }
  if (!is_finite(obstacle.position_m)) return fault("its position is not finite");
  if (!is_finite(obstacle.velocity_mps) || obstacle.velocity_mps.norm() > kMaxSpeed_mps) {
    return fault(fmt::format("its speed is {} m/s; at most {} m/s is allowed", obstacle.velocity_mps.norm(),
                             kMaxSpeed_mps));
  }
  if (!is_finite(obstacle.state_time_s)) return fault("its state time is not finite");
  if (std::isnan(obstacle.valid_until_s)) return fault("its valid-until time is not a number");
  if (!is_within(obstacle.margin_m, 0.0, kMaxSize_m)) {
    return fault(fmt::format("its margin is {} m; it must be 0 … {:g} m", obstacle.margin_m, kMaxSize_m));
  }
  if (!is_within(obstacle.relief_m, 0.0, kMaxSize_m)) {
    return fault(fmt::format("its relief is {} m; it must be 0 … {:g} m", obstacle.relief_m, kMaxSize_m));
  }
  return {};
}

double bounding_radius_m(const Shape& shape) { return std::visit(BoundingRadius{}, shape); }

Extent extent(const Shape& shape) { return std::visit(ExtentOf{}, shape); }

}  // namespace swallowtail::planner
