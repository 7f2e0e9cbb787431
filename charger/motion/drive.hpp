#pragma once

#include <vector>

#include "planner/base/result.hpp"
#include "planner/base/vec.hpp"

namespace swallowtail::charger {

/// How near to a site the robot counts as standing on it: less than sites lie off no-fly areas, so that none
/// is carried into one.
inline constexpr double kArrival_m = 0.01;

/// How far from its way the robot counts as on it.
inline constexpr double kOnWay_m = 0.5;

/// The ground robot's motion: straight over the ground at no more than its speed, stopping and turning at
/// will. Distances are level ones; its height follows the straight line to the target.
class Drive {
 public:
  explicit Drive(const Vec3& start_m) : position_m_(start_m) {}

  /// Moves towards `target_m` for `duration_s` at up to `speed_mps` and stands exactly on it once reached.
  /// Negative or non-finite arguments move nothing.
  void advance(const Vec3& target_m, double speed_mps, double duration_s);
  /// The same along a way: from where it is, or from the nearest place on the way where it is off it by more
  /// than kOnWay_m, through the bends that lie ahead, to the target. A way without bends is straight; else
  /// its first bend is where it begins.
  void follow(const std::vector<Vec3>& bends_m, const Vec3& target_m, double speed_mps, double duration_s);
  void stop() { speed_mps_ = 0.0; }
  /// What `follow` would drive to the target.
  double left_m(const std::vector<Vec3>& bends_m, const Vec3& target_m) const;

  const Vec3& position_m() const { return position_m_; }
  /// Mean speed over the last `advance`; 0 after `stop`.
  double speed_mps() const { return speed_mps_; }
  double distance_to_m(const Vec3& target_m) const;
  bool stands_at(const Vec3& target_m) const { return distance_to_m(target_m) <= kArrival_m; }

 private:
  std::vector<Vec3> places_ahead(const std::vector<Vec3>& bends_m, const Vec3& target_m) const;

  Vec3 position_m_;
  double speed_mps_ = 0.0;
};

}  // namespace swallowtail::charger
