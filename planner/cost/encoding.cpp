#include "planner/cost/encoding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace swallowtail::planner {
namespace {

Eigen::Matrix3d frame_along(const Vec3& line) {
  Eigen::Matrix3d frame;
  const Vec3 e1 = line.normalized();
  const double level = std::hypot(e1.x(), e1.y());
  frame.col(0) = e1;
  frame.col(1) = level > 1e-9 ? Vec3(-e1.y() / level, e1.x() / level, 0.0) : Vec3(Vec3::UnitY());
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

/// The level part of a direction; east where it has none.
Vec3 level(const Vec3& direction) {
  const Vec3 flat(direction.x(), direction.y(), 0.0);
  return flat == Vec3::Zero() ? Vec3(Vec3::UnitX()) : flat;
}

}  // namespace

Result<Encoding> Encoding::make(EncodingKind kind, std::shared_ptr<const CostScene> scene, int waypoints,
                                const Band& band) {
  Encoding encoding;
  encoding.kind_ = kind;
  encoding.waypoints_ = waypoints;
  encoding.start_m_ = scene->start_m;
  encoding.bounds_ = scene->world->bounds();
  encoding.distance_m_ = scene->distance_m;
  encoding.frame_ = frame_along(scene->goal_m - scene->start_m);
  encoding.scene_ = std::move(scene);
  switch (kind) {
    case EncodingKind::kBox:
      encoding.size_box();
      break;
    case EncodingKind::kAboveGround:
      encoding.frame_ = frame_along(level(encoding.scene_->goal_m - encoding.start_m_));
      encoding.size_above_ground(band);
      break;
    case EncodingKind::kPlanes:
      encoding.size_planes();
      break;
    case EncodingKind::kFrame:
      encoding.size_frame();
      break;
  }
  for (Eigen::Index i = 0; i < encoding.dimension(); ++i) {
    if (!(encoding.lower_[i] < encoding.upper_[i])) {
      return bad_input("The box of the waypoints is empty: variable " + std::to_string(i) + " has " +
                       std::to_string(encoding.lower_[i]) + " to " + std::to_string(encoding.upper_[i]) +
                       " m; the bounds must hold start, goal and room around them.");
    }
  }
  return encoding;
}

void Encoding::size_box() {
  const Vec3 room = Vec3::Constant(distance_m_);
  const Vec3 lower = bounds_.min_m.cwiseMax(start_m_.cwiseMin(scene_->goal_m) - room);
  const Vec3 upper = bounds_.max_m.cwiseMin(start_m_.cwiseMax(scene_->goal_m) + room);
  lower_ = lower.replicate(waypoints_, 1);
  upper_ = upper.replicate(waypoints_, 1);
}

void Encoding::size_above_ground(const Band& band) {
  constexpr double kBeyond = 0.25;
  constexpr double kAside = 0.75;
  lower_ = Vec3(-kBeyond * distance_m_, -kAside * distance_m_, band.min_m).replicate(waypoints_, 1);
  upper_ = Vec3((1.0 + kBeyond) * distance_m_, kAside * distance_m_, band.max_m).replicate(waypoints_, 1);
}

/// The bounds as seen along start–goal, at most D to each side.
void Encoding::size_planes() {
  Vec2 lower = Vec2::Constant(distance_m_);
  Vec2 upper = Vec2::Constant(-distance_m_);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1) != 0 ? bounds_.max_m.x() : bounds_.min_m.x(),
                 (corner & 2) != 0 ? bounds_.max_m.y() : bounds_.min_m.y(),
                 (corner & 4) != 0 ? bounds_.max_m.z() : bounds_.min_m.z());
    const Vec2 seen = (frame_.transpose() * (p - start_m_)).tail<2>();
    lower = lower.cwiseMin(seen);
    upper = upper.cwiseMax(seen);
  }
  lower = lower.cwiseMax(-distance_m_);
  upper = upper.cwiseMin(distance_m_);
  lower_ = lower.replicate(waypoints_, 1);
  upper_ = upper.replicate(waypoints_, 1);
}

