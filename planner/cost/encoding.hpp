#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/cost/path_batch.hpp"
#include "planner/cost/scene.hpp"
#include "planner/swarm/problem.hpp"

namespace swallowtail::planner {

enum class EncodingKind : std::uint8_t {
  /// (x, y, z) of each waypoint in metres, in the world's bounds, which are cut where they are farther from
  /// the
  /// ends than start and goal from each other: what [BOA] and [PSO] publish.
  kBox,
  /// Metres along and across the level line from start to goal, and above the ground at the nearest raster
  /// sample,
  /// within a band: for costs that count heights from the ground [SPSO].
  kAboveGround,
  /// Waypoint i lies on the i-th of k equally spaced planes across start–goal; two variables each, metres
  /// along
  /// the plane's axes [IBABC Eq. 1].
  kPlanes,
  /// Waypoint i is start + D·(x e1 + y e2 + z e3), D = start to goal, e1 along it, e2 level: variables
  /// without
  /// a unit. A scene that is shifted, turned about the vertical or scaled gives the same search.
  kFrame,
};

/// Waypoints as variables and back. A waypoint outside the world's bounds is moved to the nearest point
/// inside.
class Encoding {
 public:
  struct Band {
    double min_m = 0.0;
    double max_m = 0.0;
  };

  /// `band` is for kAboveGround. Error: the box of some variable has no room.
  static Result<Encoding> make(EncodingKind kind, std::shared_ptr<const CostScene> scene, int waypoints,
                               const Band& band);

  EncodingKind kind() const { return kind_; }
  int waypoints() const { return waypoints_; }
  const Vec3& start_m() const { return start_m_; }
  const Vec3& goal_m() const { return scene_->goal_m; }
  Eigen::Index dimension() const { return lower_.size(); }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  /// Start and goal in the variables' frame; none for planes.
  std::optional<swarm::WaypointLayout> layout() const;

  Vec3 waypoint(const double* candidate, int index) const;
  /// Nearest candidate within the box.
  Eigen::VectorXd encode(std::span<const Vec3> waypoints) const;
  /// Both ends and the waypoints into one lane.
  void place(const double* candidate, int lane, PathBatch& paths) const;

 private:
  Encoding() = default;
  void size_above_ground(const Band& band);
  Vec3 above_ground(const Vec3& p) const;
  void size_box();
  void size_planes();
  void size_frame();

  EncodingKind kind_ = EncodingKind::kBox;
  int waypoints_ = 0;
  std::shared_ptr<const CostScene> scene_;
  Vec3 start_m_ = Vec3::Zero();
  Bounds bounds_;
  double distance_m_ = 0.0;
  Eigen::Matrix3d frame_ = Eigen::Matrix3d::Identity();  ///< columns e1, e2, e3
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
};

}  // namespace swallowtail::planner
