#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "planner/kernels/obstacle_field.hpp"
#include "planner/swarm/problem.hpp"

namespace swallowtail::planner {

/// From where and when to where.
struct DetourEnds {
  Vec3 from_m = Vec3::Zero();
  Vec3 to_m = Vec3::Zero();
  double from_time_s = 0.0;
  /// Directions of flight before and after; zero where there is none to turn from or into.
  Vec3 before = Vec3::Zero();
  Vec3 after = Vec3::Zero();
};

enum class DetourObjective : std::uint8_t { kLength, kTime };

/// Paths of k waypoints between two points, as variables for an optimiser.
///
/// Encoding: waypoint i is from + D·(x_i e1 + y_i e2 + z_i e3), with D the distance and (e1, e2, e3) a frame
/// along from–to (e2 level, e3 = e1 × e2). So variables have no unit, and a scene that is shifted, turned
/// about the vertical or scaled gives the same search. Waypoints are clamped to the world's bounds, a box
/// being convex. Cost: length ÷ D (or time × cruise speed ÷ D) + kPenalty · depth ÷ D, summed over hops and
/// obstacles with the depth of the exact segment distance [BOA Eq. 12 as corrected], and over the ground [BOA
/// Eq. 14]; moving obstacles are met at the time the flight is there at cruise speed. Departs from [BOA Eq.
/// 16]: the penalty is linear and its weight constant, large enough for its minimum to be free of violations.
/// A hop steeper than climb_max_rad counts as it is flown: a vertical part and one of the steepest slope
/// (`as_flown`).
class DetourProblem {
 public:
  static constexpr double kPenalty = 10.0;

  DetourProblem(const ObstacleField& field, const VehicleLimits& limits, const DetourEnds& ends,
                int waypoints, DetourObjective objective);

  /// The optimiser's form; it borrows this. The box is the natural one, widened by a factor: wide enough to
  /// pass the obstacles near the straight line on either side, and above or below those that are not much
  /// higher than wide.
  swarm::Problem in_box(double factor) const;

  int waypoints() const { return waypoints_; }
  double distance_m() const { return distance_m_; }
  const ObstacleField& field() const { return field_; }
  const DetourEnds& ends() const { return ends_; }
  const VehicleLimits& limits() const { return limits_; }
  DetourObjective objective() const { return objective_; }

  Vec3 decode(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index waypoint) const;
  std::vector<Vec3> decode(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  Eigen::VectorXd encode(const std::vector<Vec3>& waypoints) const;  ///< as many as waypoints()
  /// A direction from the frame to the world, and back.
  const Eigen::Matrix3d& frame() const { return frame_; }

  struct Cost {
    double length_m = 0.0;
    double duration_s = 0.0;
    double violation_m = 0.0;
  };
  Cost cost(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  /// Of any number of waypoints between the ends.
  Cost cost(std::span<const Vec3> waypoints) const;
  double value(const Cost& cost) const;

 private:
  struct Progress;
  void fly(Progress& progress, const Vec3& to) const;
  void hop(Progress& progress, const Vec3& to) const;
  Cost finish(Progress& progress) const;
  void size_box();

  const ObstacleField& field_;
  VehicleLimits limits_;
  DetourEnds ends_;
  int waypoints_;
  DetourObjective objective_;
  double distance_m_;
  double steepest_;
  Eigen::Matrix3d frame_;
  double spread_ = 0.0;  ///< half width of the natural box along e2, as a share of D
  double rise_ = 0.0;    ///< the same along e3
};

/// Where a hop steeper than `steepest` (rise over run) bends so as to keep the limit: it climbs vertically
/// first, or descends vertically last, and has the steepest slope for the rest; no such hop is shorter.
/// Nothing for a hop that keeps the limit or is vertical.
std::optional<Vec3> steep_corner(const Vec3& from, const Vec3& to, double steepest);
/// The rise over run that hops are bent to: the limit, less rounding.
double steepest_slope(const VehicleLimits& limits);
/// The chain with those corners among its points.
std::vector<Vec3> as_flown(const std::vector<Vec3>& chain, double steepest);

/// `count` points that follow the polyline evenly, its corners first of all: fewer corners than points are
/// filled up on the longest hops; of more, those that bend least are left out. Ends not included.
std::vector<Vec3> resample(const Vec3& from, std::vector<Vec3> corners, const Vec3& to, int count);

}  // namespace swallowtail::planner
