#include <algorithm>
#include <cmath>
#include <utility>

#include "coverage/field/places.hpp"
#include "coverage/maintain/plan_keeper.hpp"

/// How PlanKeeper schedules the rest anew.
namespace swallowtail::coverage {
namespace {

/// A robot that stands still for a reason unknown is taken to do so for a while yet.
constexpr double kDelay_s = 30.0;
/// What flights differ by once consumption is known.
constexpr double kKnownAllowance = 0.05;
/// With less than this a charge is raised before the aircraft leaves.
constexpr double kLeastAllowance = 0.03;
/// Of a flight under way less can still go wrong.
constexpr double kAloftAllowance = 0.02;
constexpr double kAboveGround_m = 1.0;
constexpr double kStopsToChange = 2.0;
/// Of what a flight may take: where climbing and coming down take more, cutting strips does not help.
constexpr double kMostEndsShare = 0.9;

}  // namespace

RestParams PlanKeeper::rest_params() const {
  RestParams out;
  out.stops = stop_params(task_, params_.planning);
  if (has_flown_) out.stops.energy_factor = std::min(out.stops.energy_factor, 1.0 + kKnownAllowance);
  out.stops.air_factor = 1.0 + kAloftAllowance;
  out.stops.spare += landing_spare();
  if (vehicle_ && vehicle_->on_ground()) out.stops.spare += detour_energy_;
  out.schedules = params_.resolve_schedules;
  if (params_.planning.clock != nullptr) {
    out.stop.clock = params_.planning.clock;
    out.stop.deadline_s = out.stop.clock->now_s() + params_.resolve_deadline_s;
  }
  return out;
}

double PlanKeeper::robot_arrives_s(const Vec3& site_m) const {
  const double now = vehicle_ ? vehicle_->time_s : 0.0;
  const Vec3& from = robot_ ? robot_->position_m : task_.charger.start_m;
  const double delay = robot_ && robot_->is_delayed ? kDelay_s : 0.0;
  return now + delay + drive_s(task_.charger, from, site_m);
}

ScheduleStart PlanKeeper::start_in_air() const {
  ScheduleStart start;
  start.kind = StartKind::kAir;
  start.position_m = vehicle_->position_m;
  if (vehicle_->velocity_mps.head<2>().norm() > 0.5) start.direction = vehicle_->velocity_mps;
  start.time_s = vehicle_->time_s;
  start.energy = energy_now();
  start.robot_m = robot_ ? robot_->position_m : task_.charger.start_m;
  start.robot_free_s = robot_arrives_s(start.robot_m);
  return start;
}

/// What is ahead and what was left out; of a leg that was broken off only the part not yet flown. Points to
/// fly to are left out unless they are among the committed legs.
std::vector<Leg> PlanKeeper::unflown_legs(std::size_t committed) {
  std::vector<Leg> out(plan_.legs.begin() + static_cast<std::ptrdiff_t>(plan_.legs_done), plan_.legs.end());
  const auto free = out.begin() + static_cast<std::ptrdiff_t>(std::min(committed, out.size()));
  out.erase(std::remove_if(free, out.end(), [](const Leg& leg) { return leg.kind == LegKind::kReposition; }),
            out.end());
  const bool broken_off = track_ && tracked_leg_ == plan_.legs_done && !out.empty() &&
                          !covers(plan_.legs_done) &&
                          out.front().sub_cell_id == plan_.legs[plan_.legs_done].sub_cell_id;
  if (broken_off) {
    const double flown = track_->flown_from_entry_m();
    const double length = track_->length_m();
    if (flown > 1.0 && flown < length)
      out.front().entry_m += (out.front().exit_m - out.front().entry_m) * ((flown - 0.5) / length);
  }
  out.insert(out.end(), gaps_.begin(), gaps_.end());
  return cut_to_battery(std::move(out), committed);
}

/// A leg that no flight can cover becomes several: an aged battery or a strong wind may have made it too
/// long.
std::vector<Leg> PlanKeeper::cut_to_battery(std::vector<Leg> legs, std::size_t from) {
  const FlightModel flight = model();
  const StopParams stops = rest_params().stops;
  const double room = (task_.battery.capacity - task_.battery.reserve - stops.spare) / stops.energy_factor;
  std::vector<Leg> out;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Leg& leg = legs[i];
    const double ends = flight.take_off(leg.entry_m).energy + flight.landing(leg.exit_m).energy;
    const double cover = flight.level(leg.entry_m, leg.exit_m).energy;
    const bool fits = i < from || ends + cover <= room || ends >= kMostEndsShare * room;
    const int parts = fits ? 1 : static_cast<int>(std::ceil(cover / (room - ends)));
    for (int part = 0; part < parts; ++part) {
      Leg piece = leg;
      if (part > 0) piece.sub_cell_id = next_id_++;
      piece.entry_m = leg.entry_m + (leg.exit_m - leg.entry_m) * (static_cast<double>(part) / parts);
      piece.exit_m = leg.entry_m + (leg.exit_m - leg.entry_m) * (static_cast<double>(part + 1) / parts);
      out.push_back(piece);
    }
  }
  return out;
}

