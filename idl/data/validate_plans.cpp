#include "idl/data/ranges.hpp"
#include "idl/data/validate.hpp"

namespace swallowtail::data {

namespace {

using namespace ranges;

constexpr std::size_t kReasonLength = 128;

Refusal check(const Leg& leg) {
  if (leg.kind > LegKind::kReposition || leg.transfer > Transfer::kEnd) return "enumerator out of range";
  if (!is_position(leg.entry) || !is_position(leg.exit)) return "leg position out of range";
  if (!is_within(leg.height_m, 0.0, kMaxSize_m)) return "leg height out of range";
  if (!is_energy(leg.energy_before) || !is_energy(leg.energy_after)) return "leg energy out of range";
  if (!is_time(leg.start_s) || !is_time(leg.end_s)) return "time out of range";
  if (leg.end_s < leg.start_s) return "leg ends before it starts";
  if (leg.kind == LegKind::kReposition && leg.entry != leg.exit) return "reposition leg covers ground";
  return {};
}

/// Ways follow one another in the pool of bends, so that none counts twice. `next` is where the one before
/// ended.
Refusal check_way(std::uint32_t first, std::uint32_t count, std::size_t size, std::uint64_t& next) {
  if (count == 0) return {};
  const std::uint64_t end = std::uint64_t{first} + count;
  if (end > size) return "way outside the bends";
  if (first < next) return "ways share bends";
  next = end;
  return {};
}

Refusal check_bends(const std::vector<Vec3>& bends) {
  if (bends.size() > kMaxBends) return "sequence above its bound";
  for (const Vec3& bend : bends) {
    if (!is_position(bend)) return "bend out of range";
  }
  return {};
}

Refusal check(const Rendezvous& meeting) {
  if (meeting.kind > StopKind::kDepot) return "enumerator out of range";
  if (!is_position(meeting.site) || !is_position(meeting.carry_to)) return "site out of range";
  if (!is_time(meeting.arrive_by_s) || !is_time(meeting.depart_s)) return "time out of range";
  if (meeting.depart_s < meeting.arrive_by_s) return "rendezvous ends before it starts";
  if (!is_energy(meeting.charge_to)) return "charge level out of range";
  if (!is_speed(meeting.speed_mps) || !is_speed(meeting.carry_speed_mps) || !is_speed(meeting.home_speed_mps))
    return "charger speed out of range";
  if (!is_energy(meeting.robot_energy) || !is_energy(meeting.robot_energy_left))
    return "charger energy out of range";
  if (meeting.kind == StopKind::kDepot && meeting.carry) return "depot carries";
  return {};
}

/// Ids grow; a stop at the depot has that of the meeting after it.
bool follows(const Rendezvous& stop, const Rendezvous& last) {
  const bool is_from_depot = last.kind == StopKind::kDepot && stop.kind == StopKind::kMeeting;
  return stop.rendezvous_id > last.rendezvous_id ||
         (is_from_depot && stop.rendezvous_id == last.rendezvous_id);
}

}  // namespace

Refusal validate(const CoveragePlan& plan) {
  if (plan.legs.size() > kMaxLegs) return "sequence above its bound";
  if (const Refusal refusal = check_bends(plan.bends)) return refusal;
  if (plan.legs_done > plan.legs.size()) return "more legs done than there are";
  if (!is_time(plan.basis.battery_time_s) || !is_time(plan.basis.vehicle_time_s)) return "time out of range";
  if (!is_energy(plan.basis.battery_energy)) return "basis energy out of range";
  if (!is_total(plan.cost)) return "cost out of range";
  if (!is_time(plan.makespan_s)) return "makespan out of range";
  if (!is_total(plan.field_area_m2)) return "area out of range";
  if (!is_text(plan.reason, kReasonLength)) return "text above its bound";
  std::uint64_t next_bend = 0;
  for (std::size_t i = 0; i < plan.legs.size(); ++i) {
    const Leg& leg = plan.legs[i];
    if (const Refusal refusal = check(leg)) return refusal;
    if (const Refusal refusal = check_way(leg.first_bend, leg.bend_count, plan.bends.size(), next_bend))
      return refusal;
    if (leg.transfer == Transfer::kEnd && i + 1 < plan.legs.size()) return "plan ends before its last leg";
    // Legs that are done keep their times; only those ahead are timed together.
    if (i > plan.legs_done && leg.start_s < plan.legs[i - 1].end_s - kSameTime_s)
      return "legs out of order in time";
  }
  return {};
}

Refusal validate(const ChargerPlan& plan) {
  if (plan.rendezvous.size() > kMaxRendezvous) return "sequence above its bound";
  if (!is_speed(plan.speed_mps)) return "charger speed out of range";
  if (!is_within(plan.charge_s_per_unit, 0.0, kMaxEnergy)) return "charge time out of range";
  if (!is_time(plan.landing_s) || !is_time(plan.take_off_s)) return "charger handling time out of range";
  if (!is_position(plan.start)) return "charger start out of range";
  if (!is_taper(plan.taper_from, plan.taper_end_rate)) return "charging taper out of range";
  if (!is_speed(plan.home_speed_mps)) return "charger speed out of range";
  if (plan.has_battery && !is_robot_battery(plan.battery)) return "charger battery out of range";
  if (const Refusal refusal = check_bends(plan.bends)) return refusal;
  std::uint64_t next_bend = 0;
  if (const Refusal refusal =
          check_way(plan.home_first_bend, plan.home_bend_count, plan.bends.size(), next_bend))
    return refusal;
  for (std::size_t i = 0; i < plan.rendezvous.size(); ++i) {
    const Rendezvous& meeting = plan.rendezvous[i];
    if (const Refusal refusal = check(meeting)) return refusal;
    if (const Refusal refusal =
            check_way(meeting.first_bend, meeting.bend_count, plan.bends.size(), next_bend))
      return refusal;
    if (const Refusal refusal =
            check_way(meeting.carry_first_bend, meeting.carry_bend_count, plan.bends.size(), next_bend))
      return refusal;
    if (const Refusal refusal =
            check_way(meeting.home_first_bend, meeting.home_bend_count, plan.bends.size(), next_bend))
      return refusal;
    if (meeting.kind == StopKind::kDepot && !plan.has_battery) return "depot without a battery";
    if (i > 0 && !follows(meeting, plan.rendezvous[i - 1])) return "rendezvous ids not growing";
  }
  return {};
}

Refusal validate(const PathPlan& plan) {
  if (plan.waypoints.size() > kMaxWaypoints) return "sequence above its bound";
  if (plan.verdict > PathVerdict::kNoSafePath) return "enumerator out of range";
  if (!is_time(plan.basis.vehicle_time_s)) return "time out of range";
  if (!is_text(plan.reason, kReasonLength)) return "text above its bound";
  if (!is_total(plan.length_m)) return "length out of range";
  if (!is_time(plan.duration_s)) return "duration out of range";
  if (!is_within(plan.clearance_min_m, -kMaxHorizontal_m, kMaxTotal)) return "clearance out of range";
  if (!is_total(plan.replan_ms)) return "replan time out of range";
  if (plan.verdict == PathVerdict::kCertified && plan.waypoints.empty()) return "certified without waypoints";
  for (std::size_t i = 0; i < plan.waypoints.size(); ++i) {
    const TimedWaypoint& waypoint = plan.waypoints[i];
    if (waypoint.phase > PathPhase::kLanding) return "enumerator out of range";
    if (!is_time(waypoint.time_s)) return "time out of range";
    if (!is_position(waypoint.position)) return "position out of range";
    if (i > 0 && waypoint.time_s < plan.waypoints[i - 1].time_s) return "waypoints out of order in time";
  }
  return {};
}

Refusal validate(const ChargerState& state) {
  if (!is_time(state.time_s)) return "time out of range";
  if (!is_position(state.position)) return "position out of range";
  if (!is_speed(state.speed_mps)) return "speed out of range";
  if (!is_within(state.charge_rate, 0.0, kMaxPower)) return "charge rate out of range";
  if (!is_total(state.energy_delivered) || !is_energy(state.energy)) return "energy out of range";
  if (state.activity > ChargerActivity::kRefilling) return "enumerator out of range";
  if (state.charge_rate > 0.0 && state.docked_vehicle_id == 0) return "charging no vehicle";
  return {};
}

Refusal validate(const ParticipantStatus& status) {
  if (!is_text(status.name, 32) || !is_text(status.message, 256)) return "text above its bound";
  if (status.health > Health::kFailed) return "enumerator out of range";
  if (status.rejected.size() > kMaxRejections) return "sequence above its bound";
  for (const Rejection& rejection : status.rejected) {
    if (!is_text(rejection.topic, 32) || !is_text(rejection.reason, 64)) return "text above its bound";
  }
  if (!is_total(status.latency_p50_ms) || !is_total(status.latency_p99_ms) ||
      !is_total(status.latency_max_ms)) {
    return "latency out of range";
  }
  return {};
}

}  // namespace swallowtail::data
