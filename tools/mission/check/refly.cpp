#include "tools/mission/check/refly.hpp"

#include <algorithm>

namespace swallowtail::check {
namespace {

bool grounded(const data::VehicleState& s) {
  return s.mode == data::VehicleMode::kLanded || s.mode == data::VehicleMode::kDocked;
}

/// Appends the plan's flight from t0 to t1; after its end it holds there, or stands on the ground.
void follow(const data::PathPlan& plan, double t0_s, double t1_s, std::vector<Piece>& pieces) {
  double t = t0_s;
  P3 at = plan_position(plan, t0_s);
  for (const auto& waypoint : plan.waypoints) {
    if (waypoint.time_s <= t) continue;
    const double until = std::min(waypoint.time_s, t1_s);
    const P3 next = plan_position(plan, until);
    pieces.push_back({t, until, at, next, waypoint.phase, plan.revision, false});
    t = until;
    at = next;
    if (t >= t1_s) return;
  }
  const auto rest = plan.lands ? data::PathPhase::kLanding : data::PathPhase::kHold;
  if (t < t1_s) pieces.push_back({t, t1_s, at, at, rest, plan.revision, false});
}

}  // namespace

P3 plan_position(const data::PathPlan& plan, double time_s) {
  const auto& w = plan.waypoints;
  if (w.empty()) return {};
  if (time_s <= w.front().time_s) return point(w.front().position);
  for (std::size_t i = 1; i < w.size(); ++i) {
    if (time_s > w[i].time_s) continue;
    const double span = w[i].time_s - w[i - 1].time_s;
    const double s = span > 0.0 ? (time_s - w[i - 1].time_s) / span : 1.0;
    const P3 a = point(w[i - 1].position);
    const P3 b = point(w[i].position);
    return {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), a.z + s * (b.z - a.z)};
  }
  return point(w.back().position);
}

std::vector<Piece> refly(const FlightLog& log, const PlansByRevision& plans) {
  std::vector<Piece> pieces;
  for (std::size_t i = 1; i < log.states.size(); ++i) {
    const auto& from = log.states[i - 1];
    const auto& to = log.states[i];
    if (to.time_s <= from.time_s) continue;
    const auto before = plans.find(from.path_revision);
    const auto after = plans.find(to.path_revision);
    if (grounded(from) && grounded(to)) {
      pieces.push_back({from.time_s, to.time_s, point(from.position), point(to.position),
                        data::PathPhase::kHold, 0, true});
    } else if (after == plans.end() || after->second->waypoints.empty()) {
      pieces.push_back({from.time_s, to.time_s, point(from.position), point(to.position),
                        data::PathPhase::kTransfer, 0, false});
    } else if (from.path_revision == to.path_revision) {
      follow(*after->second, from.time_s, to.time_s, pieces);
    } else {
      const double change = std::clamp(after->second->waypoints.front().time_s, from.time_s, to.time_s);
      if (change > from.time_s && !grounded(from) && before != plans.end())
        follow(*before->second, from.time_s, change, pieces);
      follow(*after->second, change, to.time_s, pieces);
    }
  }
  return pieces;
}

}  // namespace swallowtail::check