/// Wide enough to pass the obstacles near the straight line on either side, and above or below those that are
/// not much higher than wide.
void Encoding::size_frame() {
  const CostScene& scene = *scene_;
  constexpr double kLeast = 0.25;
  constexpr double kRoom = 1.6;
  constexpr double kHigherThanWide = 1.5;
  double spread = kLeast;
  double rise = kLeast;
  for (std::size_t i = 0; i < scene.field.size(); ++i) {
    if (!scene.field.near(i, scene.start_m, 0.0, scene.goal_m, 0.0, 0.0)) continue;
    const auto reach = [&](Eigen::Index axis) {
      const Vec3 direction = frame_.col(axis);
      const double off = std::abs(direction.dot(scene.field.ball_center_m(i, 0.0) - scene.start_m));
      return kRoom * (off + scene.field.half_width_m(i, direction) + scene.field.required_m(i)) / distance_m_;
    };
    spread = std::max(spread, reach(1));
    rise = std::max(rise, reach(2));
  }
  rise = std::min(rise, kHigherThanWide * spread);
  const Vec3 half(0.5 * std::min(spread, rise), spread, rise);
  lower_ = Vec3(-half).replicate(waypoints_, 1);
  upper_ = Vec3(half + Vec3::UnitX()).replicate(waypoints_, 1);
}

std::optional<swarm::WaypointLayout> Encoding::layout() const {
  if (kind_ == EncodingKind::kBox) return swarm::WaypointLayout{start_m_, scene_->goal_m};
  if (kind_ == EncodingKind::kAboveGround) {
    return swarm::WaypointLayout{above_ground(start_m_), above_ground(scene_->goal_m)};
  }
  if (kind_ == EncodingKind::kFrame) return swarm::WaypointLayout{Vec3::Zero(), Vec3::UnitX()};
  return std::nullopt;
}

Vec3 Encoding::above_ground(const Vec3& p) const {
  Vec3 local = frame_.transpose() * (p - start_m_);
  local.z() = p.z() - scene_->nearest_ground_m(p.x(), p.y());
  return local;
}

Vec3 Encoding::waypoint(const double* candidate, int index) const {
  Vec3 p;
  if (kind_ == EncodingKind::kPlanes) {
    const double along = distance_m_ * (index + 1) / (waypoints_ + 1);
    const double* v = candidate + 2 * index;
    p = start_m_ + frame_ * Vec3(along, v[0], v[1]);
  } else {
    const double* v = candidate + 3 * index;
    p = Vec3(v[0], v[1], v[2]);
    if (kind_ == EncodingKind::kFrame) p = start_m_ + frame_ * (distance_m_ * p);
  }
  if (kind_ == EncodingKind::kAboveGround) {
    Vec3 q = start_m_ + frame_ * Vec3(p.x(), p.y(), 0.0);
    q = q.cwiseMax(bounds_.min_m).cwiseMin(bounds_.max_m);
    p = Vec3(q.x(), q.y(), p.z() + scene_->nearest_ground_m(q.x(), q.y()));
  }
  return p.cwiseMax(bounds_.min_m).cwiseMin(bounds_.max_m);
}

Eigen::VectorXd Encoding::encode(std::span<const Vec3> waypoints) const {
  Eigen::VectorXd candidate(dimension());
  for (int i = 0; i < waypoints_; ++i) {
    const Vec3& p = waypoints[static_cast<std::size_t>(i)];
    const Vec3 local = frame_.transpose() * (p - start_m_);
    if (kind_ == EncodingKind::kBox) candidate.segment<3>(3 * i) = p;
    if (kind_ == EncodingKind::kAboveGround) candidate.segment<3>(3 * i) = above_ground(p);
    if (kind_ == EncodingKind::kPlanes) candidate.segment<2>(2 * i) = local.tail<2>();
    if (kind_ == EncodingKind::kFrame) candidate.segment<3>(3 * i) = local / distance_m_;
  }
  return candidate.cwiseMax(lower_).cwiseMin(upper_);
}

void Encoding::place(const double* candidate, int lane, PathBatch& paths) const {
  paths.set(0, lane, start_m_);
  for (int i = 0; i < waypoints_; ++i) {
    paths.set(static_cast<std::size_t>(i) + 1, lane, waypoint(candidate, i));
  }
  paths.set(static_cast<std::size_t>(waypoints_) + 1, lane, scene_->goal_m);
}

}  // namespace swallowtail::planner
