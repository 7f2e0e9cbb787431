#include "planner/world/detail/solid.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace swallowtail::planner::detail {
namespace {

/// Nearest point of the triangle (0, 0), (radius, 0), (0, height) – a cone's half section – to (rho, z), rho
/// ≥ 0.
Vec2 project_on_cone_section(double rho, double z, double radius, double height) {
  if (z <= 0.0) return {std::min(rho, radius), 0.0};
  // Outside the slanted side?
  const double outside = rho * height + z * radius - radius * height;
  if (outside <= 0.0) return {rho, z};
  const Vec2 foot(radius, 0.0);
  const Vec2 slope(-radius, height);
  const double t = std::clamp((Vec2(rho, z) - foot).dot(slope) / slope.squaredNorm(), 0.0, 1.0);
  return foot + t * slope;
}

/// Corners of a simplex and the weights of its point nearest to the origin.
struct Simplex {
  std::array<Vec3, 4> corners;
  std::array<double, 4> weights{};
  std::size_t size = 0;

  Vec3 point() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < size; ++i) sum += weights[i] * corners[i];
    return sum;
  }
  /// Weights, summing to one, of the point of the corners' affine hull nearest to the origin; false if the
  /// corners are dependent.
  bool affine_weights(std::array<double, 4>& out) const {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram(size - 1, size - 1);
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> rhs(size - 1);
    for (std::size_t i = 1; i < size; ++i) {
      const Vec3 edge = corners[i] - corners[0];
      rhs(static_cast<Eigen::Index>(i) - 1) = -edge.dot(corners[0]);
      for (std::size_t j = 1; j < size; ++j) {
        gram(static_cast<Eigen::Index>(i) - 1, static_cast<Eigen::Index>(j) - 1) =
            edge.dot(corners[j] - corners[0]);
      }
    }
    const auto lu = gram.fullPivLu();
    if (!lu.isInvertible()) return false;
    const auto solution = lu.solve(rhs).eval();
    out[0] = 1.0 - solution.sum();
    for (std::size_t i = 1; i < size; ++i) out[i] = solution(static_cast<Eigen::Index>(i) - 1);
    return true;
  }
  void drop(std::size_t index) {
    --size;
    corners[index] = corners[size];
    weights[index] = weights[size];
  }
  /// Wolfe's minor cycle: walks towards the affine minimiser and drops corners until it lies inside. False if
  /// the corners became dependent.
  bool settle() {
    while (size > 1) {
      std::array<double, 4> target{};
      if (!affine_weights(target)) return false;
      double step = 1.0;
      std::size_t leaving = size;
      for (std::size_t i = 0; i < size; ++i) {
        if (target[i] > 0.0) continue;
        const double limit = weights[i] / (weights[i] - target[i]);
        if (leaving == size || limit < step) {
          step = std::min(step, limit);
          leaving = i;
        }
      }
      for (std::size_t i = 0; i < size; ++i) weights[i] += step * (target[i] - weights[i]);
      if (leaving == size) return true;
      drop(leaving);
    }
    weights[0] = 1.0;
    return true;
  }
};

}  // namespace

Vec3 nearest_to_origin(const std::vector<Vec3>& points) {
  constexpr int kMaxCycles = 200;
  Simplex simplex;
  simplex.corners[0] = points.front();
  simplex.weights[0] = 1.0;
  simplex.size = 1;
  Vec3 best = points.front();
  for (int cycle = 0; cycle < kMaxCycles; ++cycle) {
    const Vec3* lowest = &points.front();
    for (const Vec3& p : points) {
      if (best.dot(p) < best.dot(*lowest)) lowest = &p;
    }
    if (best.squaredNorm() - best.dot(*lowest) <= 1e-13 * best.squaredNorm() || simplex.size == 4)
      return best;
    simplex.corners[simplex.size] = *lowest;
    simplex.weights[simplex.size] = 0.0;
    ++simplex.size;
    if (!simplex.settle()) return best;
    const Vec3 next = simplex.point();
    if (!(next.squaredNorm() < best.squaredNorm())) return best;
    best = next;
  }
  return best;
}

Solid::Solid(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    kind_ = Kind::kSphere;
    radius_m_ = sphere->radius_m;
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    kind_ = Kind::kCylinder;
    radius_m_ = cylinder->radius_m;
    height_m_ = cylinder->height_m;
  } else if (const auto* cone = std::get_if<Cone>(&shape)) {
    kind_ = Kind::kCone;
    radius_m_ = cone->radius_m;
    height_m_ = cone->height_m;
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    kind_ = Kind::kBox;
    half_m_ = 0.5 * box->size_m;
    yaw_rad_ = box->yaw_rad;
  } else if (const auto* mesh = std::get_if<ConvexMesh>(&shape)) {
    kind_ = Kind::kMesh;
    vertices_m_ = mesh->vertices_m;
    yaw_rad_ = mesh->yaw_rad;
  }
}

double Solid::support(const Vec3& n) const {
  switch (kind_) {
    case Kind::kSphere:
      return radius_m_ * n.norm();
    case Kind::kCylinder:
      return radius_m_ * n.head<2>().norm() + std::max(0.0, n.z() * height_m_);
    case Kind::kCone:
      return std::max(radius_m_ * n.head<2>().norm(), n.z() * height_m_);
    case Kind::kBox:
      return n.cwiseAbs().dot(half_m_);
    case Kind::kMesh:
      break;
  }
  double greatest = n.dot(vertices_m_.front());
  for (const Vec3& v : vertices_m_) greatest = std::max(greatest, n.dot(v));
  return greatest;
}

Vec3 Solid::project(const Vec3& x) const {
  const double rho = x.head<2>().norm();
  const auto at_section = [&](double to_rho, double to_z) -> Vec3 {
    const double scale = rho > 0.0 ? to_rho / rho : 0.0;
    return {x.x() * scale, x.y() * scale, to_z};
  };
  switch (kind_) {
    case Kind::kSphere:
      return x.norm() > radius_m_ ? Vec3(x * (radius_m_ / x.norm())) : x;
    case Kind::kCylinder:
      return at_section(std::min(rho, radius_m_), std::clamp(x.z(), 0.0, height_m_));
    case Kind::kCone: {
      const Vec2 section = project_on_cone_section(rho, x.z(), radius_m_, height_m_);
      return at_section(section.x(), section.y());
    }
    case Kind::kBox:
      return x.cwiseMax(-half_m_).cwiseMin(half_m_);
    case Kind::kMesh:
      break;
  }
  return project_on_mesh(x);
}

Vec3 Solid::project_on_mesh(const Vec3& x) const {
  std::vector<Vec3> relative;
  relative.reserve(vertices_m_.size());
  for (const Vec3& v : vertices_m_) relative.push_back(v - x);
  return x + nearest_to_origin(relative);
}

}  // namespace swallowtail::planner::detail
