#include <utility>

#include "planner/participant/planner_participant.hpp"

namespace swallowtail::planner {

/// A plan that asks for a landing only does so because the energy runs out: where the landing is shut it
/// comes down where it would hold, and the robot comes there.
ReplanReport PlannerParticipant::plan_or_land(ReplanRequest request) {
  const auto stop = [this] {
    return StopCondition{.clock = &clock_, .deadline_s = clock_.now_s() + 1e-3 * options_.budget_ms};
  };
  ReplanReport report = replanner_->plan(keeper_.world(), request, stop());
  if (report.verdict != Verdict::kContingency || report.lands || !only_lands(request.route)) return report;
  const Vec3 above = report.path.back().position_m;
  const std::uint32_t leg = request.route.back().leg_index;
  const double ground_m = keeper_.world_now()->terrain().height_at(above.x(), above.y());
  request.route = {{above, Phase::kTransfer, leg, 0.0},
                   {Vec3(above.x(), above.y(), ground_m), Phase::kLanding, leg, 0.0}};
  ReplanReport down = replanner_->plan(keeper_.world(), request, stop());
  if (down.verdict != Verdict::kCertified) return report;
  down.verdict = Verdict::kContingency;
  down.reason = report.reason + ", lands there";
  return down;
}

}  // namespace swallowtail::planner
