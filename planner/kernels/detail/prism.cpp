#include "planner/kernels/detail/prism.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace swallowtail::planner::detail {
namespace {

constexpr std::size_t kMostSides = 24;
constexpr double kWidestBevel_rad = std::numbers::pi / 6.0;

bool before(const Vec2& a, const Vec2& b) { return std::tuple(a.x(), a.y()) < std::tuple(b.x(), b.y()); }

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The points at a height, sorted.
std::vector<Vec2> level_points(const ConvexMesh& mesh, double z) {
  std::vector<Vec2> points;
  for (const Vec3& v : mesh.vertices_m) {
    if (v.z() == z) points.push_back(v.head<2>());
  }
  std::ranges::sort(points, before);
  return points;
}

/// Anticlockwise [ANDREW]; of sorted points.
std::vector<Vec2> hull_of(const std::vector<Vec2>& points) {
  std::vector<Vec2> hull;
  const auto add = [&hull](const Vec2& p, std::size_t kept) {
    while (hull.size() > kept && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const Vec2& p : points) add(p, 1);
  const std::size_t lower = hull.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  hull.pop_back();
  return hull;
}

}  // namespace

std::vector<Vec3> prism_directions(const ConvexMesh& mesh) {
  const auto by_height = [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); };
  const auto [low, high] = std::ranges::minmax_element(mesh.vertices_m, by_height);
  const std::vector<Vec2> points = level_points(mesh, low->z());
  if (2 * points.size() != mesh.vertices_m.size() || points != level_points(mesh, high->z())) return {};
  const std::vector<Vec2> hull = hull_of(points);
  if (hull.size() < 3 || hull.size() > kMostSides) return {};
  std::vector<Vec3> out{Vec3::UnitZ(), -Vec3::UnitZ()};
  const auto normal_rad = [&hull](std::size_t side) {
    const Vec2 along = hull[(side + 1) % hull.size()] - hull[side % hull.size()];
    return std::atan2(-along.x(), along.y());
  };
  for (std::size_t side = 0; side < hull.size(); ++side) {
    const double from = normal_rad(side);
    const double turn = std::remainder(normal_rad(side + 1) - from, 2.0 * std::numbers::pi);
    const double parts = std::max(1.0, std::ceil(turn / kWidestBevel_rad - 1e-9));
    for (double k = 0.0; k < parts; k += 1.0) {
      const double angle = from + turn * k / parts;
      out.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    for (const double up : {1.0, -1.0})
      out.push_back(Vec3(std::cos(from), std::sin(from), up) / std::numbers::sqrt2);
  }
  return out;
}

}  // namespace swallowtail::planner::detail