Leg PlanKeeper::point_leg(const Vec3& at_m) {
  Leg leg;
  leg.sub_cell_id = next_id_++;
  leg.kind = LegKind::kReposition;
  leg.entry_m = at_m;
  leg.exit_m = at_m;
  leg.height_m = at_m.z() - terrain_.height_at(at_m.x(), at_m.y());
  leg.width_m = task_.sensor_width_m;
  return leg;
}

/// Where the aircraft will be when a change can have reached it.
Vec3 PlanKeeper::point_ahead() const {
  if (is_on_path()) return lifted(path_.position_m(vehicle_->time_s + params_.reaction_s));
  Vec3 way = vehicle_->velocity_mps;
  way.z() = 0.0;
  Vec3 out = vehicle_->position_m + way * params_.reaction_s;
  // Where a no-fly area or a hole begins before that, it need not go so far.
  const Vec2 here = vehicle_->position_m.head<2>();
  for (const double share : {0.5, 0.25, 0.0}) {
    if (ways_->is_free(here, out.head<2>())) break;
    out = vehicle_->position_m + way * (share * params_.reaction_s);
  }
  return lifted(out);
}

/// Just off the ground there is no place to fly to but above.
Vec3 PlanKeeper::lifted(Vec3 at_m) const {
  const double ground_m = terrain_.height_at(at_m.x(), at_m.y());
  at_m.z() = std::max(at_m.z(), ground_m + 1.5 * task_.vehicle.clearance_m() + kAboveGround_m);
  return at_m;
}

void PlanKeeper::adopt(RestPlan rest, const std::string& reason) {
  plan_.legs.resize(plan_.legs_done);
  if (!rest.legs.empty()) set_approach(plan_, std::move(rest.approach_m));
  // What was to follow the last flown leg follows no longer: aloft it flies on, on the ground it stands where
  // it is.
  if (plan_.legs_done > 0 && !rest.legs.empty()) {
    Transfer& after = plan_.legs.back().transfer;
    if (!vehicle_->on_ground()) {
      after = Transfer::kFF;
    } else if (after == Transfer::kEnd || !at_meeting(*vehicle_)) {
      after = Transfer::kFDUF;
    }
  }
  plan_.legs.insert(plan_.legs.end(), rest.legs.begin(), rest.legs.end());
  plan_.rendezvous = std::move(rest.rendezvous);
  plan_.end_s = rest.end_s;
  gaps_.clear();
  told_no_plan_ = false;
  promised_s_.reset();
  note_revision(reason);
}

bool PlanKeeper::solve_in_flight(const std::string& reason, Otherwise otherwise) {
  const std::size_t now = plan_.legs_done;
  const bool covering = covers(now);
  const Commitment begun = committed();
  Rest whole{unflown_legs(begun.legs), begun.legs};
  if (whole.legs.empty()) return false;
  ScheduleStart start = start_in_air();
  // Whatever the path waits for and goes round may be in the way of other legs as well.
  start.energy = std::max(0.0, start.energy - surcharge());
  RestParams params = rest_params();
  // Landing early costs little, landing late the reserve; and a path that changes on the way has stops more.
  params.stops.battery.reserve +=
      landing_spare() + kStopsToChange * model().stop(start.position_m.z()).energy;
  const Vec3 entry_m = whole.legs.front().entry_m;
  if (covering) whole.legs.front().entry_m = start.position_m;
  // First: what is under way is finished, then it lands where it does best.
  std::optional<RestPlan> found = plan_rest(whole, start, now, model(), params);
  if (!found) {
    // Else it may land a little ahead of here, and come back.
    const std::size_t before_landing = split_ahead(whole, begun);
    found = plan_rest(whole, start, now, model(), params);
    if (!found && otherwise == Otherwise::kGoOn) return false;
    if (!found) {
      land_at_once(whole.legs, before_landing, reason);
      keep_track_of_leg(entry_m, covering);
      return true;
    }
  }
  adopt(std::move(*found), reason);
  keep_track_of_leg(entry_m, covering);
  return true;
}

