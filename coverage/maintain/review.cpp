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
constexpr double kMostConsumption = 2.0;  ///< against what is expected
constexpr double kLossShare = 0.01;       ///< of the capacity: between two samples a larger surplus is a loss
constexpr double kMostDetourShare = 0.3;  ///< of the capacity: kept for detours
constexpr double kDeviations = 2.0;       ///< of a descent's energy, that are left for it
constexpr double kSampleEvery_s = 1.0;    ///< how long until the next battery state, as a rule

}  // namespace

void PlanKeeper::note_flight(const AircraftView& before, const AircraftView& now) {
  const double duration_s = now.time_s - before.time_s;
  if (before.on_ground() || now.on_ground()) {
    all_aloft_ = false;
    return consumption_.forget();
  }
  if (!(duration_s > 0.0)) return;
  consumption_.fly(task_.battery.model, (now.position_m - before.position_m) / duration_s,
                   0.5 * (before.position_m.z() + now.position_m.z()), duration_s);
}

/// Energy that is gone at once is no consumption: nothing is learnt from it.
void PlanKeeper::learn_consumption(const BatteryView& before, const BatteryView& now) {
  if (!vehicle_ || vehicle_->on_ground()) return;
  // The two states seldom come from the same instant.
  const double ahead_s = now.time_s - vehicle_->time_s;
  const auto fly = [&](double duration_s) {
    consumption_.fly(task_.battery.model, vehicle_->velocity_mps, vehicle_->position_m.z(), duration_s);
  };
  fly(ahead_s);
  const double drop = before.energy - now.energy;
  const bool lost = drop > consumption_.expected() * kMostConsumption + kLossShare * task_.battery.capacity;
  if (all_aloft_ && !lost && drop >= 0.0) {
    consumption_.learn(drop);
  } else {
    consumption_.forget();
  }
  fly(-ahead_s);
  all_aloft_ = true;
}

/// An aged battery holds less than the task says; one that holds more is not trusted. Charges that it cannot
/// take any more are planned anew.
bool PlanKeeper::review_capacity(double capacity) {
  if (capacity <= task_.battery.reserve || capacity >= task_.battery.capacity) return false;
  task_.battery.capacity = capacity;
  bool is_short = false;
  for (Rendezvous& meeting : plan_.rendezvous) {
    is_short = is_short || meeting.charge_to > capacity;
    meeting.charge_to = std::min(meeting.charge_to, capacity);
  }
  if (!is_short || !has_flown_ || lands_at_once_) return false;
  const std::string reason = "the battery holds " + std::to_string(std::lround(capacity)) + " only";
  bool solved = false;
  if (!vehicle_->on_ground()) {
    solved = vehicle_->mode != AircraftMode::kLanding && solve_in_flight(reason, Otherwise::kGoOn);
  } else if (vehicle_->mode == AircraftMode::kDocked || at_meeting(*vehicle_)) {
    solved = solve_docked(reason);
  }
  if (!solved) note_revision(reason);
  return true;
}

PlanKeeper::DownNow PlanKeeper::down_now() const {
  const FlightModel flight = model();
  const Vec3 ahead = point_ahead();
  if (is_on_path()) {
    const double now_s = vehicle_->time_s;
    return {path_.cost(flight, now_s, now_s + params_.reaction_s), flight.landing(ahead)};
  }
  return {flight.level(vehicle_->position_m, ahead), flight.landing(ahead)};
}

/// What a descent may take more than is known, and what is flown until the next battery state.
double PlanKeeper::spare_to_come_down(const FlightCost& descent, const Vec3& velocity_mps,
                                      double height_m) const {
  return kDeviations * consumption_.upright_deviation(descent) +
         kSampleEvery_s * model().power(velocity_mps, height_m);
}

/// Whether coming down must begin now: later the reserve might not last, and the planned landing takes more.
bool PlanKeeper::is_last_chance(const FlightCost& to_landing) const {
  const DownNow down = down_now();
  const double energy = down.there.energy + down.descent.energy;
  const double spare = spare_to_come_down(down.descent, vehicle_->velocity_mps, vehicle_->position_m.z());
  if (energy_now() - energy - spare >= task_.battery.reserve) return false;
  if (is_held_up()) return true;
  return to_landing.energy > energy + kWorseShare * task_.battery.capacity;
}

/// In flight: does the energy reach the next landing?
bool PlanKeeper::review_flight() {
  if (vehicle_->mode == AircraftMode::kLanding || (lands_at_once_ && !is_held_up())) {
    // Nothing is left to decide, but it is said.
    if (told_short_ || energy_now() >= task_.battery.reserve) return false;
    told_short_ = true;
    note_revision("energy " + std::to_string(std::lround(energy_now())) +
                  ", below the reserve; it is landing");
    return true;
  }
  const auto cost = to_next_landing();
  if (!cost) return false;
  const double slack = energy_now() - cost->energy - task_.battery.reserve;
  const bool holds = slack >= cost->energy * params_.trigger_margin + landing_spare();
  const bool last_chance = is_last_chance(*cost);
  if (!last_chance && (holds || lands_at_once_)) return false;
  detour_energy_ = std::max(detour_energy_, std::min(surcharge(), kMostDetourShare * task_.battery.capacity));
  const bool is_news = !solved_slack_ || slack < *solved_slack_ - kWorseShare * task_.battery.capacity;
  if (!is_news && !last_chance) return false;
  const std::string reason =
      "energy " + std::to_string(std::lround(energy_now())) +
      (last_chance ? " is just enough to come down" : " does not reach the next landing");
  const DownNow down = down_now();
  const auto otherwise =
      cost->energy > down.there.energy + down.descent.energy ? Otherwise::kLand : Otherwise::kGoOn;
  const bool changed = last_chance ? come_down(reason) : solve_in_flight(reason, otherwise);
  const auto after = to_next_landing();
  solved_slack_ = after ? energy_now() - after->energy - task_.battery.reserve : slack;
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
  if (has_flown_ && !told_short_ && battery_ && battery_->time_s >= landed_since_s_ &&
      battery_->energy < task_.battery.reserve && vehicle_->mode == AircraftMode::kLanded) {
    told_short_ = true;
    note_revision("landed with energy " + std::to_string(std::lround(battery_->energy)) +
                  ", below the reserve");
    return true;
  }
  if (!has_flown_) {
    if (!battery_ || battery_->energy >= plan_.battery_energy - kWorseShare * task_.battery.capacity ||
        plan_.legs_done > 0)
      return false;
    if (!may_retry()) return false;
    return solve_on_ground("the battery is not full at the start") || tell_no_plan();
  }
  if (vehicle_->mode == AircraftMode::kDocked || at_meeting(*vehicle_)) return top_up_charge();
  if (vehicle_->time_s < landed_since_s_ + kSettled_s) return false;
  if (plan_.legs_done >= plan_.legs.size() && gaps_.empty()) return false;
  if (!may_retry()) return false;
  const bool is_end = plan_.legs_done >= plan_.legs.size();
  return solve_on_ground(is_end ? "a stretch was left out" : "landed away from the plan's sites") ||
         tell_no_plan();
}

/// Why what is left cannot be planned, once in this stay on the ground.
bool PlanKeeper::tell_no_plan() {
  if (no_plan_.empty() || told_no_plan_) return false;
  told_no_plan_ = true;
  note_revision("stays landed: " + no_plan_);
  return true;
}

}  // namespace swallowtail::coverage
