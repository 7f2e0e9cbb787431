#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "coverage/field/places.hpp"
#include "coverage/maintain/plan_keeper.hpp"

/// How PlanKeeper brings the aircraft down when its energy does for nothing else.
namespace swallowtail::coverage {
namespace {

/// Of the time a change may take to reach the aircraft, what is not waited for on the leg under way: should
/// it be further by then, it turns back a little, and counts its legs the same.
constexpr double kHasteShare = 0.5;
/// Around a place where the robot has no way to, where one is looked for that it has.
constexpr std::array kRings_m{3.0, 6.0, 12.0, 24.0, 48.0};
constexpr int kDirections = 16;

FlightCost straight_over(const FlightModel& flight, std::span<const Leg> legs, Vec3 at_m) {
  FlightCost out;
  for (const Leg& leg : legs) {
    out += flight.level(at_m, leg.entry_m) + flight.level(leg.entry_m, leg.exit_m);
    at_m = leg.exit_m;
  }
  return out;
}

}  // namespace

/// Down as soon as it can be, whatever else might be had.
bool PlanKeeper::come_down(const std::string& reason) {
  const bool covering = covers(plan_.legs_done);
  const Commitment begun = committed();
  Rest rest{unflown_legs(begun.legs), begun.legs};
  if (rest.legs.empty()) return false;
  const Vec3 entry_m = rest.legs.front().entry_m;
  if (covering) rest.legs.front().entry_m = vehicle_->position_m;
  const std::size_t before_landing = split_ahead(rest, begun);
  land_at_once(rest.legs, before_landing, reason);
  keep_track_of_leg(entry_m, covering);
  return true;
}

/// Ends a leg where the aircraft is when a change reaches it, or puts a point there to fly to. Returns how
/// many legs it flies before it can land there.
std::size_t PlanKeeper::split_ahead(Rest& rest, const Commitment& begun) {
  if (begun.legs == 0) {
    rest.legs.insert(rest.legs.begin(), point_leg(point_ahead()));
    return rest.fixed = 1;
  }
  Leg& last = rest.legs[begun.legs - 1];
  const Leg& planned = plan_.legs[plan_.legs_done + begun.legs - 1];
  const double length = (planned.exit_m - planned.entry_m).norm();
  double into_last_m = begun.into_last_m;
  if (begun.legs == 1 && covers(plan_.legs_done)) {
    into_last_m = is_path_of_plan()
                      ? into_leg_m(plan_.legs_done, (1.0 - kHasteShare) * params_.reaction_s)
                      : into_last_m - kHasteShare * params_.reaction_s * task_.vehicle.cruise_speed_mps;
  }
  if (into_last_m < length - 1.0) {
    Leg after = last;
    after.sub_cell_id = next_id_++;
    after.entry_m = planned.entry_m + (planned.exit_m - planned.entry_m) * (into_last_m / length);
    last.exit_m = after.entry_m;
    rest.legs.insert(rest.legs.begin() + static_cast<std::ptrdiff_t>(begun.legs), after);
  }
  return rest.fixed = begun.legs;
}

/// The leg under way began where it began; its index stays.
void PlanKeeper::keep_track_of_leg(const Vec3& entry_m, bool covering) {
  if (!covering) return track_.reset();
  plan_.legs[plan_.legs_done].entry_m = entry_m;
  if (track_) track_->end_at(plan_.legs[plan_.legs_done].exit_m);
}

/// Where the robot cannot come, the aircraft flies on to the nearest place where it can, if there is energy
/// for that. Returns how many legs it flies before it lands then.
std::size_t PlanKeeper::within_reach(std::vector<Leg>& legs, std::size_t before_landing) {
  const Leg& last = legs[before_landing - 1];
  const Vec3 at_m = last.exit_m;
  if (std::isfinite(robot_arrives_s(at_m))) return before_landing;
  const FlightModel flight = model();
  const double spare = energy_now() - surcharge() - task_.battery.reserve - landing_spare() -
                       flight_over(std::span(legs).first(before_landing), start_in_air()).energy;
  for (const double ring_m : kRings_m) {
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections;
      const Vec3 place_m = lifted(at_m + ring_m * Vec3(std::cos(angle), std::sin(angle), 0.0));
      if (!ways_->is_free(at_m.head<2>(), place_m.head<2>()) ||
          barred_at(task_.fields, task_.no_fly, place_m.head<2>()) ||
          !std::isfinite(robot_arrives_s(place_m)))
        continue;
      if (flight.transfer_and_land(at_m, last.exit_m - last.entry_m, place_m).energy > spare)
        return before_landing;
      legs.insert(legs.begin() + static_cast<std::ptrdiff_t>(before_landing), point_leg(place_m));
      return before_landing + 1;
    }
  }
  return before_landing;
}

