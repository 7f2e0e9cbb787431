#pragma once

#include <cstdint>
#include <optional>

#include "planner/path/path.hpp"

namespace swallowtail::planner {

/// The path that the vehicle is believed to fly: what it was told before, up to where the newest plan takes
/// over, and that plan. Knows which leg is flown when.
class FlightLog {
 public:
  bool empty() const { return path_.empty(); }
  void clear();

  /// A plan that begins at its first waypoint; what was to be flown before that stays, older than `now_s` is
  /// dropped.
  void join(const TimedPath& plan, double now_s);

  double begin_s() const { return begin_s_; }  ///< of the newest plan
  double end_s() const { return path_.back().time_s; }
  bool lands() const { return !path_.empty() && path_.back().phase == Phase::kLanding; }
  Vec3 position(double time_s) const { return position_at(path_, time_s); }
  Vec3 velocity(double time_s) const;
  /// When a new path may take over that is to take over at `time_s`: then, unless the vehicle has only just
  /// stopped. A stop frees the turn after it once it has lasted kStopToTurn_s, so that is waited for.
  double join_time_s(double time_s) const;
  /// The waypoint that ends the segment flown at that time; the last one after the end.
  const TimedWaypoint& target(double time_s) const;
  /// From that time on, its first waypoint at that time.
  TimedPath rest(double time_s) const;
  bool covers_later(std::uint32_t leg, double time_s) const;

  /// Remembers the leg whose strip has been begun by `time_s`.
  void note(double time_s);
  /// Whether by `time_s` the strip of this leg, which begins at `entry`, has been begun.
  bool has_begun(std::uint32_t leg, const Vec3& entry, double time_s) const;

 private:
  TimedPath path_;
  double begin_s_ = 0.0;
  std::optional<std::uint32_t> begun_leg_;
};

}  // namespace swallowtail::planner
