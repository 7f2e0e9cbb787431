#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "planner/base/vec.hpp"
#include "planner/kernels/detail/ball_tree.hpp"
#include "planner/kernels/detail/field_solid.hpp"
#include "planner/path/path.hpp"
#include "planner/world/world.hpp"

namespace swallowtail::planner {

/// How a straight flight comes to one obstacle: signed distance (negative inside) of its centre line to the
/// surface, where along the flight (0 … 1), and the unit normal there, away from the obstacle.
struct Approach {
  double signed_distance_m = 0.0;
  double fraction = 0.0;
  Vec3 normal = Vec3::Zero();
};

/// A World as the optimisers' inner loop wants it: plain arrays, closed-form signed distances, no FCL and no
/// memory taken by a query. Distances to spheres, cylinders, cones and boxes are right to 1e-9 of (flight
/// length + bounding radius); a mesh stands as an intersection of half-spaces that holds it (of kDirections
/// fixed directions; of its own faces and bevels where it is an upright prism), so its distance is never too
/// great. What it calls clear still goes to the certifier. Obstacles have an order of their own: those that
/// stand for ever first, each kind in the order of a tree of bounding balls (in the world's order while they
/// are few).
class ObstacleField {
 public:
  static constexpr std::size_t kDirections = detail::kMeshDirections;

  ObstacleField(std::shared_ptr<const World> world, const VehicleLimits& limits);

  std::size_t size() const { return solids_.size(); }
  const World& world() const { return *world_; }
  bool anything_moves() const { return anything_moves_; }
  std::uint32_t id(std::size_t i) const { return solids_[i].id; }
  bool moves(std::size_t i) const { return solids_[i].velocity_mps != Vec3::Zero(); }
  /// Distance to keep from obstacle i: hull, margins, and a little more than the certifier asks for.
  double required_m(std::size_t i) const { return solids_[i].required_m; }
  /// Centre and radius of a ball that holds obstacle i at that time.
  Vec3 ball_center_m(std::size_t i, double time_s) const;
  double ball_radius_m(std::size_t i) const { return solids_[i].ball_radius_m; }
  /// Greatest distance of obstacle i's points from its ball's centre along a unit direction.
  double half_width_m(std::size_t i, const Vec3& direction) const;

  /// Depth by which the flight from a at t0_s to b at t1_s breaks the distance to obstacle i; 0 if it keeps
  /// it.
  double violation_m(std::size_t i, const Vec3& a, double t0_s, const Vec3& b, double t1_s) const;
  /// The same over all obstacles, in the order of their indexes; only those near are looked at.
  double violation_m(const Vec3& a, double t0_s, const Vec3& b, double t1_s) const;
  /// Calls visit(i) for every obstacle for which near(i, …, cap_m) holds, by rising index. Takes no memory.
  template <class Visit>
  void for_each_near(const Vec3& a, double t0_s, const Vec3& b, double t1_s, double cap_m,
                     Visit&& visit) const {
    const auto leaf = [&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) {
        if (near(i, a, t0_s, b, t1_s, cap_m)) visit(i);
      }
    };
    const detail::TimedHop hop{a, b, t0_s, t1_s};
    standing_tree_.visit_near(hop, cap_m, leaf);
    timed_tree_.visit_near(hop, cap_m,
                           [&](std::size_t first, std::size_t count) { leaf(standing_ + first, count); });
  }
  /// False if the bounding ball already shows that the distance is kept by `cap_m` and more.
  bool near(std::size_t i, const Vec3& a, double t0_s, const Vec3& b, double t1_s, double cap_m) const;
  Approach approach(std::size_t i, const Vec3& a, double t0_s, const Vec3& b, double t1_s) const;

  /// Depth by which the segment breaks the height above ground. What the certifier asks for depends on the
  /// slope nearby; the steepness allowed for here is a share of the steepest slope of all.
  double terrain_violation_m(const Vec3& a, const Vec3& b) const;
  /// 0: allow for level ground, 1: for the steepest slope of the terrain.
  void set_slope_share(double share);
  double ground_clearance_m() const { return ground_clearance_m_; }

  /// How many obstacles stand for ever; they come first.
  std::size_t standing() const { return standing_; }
  /// For the kernels.
  const detail::BallTree& standing_tree() const { return standing_tree_; }
  const std::vector<detail::FieldSolid>& solids() const { return solids_; }
  const std::vector<double>& supports() const { return supports_; }

 private:
  /// Those that stand for ever or the others, in the order of the tree over them.
  detail::BallTree add_solids(const VehicleLimits& limits, bool standing, double time_s);
  /// Of an obstacle that is near.
  double depth_m(std::size_t i, const Vec3& a, double t0_s, const Vec3& b, double t1_s) const;

  std::shared_ptr<const World> world_;
  double radius_m_ = 0.0;
  double ground_clearance_m_ = 0.0;
  bool anything_moves_ = false;
  std::size_t standing_ = 0;
  std::vector<detail::FieldSolid> solids_;
  detail::BallTree standing_tree_;  ///< of the solids' balls, each with the distance to keep
  detail::BallTree timed_tree_;     ///< of those behind the standing ones
  std::vector<double> supports_;
};

}  // namespace swallowtail::planner
