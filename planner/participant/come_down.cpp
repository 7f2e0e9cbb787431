#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "planner/participant/no_drive.hpp"
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

/// Of the nearest places at or around the end of a route where the aircraft can come down then, the one with
/// the most clearance: the route, and down there. Where the robot may come is preferred to what is nearer.
std::optional<std::vector<RoutePoint>> down_near(const ReplanRequest& request,
                                                 const std::vector<RoutePoint>& route,
                                                 const ClearanceQuery& query, const VehicleLimits& limits,
                                                 std::span<const Area> no_drive) {
  const RoutePoint& end = route.back();
  std::optional<std::vector<RoutePoint>> best;
  bool is_best_open = false;
  double most_m = -1.0;
  for (const double ring : kRings) {
    const bool has_nearer = best.has_value();
    for (int k = 0; k < (ring == 0.0 ? 1 : kDirections); ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections;
      const Vec3 aside = ring * limits.clearance_m() * Vec3(std::cos(angle), std::sin(angle), 0.0);
      const Vec3 above = end.position_m + aside;
      const bool is_open = !is_in_or_near(no_drive, above.head<2>());
      if (!is_open && (is_best_open || has_nearer)) continue;
      std::vector<RoutePoint> down = route;
      down.push_back({above, Phase::kTransfer, end.leg_index, 0.0});
      down.push_back({ground_below(above, query.world().terrain()), Phase::kLanding, end.leg_index, 0.0});
      const Certificate certificate =
          certify(time_route(request.start_m, request.start_time_s, down, limits), query, limits);
      const bool is_better = is_open != is_best_open || certificate.clearance_min_m > most_m;
      if (!certificate.certified || !is_better) continue;
      is_best_open = is_open;
      most_m = certificate.clearance_min_m;
      best = std::move(down);
    }
    if (is_best_open) break;
  }
  return best;
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
    return land_near(std::move(request), std::move(report), world);
  if (report.verdict != Verdict::kCertified) return report;
  const double soonest_s =
      time_route(request.start_m, request.start_time_s, request.route, limits_).back().time_s;
  if (has_cover(request.route) && soonest_s > request.start_time_s + kSoon_s) return report;
  const double down_s = request.start_m.z() / limits_.descent_speed_mps;
  if (report.path.back().time_s - soonest_s <= spare - down_s) return report;
  report.verdict = Verdict::kContingency;
  return land_near(std::move(request), std::move(report), world);
}

/// Down beside where a contingency holds, or where the aircraft is if it lands too late, where that is sooner
/// than what was found.
ReplanReport PlannerParticipant::land_near(ReplanRequest request, ReplanReport found,
                                           const std::shared_ptr<const World>& world) {
  std::vector<RoutePoint> route;
  if (!found.lands) route = flown_to_hold(found.path);
  if (route.empty())
    route.push_back({request.start_m, Phase::kTransfer, request.route.back().leg_index, kStopToTurn_s});
  auto down_there = down_near(request, route, ClearanceQuery(world), limits_, no_drive_);
  if (!down_there) return found;
  request.route = std::move(*down_there);
  ReplanReport down = replanner_->plan(world, request, search_limit());
  if (down.verdict != Verdict::kCertified) return found;
  if (found.lands && down.path.back().time_s >= found.path.back().time_s) return found;
  down.verdict = Verdict::kContingency;
  down.reason = found.reason + ", lands nearby";
  return down;
}

StopCondition PlannerParticipant::search_limit() const {
  return {.clock = &clock_, .deadline_s = clock_.now_s() + 1e-3 * options_.budget_ms};
}

}  // namespace swallowtail::planner