/// Where the aircraft lands at a time and a schedule begins with it on the robot.
Rendezvous PlanKeeper::meeting_at(const ScheduleStart& docked, double land_s, const Recharge& charge) const {
  Rendezvous out;
  out.site_m = docked.position_m;
  out.robot_arrives_s = docked.time_s - task_.charger.landing_s;
  out.land_s = land_s;
  out.arrive_by_s = land_s;
  out.depart_s = charge.ready_s + params_.planning.lead_s;
  out.energy_from = docked.energy;
  out.charge_to = charge.energy_to;
  out.wait_s = std::max(0.0, out.robot_arrives_s - land_s);
  return out;
}

/// The rest from where the robot meets the aircraft, or from the next leg's entry where it carries it to;
/// `start` is docked at the one, and comes back docked at the other.
std::optional<RestPlan> PlanKeeper::plan_from_robot(std::vector<Leg> legs, ScheduleStart& start,
                                                    bool is_carried) {
  const FlightModel flight = model();
  const Vec3 site = start.position_m;
  if (is_carried) {
    start.position_m = flight.ground(legs.front().entry_m);
    start.time_s += drive_s(task_.charger, site, start.position_m);
    if (!std::isfinite(start.time_s)) return std::nullopt;
  } else {
    Vec3 above = site;
    above.z() = std::max(legs.front().entry_m.z(), site.z() + task_.vehicle.clearance_m() + kAboveGround_m);
    legs.insert(legs.begin(), point_leg(above));
  }
  const RestParams params = rest_params();
  no_plan_ = why_no_rest(legs, flight, params.stops);
  return plan_rest({std::move(legs), 1}, start, plan_.legs_done, flight, params);
}

/// It has not flown, and needs nobody for that.
bool PlanKeeper::solve_at_start(const std::vector<Leg>& legs, const std::string& reason) {
  ScheduleStart start;
  start.position_m = model().ground(vehicle_->position_m);
  start.energy = energy_now();
  start.time_s = vehicle_->time_s;
  start.robot_m = robot_ ? robot_->position_m : task_.charger.start_m;
  start.robot_free_s = vehicle_->time_s;
  auto found = plan_rest({legs, 0}, start, plan_.legs_done, model(), rest_params());
  if (found) adopt(std::move(*found), reason);
  return found.has_value();
}

/// Landed where no meeting was planned: the robot comes here first.
bool PlanKeeper::solve_on_ground(const std::string& reason) {
  const std::vector<Leg> legs = unflown_legs();
  if (legs.empty()) return false;
  if (!has_flown_ && solve_at_start(legs, reason)) return true;
  const Vec3 site = model().ground(vehicle_->position_m);
  const double arrives = std::max(vehicle_->time_s, robot_arrives_s(site));
  no_plan_ = "the robot has no way to where the aircraft landed";
  if (!std::isfinite(arrives)) return false;
  ScheduleStart met;
  met.kind = StartKind::kDocked;
  met.position_m = site;
  met.energy = energy_now();
  met.time_s = arrives + task_.charger.landing_s;
  ScheduleStart start = met;
  std::optional<RestPlan> found;
  if (const auto barred = barred_at(task_.fields, task_.no_fly, site.head<2>())) {
    no_plan_ = "the robot has no way to carry the aircraft out of " + *barred;
    found = plan_from_robot(legs, start, true);
  } else {
    found = plan_from_robot(legs, start, false);
    ScheduleStart carried = met;
    // To be carried from there it need not take off there first.
    const bool lands_again =
        found && !found->rendezvous.empty() && found->rendezvous.front().id == exit_id(plan_.legs_done);
    auto other = !found || lands_again ? plan_from_robot(legs, carried, true) : std::nullopt;
    if (other && (!found || other->end_s < found->end_s)) {
      found = std::move(other);
      start = carried;
    }
  }
  if (!found && std::exchange(detour_energy_, 0.0) > 0.0) return solve_on_ground(reason);
  if (!found) return false;
  no_plan_.clear();
  Rendezvous meeting = meeting_at(met, vehicle_->time_s, *found->first);
  meeting.carry = start.position_m != site;
  meeting.carry_to_m = start.position_m;
  // It meets the robot before the next leg, as if at its entry.
  meeting.id = entry_id(plan_.legs_done);
  found->rendezvous.insert(found->rendezvous.begin(), meeting);
  adopt(std::move(*found), reason);
  track_.reset();
  return true;
}

