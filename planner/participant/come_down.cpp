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
constexpr double kSoon_s = 25.0;  ///< a landing so near is what the rest of a strip is given up for

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

bool has_cover(const std::vector<RoutePoint>& route) {
  return std::ranges::any_of(route, [](const RoutePoint& p) { return p.phase == Phase::kCover; });
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

/// Where there is no way to the landing that a plan asks for, or one that waits, and the energy does not last
/// for it, the aircraft comes down near where it would hold or is, and the robot comes there. The strips
/// before a landing are given up for that only where it is near.
ReplanReport PlannerParticipant::plan_or_land(ReplanRequest request,
                                              const std::shared_ptr<const World>& world) {
  ReplanReport report = replanner_->plan(world, request, search_limit());
  if (!coverage_ || !task_ || request.route.back().phase != Phase::kLanding) return report;
  const double spare = spare_s(request.route.back().leg_index);
  if (report.verdict == Verdict::kContingency && !report.lands &&
      report.path.back().time_s - hold_begins_s(report.path) > spare)
    return land_near(std::move(request), report, flown_to_hold(report.path), world);
  if (report.verdict == Verdict::kCertified) {
    const double soonest_s =
        time_route(request.start_m, request.start_time_s, request.route, limits_).back().time_s;
    if (has_cover(request.route) && soonest_s > request.start_time_s + kSoon_s) return report;
    const double down_s = request.start_m.z() / limits_.descent_speed_mps;
    if (report.path.back().time_s - soonest_s > spare - down_s)
      return land_near(std::move(request), report, {}, world);
  }
  return report;
}

/// Down beside the end of a route, or where the aircraft is without one, instead of what was found, where
/// that is sooner.
ReplanReport PlannerParticipant::land_near(ReplanRequest request, const ReplanReport& found,
                                           std::vector<RoutePoint> route,
                                           const std::shared_ptr<const World>& world) {
  const std::uint32_t leg = request.route.back().leg_index;
  const bool flies_there = !route.empty();
  const Vec3 from = flies_there ? found.path.back().position_m : request.start_m;
  const double time_s = flies_there ? found.path.back().time_s : request.start_time_s;
  const auto above = landing_near(from, time_s, ClearanceQuery(world), limits_);
  if (!above) return found;
  request.route = std::move(route);
  request.route.push_back({*above, Phase::kTransfer, leg, 0.0});
  request.route.push_back({ground_below(*above, world->terrain()), Phase::kLanding, leg, 0.0});
  ReplanReport down = replanner_->plan(world, request, search_limit());
  const bool is_later = found.lands && down.path.back().time_s >= found.path.back().time_s;
  if (down.verdict != Verdict::kCertified || is_later) return found;
  down.verdict = Verdict::kContingency;
  down.reason = found.reason + ", lands nearby";
  return down;
}

StopCondition PlannerParticipant::search_limit() const {
  return {.clock = &clock_, .deadline_s = clock_.now_s() + 1e-3 * options_.budget_ms};
}

}  // namespace swallowtail::planner
