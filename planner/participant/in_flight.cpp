#include <optional>
#include <utility>
#include <vector>

#include "planner/participant/convert.hpp"
#include "planner/participant/planner_participant.hpp"
#include "planner/path/certifier.hpp"

namespace swallowtail::planner {

Status PlannerParticipant::act_in_flight(double now_s, bool changed) {
  const bool wants_better = log_.empty() || verdict_ == Verdict::kContingency ||
                            (!log_.lands() && coverage_ &&
                             log_.end_s() - now_s < 4.0 * lead_s(inbox_->time.rate(), options_.budget_ms));
  const bool retries = (wants_better || owes_path_) && clock_.now_s() >= retry_wall_s_;
  if (!changed && !retries) return {};
  if (!changed || log_.empty()) return replan(now_s);
  const ClearanceQuery query(keeper_.world());
  const bool legs_hold =
      !coverage_ || !published_ || published_->basis.coverage_revision == coverage_->revision;
  const bool goal_holds =
      coverage_ || !goal_ || !published_ || published_->basis.goal_revision == goal_->revision;
  if (legs_hold && goal_holds && verdict_ == Verdict::kCertified && now_s <= log_.end_s() &&
      certify(log_.rest(now_s), query, limits_).certified) {
    if (changed_wall_s_ > 0.0) status_->add_latency_ms(1e3 * (clock_.now_s() - changed_wall_s_));
    changed_wall_s_ = 0.0;
    owes_path_ = false;
    return {};
  }
  return replan(now_s);
}

RouteStart PlannerParticipant::start_of_route(double join_s) const {
  RouteStart start;
  start.leg = vehicle_->legs_done;
  if (log_.empty()) {
    start.position_m =
        to_vec(vehicle_->position) + to_vec(vehicle_->velocity_mps) * (join_s - vehicle_->time_s);
    start.leg_started = vehicle_->mode == data::VehicleMode::kCovering && vehicle_->leg_index == start.leg;
    return start;
  }
  start.position_m = log_.position(join_s);
  start.leg = std::max(start.leg, log_.target(join_s).leg_index);
  if (coverage_ && start.leg < coverage_->legs.size()) {
    start.leg_started = log_.has_begun(start.leg, to_vec(coverage_->legs[start.leg].entry), join_s);
  }
  return start;
}

/// Nothing where there is no route to fly.
std::optional<ReplanReport> PlannerParticipant::plan_from_air(double now_s, double lead,
                                                              const std::shared_ptr<const World>& world) {
  ReplanReport report;
  // Where the path is shut within the lead, a shorter one may still get round.
  for (const double share : {1.0, 0.5}) {
    const double asked_s = now_s + share * lead;
    const double join_s = log_.join_time_s(asked_s);
    const RouteStart start = start_of_route(join_s);
    std::vector<RoutePoint> route = route_from(start, join_s);
    if (route.empty()) return std::nullopt;
    const Vec3 velocity = log_.empty() ? to_vec(vehicle_->velocity_mps) : log_.velocity(asked_s);
    report = plan_or_land({start.position_m, join_s, velocity, std::move(route)}, world);
    if (report.verdict != Verdict::kNoSafePath) break;
  }
  return report;
}

Status PlannerParticipant::replan(double now_s) {
  const double wall_s = clock_.now_s();
  const double lead = (1 << late_) * lead_s(inbox_->time.rate(), options_.budget_ms);
  std::shared_ptr<const World> world = keeper_.world();
  std::optional<ReplanReport> found = plan_from_air(now_s, lead, world);
  if (found && found->verdict == Verdict::kNoSafePath && options_.obstacle_acceleration_mps2 > 0.0) {
    // Where an obstacle has turned, what was kept from it for that is spent.
    world = keeper_.world_without_turns();
    found = plan_from_air(now_s, lead, world);
    if (found->verdict == Verdict::kCertified) found->verdict = Verdict::kContingency;
    if (found->verdict == Verdict::kContingency) found->reason += ", no margin for turns";
  }
  if (!found) return {};
  retry_wall_s_ = clock_.now_s() + kRetryWall_s;
  if (found->verdict == Verdict::kNoSafePath) {
    fail(*found);
    return {};
  }
  // A contingency that is being flown and still holds is not traded for another one, but for a landing.
  if (found->verdict == Verdict::kContingency && verdict_ == Verdict::kContingency && !log_.empty() &&
      (log_.lands() || !found->lands) && now_s < log_.end_s() - 2.0 * lead &&
      certify(log_.rest(now_s), ClearanceQuery(world), limits_).certified) {
    changed_wall_s_ = 0.0;
    return {};
  }
  return publish(*found, now_s, 1e3 * (clock_.now_s() - wall_s));
}

}  // namespace swallowtail::planner
