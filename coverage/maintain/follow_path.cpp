#include <algorithm>
#include <cmath>

#include "coverage/maintain/plan_keeper.hpp"

/// What PlanKeeper takes from the path that the aircraft flies.
namespace swallowtail::coverage {
namespace {

constexpr double kOffPath_m = 1.5;  ///< that the aircraft is not where its path says

}  // namespace

void PlanKeeper::on_path(const PathView& path) {
  const bool finite = std::ranges::all_of(path.waypoints, [](const planner::TimedWaypoint& w) {
    return is_finite(w.time_s) && is_finite(w.position_m);
  });
  const bool ordered = std::ranges::is_sorted(path.waypoints, {}, &planner::TimedWaypoint::time_s);
  if (path.waypoints.empty() || !finite || !ordered) {
    refuse();
    return;
  }
  path_.join(path, vehicle_ ? vehicle_->time_s : 0.0);
}

bool PlanKeeper::is_on_path() const {
  return vehicle_ && !vehicle_->on_ground() && !path_.empty() &&
         (path_.position_m(vehicle_->time_s) - vehicle_->position_m).norm() <= kOffPath_m;
}

/// The path ends in the air, and not above where the plan lands: the planner knows no way there.
bool PlanKeeper::is_held_up() const {
  if (!is_path_of_plan() || path_.lands()) return false;
  const auto lands =
      std::find_if(plan_.legs.begin() + static_cast<std::ptrdiff_t>(plan_.legs_done), plan_.legs.end(),
                   [](const Leg& leg) { return leg.transfer != Transfer::kFF; });
  const Vec3 hold_m = path_.position_m(path_.end_s());
  return lands != plan_.legs.end() && (lands->exit_m - hold_m).head<2>().norm() > kOffPath_m;
}

/// What the path to the next landing takes above what its legs do.
double PlanKeeper::surcharge() const {
  if (!is_path_of_plan() || !path_.lands()) return 0.0;
  const double flown = path_.cost(model(), vehicle_->time_s, path_.end_s()).energy;
  return std::max(0.0, flown - legs_to_next_landing().energy);
}

/// How far along a leg that it has begun by then the path has come so many seconds from now.
double PlanKeeper::into_leg_m(std::size_t leg, double ahead_s) const {
  const Vec3 way = plan_.legs[leg].exit_m - plan_.legs[leg].entry_m;
  const double length = way.norm();
  if (length < 1e-9) return length;
  const double end_s = path_.leg_end_s(leg);
  double at_s = vehicle_->time_s + ahead_s;
  if (std::isfinite(end_s)) at_s = std::min(at_s, end_s);
  return std::clamp((path_.position_m(at_s) - plan_.legs[leg].entry_m).dot(way) / length, 0.0, length);
}

PlanKeeper::Commitment PlanKeeper::committed_on_path() const {
  const std::size_t now = plan_.legs_done;
  std::size_t most = now;
  while (most < plan_.legs.size() && (most == now || plan_.legs[most - 1].transfer == Transfer::kFF)) ++most;
  Commitment out;
  out.legs = std::min(path_.legs_begun(now, vehicle_->time_s + params_.reaction_s), most - now);
  if (covers(now)) out.legs = std::max<std::size_t>(out.legs, 1);
  // Where legs were passed over, it goes on with the one under way wherever the path now holds.
  if (!later_.empty() && later_.rbegin()->first < most)
    out.legs = std::max(out.legs, later_.rbegin()->first - now + 1);
  if (out.legs > 0) out.into_last_m = into_leg_m(now + out.legs - 1, params_.reaction_s);
  return out;
}

}  // namespace swallowtail::coverage