/// On the robot, or waiting for it, at the meeting at hand: the rest from its take-off on.
bool PlanKeeper::solve_docked(const std::string& reason) {
  std::vector<Leg> legs = unflown_legs();
  if (legs.empty() || plan_.rendezvous.empty()) return false;
  const FlightModel flight = model();
  Rendezvous meeting = plan_.rendezvous.front();
  const bool stays_next = meeting.carry || is_at_entry(meeting.id);
  // Landed before the leg at whose exit it was to land: now it is at the entry of the next.
  if (legs_before(meeting.id) > plan_.legs_done) meeting.id = entry_id(plan_.legs_done);
  ScheduleStart start;
  start.kind = StartKind::kDocked;
  start.position_m = meeting.carry ? meeting.carry_to_m : meeting.site_m;
  start.time_s = vehicle_->mode == AircraftMode::kDocked
                     ? vehicle_->time_s
                     : std::max(vehicle_->time_s, robot_arrives_s(meeting.site_m)) + task_.charger.landing_s;
  start.time_s += drive_s(task_.charger, vehicle_->position_m, start.position_m);
  if (!std::isfinite(start.time_s)) return false;
  start.energy = energy_now();
  // Carried to an entry, it takes off there: that leg stays the next.
  auto found = plan_rest({std::move(legs), stays_next ? std::size_t{1} : std::size_t{0}}, start,
                         plan_.legs_done, flight, rest_params());
  if (!found) return false;
  meeting.charge_to = found->first->energy_to;
  meeting.depart_s = found->first->ready_s + params_.planning.lead_s;
  found->rendezvous.insert(found->rendezvous.begin(), meeting);
  adopt(std::move(*found), reason);
  track_.reset();
  return true;
}

bool PlanKeeper::top_up_charge() {
  if (plan_.rendezvous.empty()) return false;
  if (!gaps_.empty()) return may_retry() && solve_docked("a stretch was left out");
  if (plan_.legs_done >= plan_.legs.size()) return false;
  Rendezvous& meeting = plan_.rendezvous.front();
  Rendezvous* next = plan_.rendezvous.size() > 1 ? &plan_.rendezvous[1] : nullptr;
  ScheduleStart start;
  start.position_m = meeting.carry ? meeting.carry_to_m : meeting.site_m;
  const StopParams stops = rest_params().stops;
  const double flight = flight_to(next, start).energy;
  // With less than lets it come down from anywhere on its way it would do so at once.
  const Vec3& high_m = plan_.legs[plan_.legs_done].entry_m;
  const double down = spare_to_come_down(model().landing(high_m), Vec3::Zero(), high_m.z());
  // What the plan allowed for is no news.
  const double least = std::max(landing_spare(), down) + flight * (1.0 + kLeastAllowance);
  if (task_.battery.reserve + least <= meeting.charge_to) return false;
  const double asked = task_.battery.reserve + stops.spare + flight * stops.energy_factor;
  const double needs =
      std::max(asked, std::min(task_.battery.capacity, asked - stops.spare + detour_energy_ + down));
  if (needs <= meeting.charge_to) return false;
  if (needs > task_.battery.capacity)
    return may_retry() && solve_docked("consumption is higher than predicted");
  const bool is_short = asked > meeting.charge_to;
  // The sortie's consumption stays as predicted: both its ends are raised together.
  const double more = needs - meeting.charge_to;
  const std::size_t past = next != nullptr ? legs_before(next->id) : plan_.legs.size();
  for (std::size_t i = plan_.legs_done; i < past && i < plan_.legs.size(); ++i) {
    plan_.legs[i].energy_before += more;
    plan_.legs[i].energy_after += more;
  }
  if (next != nullptr) next->energy_from += more;
  meeting.charge_to = needs;
  note_revision(is_short ? "charges more: consumption is higher than predicted"
                         : "charges more: enough to come down from anywhere on its way");
  return true;
}

}  // namespace swallowtail::coverage