/// Nothing keeps the reserve any more: down after so many of the legs, wait for the robot, and go on from
/// there. What cannot be planned from there is kept for when it has landed.
void PlanKeeper::land_at_once(std::vector<Leg> legs, std::size_t before_landing, const std::string& reason) {
  before_landing = within_reach(legs, before_landing);
  const FlightModel flight = model();
  const ScheduleStart air = start_in_air();
  RestPlan rest;
  FlightCost down;
  for (std::size_t i = 0; i < before_landing; ++i) {
    Leg leg = legs[i];
    leg.start_s = air.time_s + down.time_s;
    leg.energy_before = std::max(0.0, air.energy - down.energy);
    down = flight_over(std::span(legs).first(i + 1), air);
    // Under way already, it gets there whether a way is known or not.
    if (down.energy >= kBarred.energy)
      down = straight_over(flight, std::span(legs).first(i + 1), air.position_m);
    leg.end_s = air.time_s + down.time_s;
    leg.energy_after = std::max(0.0, air.energy - down.energy);
    leg.transfer = i + 1 < before_landing ? Transfer::kFF
                   : legs.size() > i + 1  ? Transfer::kFDUF
                                          : Transfer::kEnd;
    leg.transfer_m.clear();
    rest.legs.push_back(leg);
  }
  // Under way to that leg already, it keeps to the bends of its way.
  const std::vector<Vec3>& bends =
      plan_.legs_done == 0 ? plan_.approach_m : plan_.legs[plan_.legs_done - 1].transfer_m;
  const bool goes_on = plan_.legs_done < plan_.legs.size() &&
                       rest.legs.front().sub_cell_id == plan_.legs[plan_.legs_done].sub_cell_id;
  if (goes_on) rest.approach_m = bends;
  const Vec3 at = rest.legs.back().exit_m;
  down += flight.landing(at);
  legs.erase(legs.begin(), legs.begin() + static_cast<std::ptrdiff_t>(before_landing));
  ScheduleStart docked;
  docked.kind = StartKind::kDocked;
  docked.position_m = flight.ground(at);
  docked.energy = std::max(0.0, air.energy - down.energy);
  const double down_s = air.time_s + down.time_s;
  const double arrives_s = std::max(down_s, robot_arrives_s(at));
  docked.time_s = arrives_s + task_.charger.landing_s;
  rest.end_s = down_s;
  const std::size_t next = plan_.legs_done + before_landing;
  std::optional<RestPlan> later;
  if (!legs.empty() && std::isfinite(arrives_s))
    later = plan_rest({legs, 0}, docked, next, flight, rest_params());
  if (later) {
    Rendezvous meeting = meeting_at(docked, down_s, *later->first);
    meeting.id = exit_id(next - 1);
    rest.legs.back().transfer_m = std::move(later->approach_m);
    rest.legs.insert(rest.legs.end(), later->legs.begin(), later->legs.end());
    rest.rendezvous = std::move(later->rendezvous);
    rest.rendezvous.insert(rest.rendezvous.begin(), meeting);
    rest.end_s = later->end_s;
    legs.clear();
  } else {
    rest.legs.back().transfer = Transfer::kEnd;
  }
  adopt(std::move(rest), reason + "; lands at once");
  gaps_ = std::move(legs);
  lands_at_once_ = true;
}

}  // namespace swallowtail::coverage
