#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "planner/participant/planner_participant.hpp"
#include "planner/path/certifier.hpp"

namespace swallowtail::planner {
namespace {

constexpr std::array kRings{0.0, 2.0, 4.0, 8.0};  ///< radii around a place, in clearances
constexpr int kDirections = 8;

Vec3 ground_below(const Vec3& p, const Terrain& terrain) {
  return {p.x(), p.y(), terrain.height_at(p.x(), p.y())};
}

/// The first place at or around another, at its height, that can be landed at from above.
std::optional<Vec3> landing_near(const Vec3& place, double time_s, const ClearanceQuery& query,
                                 const VehicleLimits& limits) {
  const World& world = query.world();
  for (const double ring : kRings) {
    for (int k = 0; k < (ring == 0.0 ? 1 : kDirections); ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections;
      const Vec3 above = place + ring * limits.clearance_m() * Vec3(std::cos(angle), std::sin(angle), 0.0);
      const Vec3 ground = ground_below(above, world.terrain());
      const TimedPath down = time_route(above, time_s, {{ground, Phase::kLanding, 0, 0.0}}, limits);
      if (certify(down, query, limits).certified) return above;
    }
  }
  return std::nullopt;
}

double hold_begins_s(const TimedPath& path) {
  std::size_t i = path.size() - 1;
  while (i > 0 && path[i].phase == Phase::kHold) --i;
  return path[i].time_s;
}

/// The path as a route, without the hold at its end.
std::vector<RoutePoint> flown_to_hold(const TimedPath& path) {
  std::vector<RoutePoint> route;
  for (const TimedWaypoint& w : path) {
    if (w.phase != Phase::kHold) route.push_back({w.position_m, w.phase, w.leg_index, 0.0});
  }
  return route;
}

}  // namespace

/// How long the energy that the plan predicts for the end of a leg lasts aloft above the reserve; for ever
/// where it predicts none.
double PlannerParticipant::spare_s(std::uint32_t leg) const {
  double energy = 0.0;
  double time_s = 0.0;
  for (const data::Leg& flown : coverage_->legs) {
    energy += flown.energy_before - flown.energy_after;
    time_s += flown.end_s - flown.start_s;
  }
  if (leg >= coverage_->legs.size() || !(energy > 0.0) || !(time_s > 0.0))
    return std::numeric_limits<double>::infinity();
  return (coverage_->legs[leg].energy_after - task_->battery.reserve) * time_s / energy;
}

/// Where there is no way to the landing that a plan asks for and the energy does not last for a hold, the
/// aircraft comes down near where it would hold, and the robot comes there.
ReplanReport PlannerParticipant::plan_or_land(ReplanRequest request) {
  const auto stop = [this] {
    return StopCondition{.clock = &clock_, .deadline_s = clock_.now_s() + 1e-3 * options_.budget_ms};
  };
  ReplanReport report = replanner_->plan(keeper_.world(), request, stop());
  const bool is_held_up = report.verdict == Verdict::kContingency && !report.lands &&
                          request.route.back().phase == Phase::kLanding;
  if (!is_held_up || !coverage_ || !task_) return report;
  const std::uint32_t leg = request.route.back().leg_index;
  const TimedWaypoint& hold = report.path.back();
  if (hold.time_s - hold_begins_s(report.path) <= spare_s(leg)) return report;
  const auto above = landing_near(hold.position_m, hold.time_s, ClearanceQuery(keeper_.world()), limits_);
  if (!above) return report;
  request.route = flown_to_hold(report.path);
  request.route.push_back({*above, Phase::kTransfer, leg, 0.0});
  request.route.push_back({ground_below(*above, keeper_.world_now()->terrain()), Phase::kLanding, leg, 0.0});
  ReplanReport down = replanner_->plan(keeper_.world(), request, stop());
  if (down.verdict != Verdict::kCertified) return report;
  down.verdict = Verdict::kContingency;
  down.reason = report.reason + ", lands nearby";
  return down;
}

}  // namespace swallowtail::planner
