#include "planner/cost/navigation_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace swallowtail::planner::navigation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec2 level(const Vec3& p) { return p.head<2>(); }

double level_distance_m(const Vec2& a, const Vec2& b, const Vec2& point) {
  const Vec2 d = b - a;
  const double squared = d.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((point - a).dot(d) / squared, 0.0, 1.0) : 0.0;
  return (a + t * d - point).norm();
}

double angle_between_rad(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// [NMOPSO F2], infinite in a threat.
double threat(const Scene& scene, const Path& path) {
  const NavigationSpec& spec = scene.spec;
  if (spec.threats.empty()) return 0.0;
  double sum = 0.0;
  for (int j = 0; j < path.segments(); ++j) {
    for (const NavigationSpec::Threat& t : spec.threats) {
      const double d = level_distance_m(level(path.at[j]), level(path.at[j + 1]), t.center_m);
      const double beyond = d - spec.vehicle_size_m - t.radius_m;
      if (beyond <= 0.0) return kInfinity;
      sum += std::max(0.0, 1.0 - beyond / spec.danger_distance_m);
    }
  }
  return sum / static_cast<double>(spec.threats.size() * static_cast<std::size_t>(path.segments()));
}

/// [NMOPSO F3]
double height(const Scene& scene, const Path& path) {
  double sum = 0.0;
  for (int j = 1; j + 1 < path.points; ++j) {
    const double off = std::abs(path.at[j].z() - path.ground_m[j] - scene.middle_m()) / scene.half_band_m();
    if (!(off <= 1.0)) return kInfinity;
    sum += off;
  }
  return sum / (path.points - 2);
}

}  // namespace

bool follow_chain(const Scene& scene, const double* variables, Path& path) {
  const NavigationSpec& spec = scene.spec;
  const int segments = spec.nodes + 1;
  std::array<Vec2, NavigationProblem::kMaxNodes + 1> direction;
  std::array<double, NavigationProblem::kMaxNodes + 1> length;
  std::array<double, NavigationProblem::kMaxNodes + 1> rise;
  double heading = scene.bearing_rad;
  double climb = 0.0;
  Vec2 end = Vec2::Zero();
  for (int j = 0; j < segments; ++j) {
    climb = std::clamp(climb + variables[3 * j + 1], -spec.climb_max_rad, spec.climb_max_rad);
    heading += variables[3 * j + 2];
    direction[j] = Vec2(std::cos(heading), std::sin(heading));
    length[j] = variables[3 * j] * std::cos(climb);
    rise[j] = variables[3 * j] * std::sin(climb);
    end += length[j] * direction[j];
  }
  const Vec2 line = level(spec.goal_m) - level(spec.start_m);
  double scale = line.norm() / end.norm();
  // Segments that the scale would leave too short are lengthened, the others take the rest.
  for (int pass = 0; pass < 3 && std::isfinite(scale); ++pass) {
    const double least = scene.segment_min_m * (1.0 + 1e-6) / scale;
    if (*std::min_element(length.begin(), length.begin() + segments) >= least) break;
    end.setZero();
    for (int j = 0; j < segments; ++j) {
      length[j] = std::max(length[j], least);
      end += length[j] * direction[j];
    }
    scale = line.norm() / end.norm();
  }
  path.points = segments + 1;
  path.at[0] = spec.start_m;
  path.at[segments] = spec.goal_m;
  if (!std::isfinite(scale)) return false;
  // Turns the chain's end onto the goal, complex numbers as rotations.
  const Vec2 turn(scale * (end.x() * line.x() + end.y() * line.y()) / (end.norm() * line.norm()),
                  scale * (end.x() * line.y() - end.y() * line.x()) / (end.norm() * line.norm()));
  double way = 0.0;
  double risen = 0.0;
  for (int j = 0; j < segments; ++j) {
    way += length[j];
    risen += rise[j];
  }
  const double missing = (spec.goal_m.z() - spec.start_m.z() - scale * risen) / way;
  Vec3 at = spec.start_m;
  for (int j = 0; j + 1 < segments; ++j) {
    const Vec2 step = length[j] * direction[j];
    at += Vec3(turn.x() * step.x() - turn.y() * step.y(), turn.x() * step.y() + turn.y() * step.x(),
               scale * rise[j] + missing * length[j]);
    path.at[j + 1] = at;
  }
  return true;
}

void follow_published_chain(const Scene& scene, const double* variables, Path& path) {
  const NavigationSpec& spec = scene.spec;
  path.points = spec.nodes + 2;
  path.at[0] = spec.start_m;
  path.at[spec.nodes + 1] = spec.goal_m;
  double heading = scene.bearing_rad;
  double climb = 0.0;
  const double start_ground_m = scene.ground.height_at(spec.start_m.x(), spec.start_m.y());
  Vec3 at(spec.start_m.x(), spec.start_m.y(), spec.start_m.z() - start_ground_m);
  for (int j = 0; j < spec.nodes; ++j) {
    climb += variables[3 * j + 1];
    heading += variables[3 * j + 2];
    const double r = variables[3 * j];
    at += r * Vec3(std::cos(climb) * std::cos(heading), std::cos(climb) * std::sin(heading), std::sin(climb));
    at.x() = std::clamp(at.x(), spec.box_min_m.x(), spec.box_max_m.x());
    at.y() = std::clamp(at.y(), spec.box_min_m.y(), spec.box_max_m.y());
    at.z() = std::clamp(at.z(), spec.height_min_m, spec.height_max_m);
    path.ground_m[j + 1] = scene.ground.height_at(at.x(), at.y());
    path.at[j + 1] = Vec3(at.x(), at.y(), at.z() + path.ground_m[j + 1]);
  }
}

void write_chain(const Scene& scene, std::span<const Vec3> polyline, double* variables) {
  const NavigationSpec& spec = scene.spec;
  double heading = scene.bearing_rad;
  double climb = 0.0;
  for (std::size_t j = 0; j + 1 < polyline.size(); ++j) {
    const Vec3 d = polyline[j + 1] - polyline[j];
    const double next_heading = std::atan2(d.y(), d.x());
    const double next_climb = std::atan2(d.z(), level(d).norm());
    variables[3 * j] = std::clamp(d.norm(), scene.segment_min_m, scene.segment_max_m);
    variables[3 * j + 1] = std::clamp(next_climb - climb, -spec.climb_max_rad, spec.climb_max_rad);
    variables[3 * j + 2] = std::clamp(wrapped(next_heading - heading), -spec.turn_max_rad, spec.turn_max_rad);
    climb = next_climb;
    heading = next_heading;
  }
}

Eigen::Vector4d measure(const Scene& scene, const Path& path) {
  const Eigen::Vector4d infeasible = Eigen::Vector4d::Constant(kInfinity);
  double length = 0.0;
  double turning = 0.0;
  for (int j = 0; j < path.segments(); ++j) {
    const Vec3 d = path.at[j + 1] - path.at[j];
    const double hop = d.norm();
    if (hop < scene.segment_min_m) return infeasible;
    length += hop;
    if (j > 0) turning += angle_between_rad(path.at[j] - path.at[j - 1], d);
  }
  const double f2 = threat(scene, path);
  const double f3 = height(scene, path);
  if (!std::isfinite(f2) || !std::isfinite(f3)) return infeasible;
  return {1.0 - scene.distance_m / length, f2, f3, turning / ((path.points - 2) * std::numbers::pi)};
}

}  // namespace swallowtail::planner::navigation
