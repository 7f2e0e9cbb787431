#include <algorithm>
#include <cmath>
#include <string>

#include "coverage/maintain/plan_keeper.hpp"

namespace swallowtail::coverage {
namespace {

constexpr double kSettled_s = 1.0;  ///< on the ground before it counts as landed somewhere
constexpr double kRetryEvery_s = 5.0;
constexpr double kWorseShare =
    0.01;  ///< of the capacity: a slack that fell by less since the last solution is no news
constexpr std::size_t kLastLegs = 2;
constexpr double kLeastShare =
    0.25;  ///< of the capacity that a flight must take before consumption is learnt from it
constexpr double kLeastShareAloft = 0.1;  ///< the same in flight, when the energy is known not to do
constexpr double kBiasStep =
    0.02;  ///< by which consumption is taken to be higher when there is too little to learn from
constexpr double kMostBias = 2.0;
constexpr double kLossShare = 0.01;  ///< of the capacity: between two samples a larger surplus is a loss

}  // namespace

/// Energy that is gone at once is no consumption: nothing is learnt from it.
void PlanKeeper::forget_loss(const BatteryView& before, const BatteryView& now) {
  if (!vehicle_ || vehicle_->on_ground() || take_off_energy_ <= 0.0) return;
  const double predicted =
      (now.time_s - before.time_s) * model().power(vehicle_->velocity_mps, vehicle_->position_m.z());
  const double drop = before.energy - now.energy;
  if (drop > predicted * kMostBias + kLossShare * task_.battery.capacity)
    take_off_energy_ -= drop - predicted * bias_;
}

/// Consumption so far against what was predicted for the way so far; nothing before there is enough of it.
std::optional<double> PlanKeeper::ratio_aloft(const FlightCost& left) const {
  const double predicted = take_off_cost_.energy - left.energy;
  if (take_off_energy_ <= 0.0 || predicted < kLeastShareAloft * task_.battery.capacity) return std::nullopt;
  return std::clamp((take_off_energy_ - energy_now()) / predicted, 1.0, kMostBias);
}

/// In flight: does the energy reach the next landing?
bool PlanKeeper::review_flight() {
  if (vehicle_->mode == AircraftMode::kLanding || lands_at_once_) {
    // Nothing is left to decide, but it is said.
    if (told_short_ || energy_now() >= task_.battery.reserve) return false;
    told_short_ = true;
    note_revision("energy " + std::to_string(std::lround(energy_now())) +
                  ", below the reserve; it is landing");
    return true;
  }
  const auto cost = to_next_landing();
  if (!cost) return false;
  double slack = energy_now() - cost->energy * bias_ - task_.battery.reserve;
  // As consumption has been since the take-off, or as it is known to be with something to spare.
  const std::optional<double> ratio = ratio_aloft(*cost);
  const bool holds =
      !ratio || energy_now() - cost->energy * *ratio >= task_.battery.reserve + landing_spare();
  if (holds && slack >= cost->energy * params_.trigger_margin + landing_spare()) return false;
  bias_ = ratio ? std::max(bias_, *ratio) : std::min(bias_ + kBiasStep, kMostBias);
  slack = energy_now() - cost->energy * bias_ - task_.battery.reserve;
  if (solved_slack_ && slack >= *solved_slack_ - kWorseShare * task_.battery.capacity) return false;
  const bool changed = solve_in_flight("energy " + std::to_string(std::lround(energy_now())) +
                                       " does not reach the next landing");
  const auto after = to_next_landing();
  if (changed && after) {
    take_off_energy_ = energy_now();
    take_off_cost_ = *after;
  }
  solved_slack_ = after ? energy_now() - after->energy * bias_ - task_.battery.reserve : slack;
  return changed;
}

/// Once in a while only: what failed will fail again until something has changed.
bool PlanKeeper::may_retry() {
  if (vehicle_->time_s < retry_s_) return false;
  retry_s_ = vehicle_->time_s + kRetryEvery_s;
  return true;
}

bool PlanKeeper::review_gaps() {
  if (gaps_.empty() || lands_at_once_ || vehicle_->mode == AircraftMode::kLanding ||
      vehicle_->mode == AircraftMode::kTakingOff)
    return false;
  // What was in the way may still be there: gaps wait for the next recharge, or for the plan's last legs.
  if (!plan_.rendezvous.empty() || plan_.legs_done + kLastLegs < plan_.legs.size()) return false;
  if (!may_retry()) return false;
  return solve_in_flight("a stretch was left out");
}

bool PlanKeeper::review_ground() {
  if (bias_is_due_ && battery_ && battery_->time_s >= landed_since_s_) {
    bias_is_due_ = false;
    const double used = take_off_energy_ - battery_->energy;
    if (take_off_energy_ > 0.0 && take_off_cost_.energy > kLeastShare * task_.battery.capacity) {
      bias_ = std::clamp(0.5 * (bias_ + used / take_off_cost_.energy), 1.0, kMostBias);
    }
    take_off_energy_ = -1.0;
    if (bias_ < 1.01) {
      bias_ = 1.0;
    }
  }
  if (!has_flown_) {
    if (!battery_ || battery_->energy >= plan_.battery_energy - kWorseShare * task_.battery.capacity ||
        plan_.legs_done > 0)
      return false;
    if (!may_retry()) return false;
    return solve_on_ground("the battery is not full at the start");
  }
  if (vehicle_->mode == AircraftMode::kDocked || at_meeting(vehicle_->position_m)) return top_up_charge();
  if (vehicle_->time_s < landed_since_s_ + kSettled_s) return false;
  if (plan_.legs_done >= plan_.legs.size() && gaps_.empty()) return false;
  if (!may_retry()) return false;
  return solve_on_ground(plan_.legs_done >= plan_.legs.size() ? "a stretch was left out"
                                                              : "landed away from the plan's sites");
}

}  // namespace swallowtail::coverage
