#include "planner/kernels/detail/field_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <variant>

#include "planner/kernels/detail/prism.hpp"

namespace swallowtail::planner::detail {
namespace {

template <class RoundBody>
void set_round_body(FieldSolid& solid, SolidKind kind, const RoundBody& body) {
  solid.kind = kind;
  solid.radius_m = body.radius_m;
  solid.height_m = body.height_m;
  solid.slant_m = std::sqrt(body.radius_m * body.radius_m + body.height_m * body.height_m);
}

void set_yaw(FieldSolid& solid, double yaw_rad) {
  solid.cos_yaw = std::cos(yaw_rad);
  solid.sin_yaw = std::sin(yaw_rad);
}

void set_box(FieldSolid& solid, const Box& box) {
  solid.kind = SolidKind::kBox;
  solid.half_m = 0.5 * box.size_m;
  set_yaw(solid, box.yaw_rad);
}

void set_mesh(FieldSolid& solid, const ConvexMesh& mesh, std::vector<double>& supports) {
  solid.kind = SolidKind::kMesh;
  solid.first_support = supports.size();
  set_yaw(solid, mesh.yaw_rad);
  const std::vector<Vec3> own = prism_directions(mesh);
  const std::span<const Vec3> directions = own.empty() ? std::span<const Vec3>(mesh_directions()) : own;
  for (const Vec3& direction : directions) {
    double support = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : mesh.vertices_m) support = std::max(support, direction.dot(v));
    supports.push_back(support);
  }
  solid.half_spaces = directions.size();
  solid.has_directions = !own.empty();
  for (const Vec3& direction : own) supports.insert(supports.end(), direction.begin(), direction.end());
}

}  // namespace

const std::array<Vec3, kMeshDirections>& mesh_directions() {
  static const auto kTable = [] {
    std::array<Vec3, kMeshDirections> table;
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

bool stands_for_ever(const Obstacle& obstacle) {
  return !obstacle.moves() && obstacle.valid_until_s == std::numeric_limits<double>::infinity();
}

Ball ball_of(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return {Vec3::Zero(), sphere->radius_m};
  const Extent box = extent(shape);
  const Vec3 middle = 0.5 * (box.min_m + box.max_m);
  return {middle, std::min(0.5 * (box.max_m - box.min_m).norm(), bounding_radius_m(shape) + middle.norm())};
}

FieldSolid field_solid(const Obstacle& obstacle, const Ball& ball, double required_m,
                       std::vector<double>& supports) {
  FieldSolid solid;
  solid.id = obstacle.id;
  solid.velocity_mps = obstacle.velocity_mps;
  solid.position_m = obstacle.position_at(0.0);
  solid.valid_until_s = obstacle.valid_until_s;
  solid.required_m = required_m;
  if (const auto* sphere = std::get_if<Sphere>(&obstacle.shape)) solid.radius_m = sphere->radius_m;
  if (const auto* cylinder = std::get_if<Cylinder>(&obstacle.shape))
    set_round_body(solid, SolidKind::kCylinder, *cylinder);
  if (const auto* cone = std::get_if<Cone>(&obstacle.shape)) set_round_body(solid, SolidKind::kCone, *cone);
  if (const auto* box = std::get_if<Box>(&obstacle.shape)) set_box(solid, *box);
  if (const auto* mesh = std::get_if<ConvexMesh>(&obstacle.shape)) set_mesh(solid, *mesh, supports);
  const Extent box = extent(obstacle.shape);
  solid.half_extent_m = 0.5 * (box.max_m - box.min_m);
  solid.ball_offset_m = ball.offset_m;
  solid.ball_radius_m = ball.radius_m;
  return solid;
}

}  // namespace swallowtail::planner::detail
