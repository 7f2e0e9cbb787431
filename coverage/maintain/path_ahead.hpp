#pragma once

#include <cstddef>
#include <cstdint>

#include "coverage/energy/flight.hpp"
#include "planner/path/path.hpp"

namespace swallowtail::coverage {

/// A path that the planner has published for the aircraft.
struct PathView {
  std::uint32_t coverage_revision = 0;  ///< of the plan that it was made for
  bool lands = false;                   ///< its end is on the ground
  planner::TimedPath waypoints;         ///< not empty, times do not fall
};

/// The path that the aircraft is believed to fly. It tells what the legs do not: where obstacles are waited
/// for and gone round, where the aircraft will be, and how long it is until it lands.
class PathAhead {
 public:
  bool empty() const { return path_.empty(); }
  void clear() { path_.clear(); }

  /// A newer path: what was to be flown before it begins stays, but for what was flown by `now_s`.
  void join(const PathView& path, double now_s);

  std::uint32_t coverage_revision() const { return coverage_revision_; }
  bool lands() const { return lands_; }
  double end_s() const { return path_.back().time_s; }
  /// Clamped to its ends.
  Vec3 position_m(double time_s) const { return planner::position_at(path_, time_s); }
  /// What flying it takes between two times; hovering beyond its end.
  FlightCost cost(const FlightModel& model, double from_s, double to_s) const;
  /// How many of the legs from index `first` on have been begun by a time.
  std::size_t legs_begun(std::size_t first, double time_s) const;
  /// When the last of a leg is covered; minus infinity where none of it is.
  double leg_end_s(std::size_t leg) const;

 private:
  planner::TimedPath path_;
  std::uint32_t coverage_revision_ = 0;
  bool lands_ = false;
};

}  // namespace swallowtail::coverage
