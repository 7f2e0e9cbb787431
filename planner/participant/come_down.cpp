#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

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

}  // namespace

/// A plan that asks for a landing only does so because the energy runs out: where the landing is shut it
/// comes down near where it would hold, and the robot comes there.
ReplanReport PlannerParticipant::plan_or_land(ReplanRequest request) {
  const auto stop = [this] {
    return StopCondition{.clock = &clock_, .deadline_s = clock_.now_s() + 1e-3 * options_.budget_ms};
  };
  ReplanReport report = replanner_->plan(keeper_.world(), request, stop());
  if (report.verdict != Verdict::kContingency || report.lands || !only_lands(request.route)) return report;
  const std::uint32_t leg = request.route.back().leg_index;
  const TimedWaypoint& hold = report.path.back();
  const auto above = landing_near(hold.position_m, hold.time_s, ClearanceQuery(keeper_.world()), limits_);
  if (!above) return report;
  request.route = {{*above, Phase::kTransfer, leg, 0.0},
                   {ground_below(*above, keeper_.world_now()->terrain()), Phase::kLanding, leg, 0.0}};
  ReplanReport down = replanner_->plan(keeper_.world(), request, stop());
  if (down.verdict != Verdict::kCertified) return report;
  down.verdict = Verdict::kContingency;
  down.reason = report.reason + ", lands nearby";
  return down;
}

}  // namespace swallowtail::planner
