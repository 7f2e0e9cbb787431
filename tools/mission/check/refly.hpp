#pragma once

#include <map>
#include <vector>

#include "tools/mission/check/flight_log.hpp"
#include "tools/mission/check/rules.hpp"

namespace swallowtail::check {

/// A straight piece of flight at constant velocity.
struct Piece {
  double t0_s = 0.0;
  double t1_s = 0.0;
  P3 a;
  P3 b;
  data::PathPhase phase = data::PathPhase::kTransfer;
  std::uint32_t plan = 0;  ///< revision; 0: joined from states alone
  bool on_ground = false;  ///< landed or docked at both ends
};

using PlansByRevision = std::map<std::uint32_t, const data::PathPlan*>;

inline P3 point(const data::Vec3& v) { return {v.x_m, v.y_m, v.z_m}; }

/// Where a plan is at a time; clamped to its ends.
P3 plan_position(const data::PathPlan& plan, double time_s);

/// The flight between recorded states, broken at the waypoints of the plans that were followed.
std::vector<Piece> refly(const FlightLog& log, const PlansByRevision& plans);

}  // namespace swallowtail::check
