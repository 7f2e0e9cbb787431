#include "coverage/participant/convert.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::coverage {
namespace {

constexpr std::size_t kMaxReason = 128;

Vec3 to_vec(const data::Vec3& v) { return {v.x_m, v.y_m, v.z_m}; }
data::Vec3 to_data(const Vec3& v) { return {.x_m = v.x(), .y_m = v.y(), .z_m = v.z()}; }

AircraftMode to_mode(data::VehicleMode mode) {
  switch (mode) {
    case data::VehicleMode::kLanded:
      return AircraftMode::kLanded;
    case data::VehicleMode::kDocked:
      return AircraftMode::kDocked;
    case data::VehicleMode::kTakingOff:
      return AircraftMode::kTakingOff;
    case data::VehicleMode::kLanding:
      return AircraftMode::kLanding;
    case data::VehicleMode::kTransfer:
    case data::VehicleMode::kCovering:
    case data::VehicleMode::kHolding:
      return AircraftMode::kFlying;
  }
  return AircraftMode::kFlying;
}

planner::Phase to_phase(data::PathPhase phase) {
  switch (phase) {
    case data::PathPhase::kTakeOff:
      return planner::Phase::kTakeOff;
    case data::PathPhase::kTransfer:
      return planner::Phase::kTransfer;
    case data::PathPhase::kCover:
      return planner::Phase::kCover;
    case data::PathPhase::kHold:
      return planner::Phase::kHold;
    case data::PathPhase::kLanding:
      return planner::Phase::kLanding;
  }
  return planner::Phase::kHold;
}

/// A part of a plan's bends.
struct Part {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

Part add_bends(const std::vector<Vec3>& bends, std::vector<data::Vec3>& pool) {
  if (bends.empty()) return {};
  const Part out{static_cast<std::uint32_t>(pool.size()), static_cast<std::uint32_t>(bends.size())};
  for (const Vec3& bend : bends) pool.push_back(to_data(bend));
  return out;
}

data::Leg to_data(const Leg& leg) {
  data::Leg out;
  out.sub_cell_id = leg.sub_cell_id;
  out.kind = leg.kind == LegKind::kCover ? data::LegKind::kCover : data::LegKind::kReposition;
  out.entry = to_data(leg.entry_m);
  out.exit = to_data(leg.exit_m);
  out.height_m = leg.height_m;
  out.transfer = static_cast<data::Transfer>(leg.transfer);
  out.energy_before = std::max(0.0, leg.energy_before);
  out.energy_after = std::max(0.0, leg.energy_after);
  out.start_s = leg.start_s;
  out.end_s = leg.end_s;
  return out;
}

data::Rendezvous to_data(const Rendezvous& meeting) {
  data::Rendezvous out;
  out.rendezvous_id = meeting.id;
  out.site = to_data(meeting.site_m);
  out.arrive_by_s = meeting.arrive_by_s;
  out.depart_s = std::max(meeting.arrive_by_s, meeting.depart_s);
  out.charge_to = meeting.charge_to;
  out.carry = meeting.carry;
  out.carry_to = to_data(meeting.carry_to_m);
  out.robot_energy = meeting.robot_energy;
  out.robot_energy_left = meeting.robot_energy_left;
  return out;
}

/// How the robot drives from one place to another.
struct RobotWay {
  std::vector<Vec3> bends_m{};  ///< beginning with where it comes from; empty: straight
  double speed_mps = 0.0;       ///< that it has on the whole
};

RobotWay robot_way(const Charger& charger, const planner::Terrain& terrain, const Vec3& from,
                   const Vec3& to) {
  RobotWay out{.speed_mps = charger.speed_mps};
  if (!charger.travel) return out;
  double length_m = 0.0;
  Vec2 last = from.head<2>();
  for (const Vec2& bend : charger.travel->bends(from.head<2>(), to.head<2>())) {
    length_m += (bend - last).norm();
    last = bend;
    out.bends_m.emplace_back(bend.x(), bend.y(), terrain.height_at(bend.x(), bend.y()));
  }
  if (!out.bends_m.empty()) out.bends_m.insert(out.bends_m.begin(), from);
  length_m += (to.head<2>() - last).norm();
  const double time_s = charger.travel->drive_s(from.head<2>(), to.head<2>());
  if (std::isfinite(time_s) && time_s > 0.0 && length_m > 0.0)
    out.speed_mps = std::min(out.speed_mps, length_m / time_s);
  return out;
}

void add_ways(const LivePlan& plan, const Vec3& start_m, data::CoveragePlan& out) {
  std::vector<Vec3> approach_m = plan.approach_m;
  if (!approach_m.empty())
    approach_m.insert(approach_m.begin(), {start_m.x(), start_m.y(), approach_m.front().z()});
  for (std::size_t i = 0; i < plan.legs.size(); ++i) {
    const Part way = add_bends(i == 0 ? approach_m : plan.legs[i - 1].transfer_m, out.bends);
    out.legs[i].first_bend = way.first;
    out.legs[i].bend_count = way.count;
  }
}

/// The robot at its depot before a meeting, or (none) after the last of all; `held` is what it has on its
/// arrival.
data::Rendezvous depot_stop(const LivePlan& plan, const Charger& charger, const Rendezvous* before,
                            const Vec3& depot_m, double held) {
  const double refill_s = charger.battery.refill_s;
  data::Rendezvous out;
  out.kind = data::StopKind::kDepot;
  out.site = out.carry_to = to_data(depot_m);
  out.robot_energy = held;
  out.robot_energy_left = charger.battery.capacity;
  if (before != nullptr) {
    out.rendezvous_id = before->id;
    out.depart_s = std::max(0.0, before->robot_arrives_s - drive_s(charger, depot_m, before->site_m));
    out.arrive_by_s = std::max(0.0, out.depart_s - refill_s);
    return out;
  }
  out.rendezvous_id = entry_id(plan.legs.size() + 1);
  if (plan.rendezvous.empty()) return out;
  const Rendezvous& last = plan.rendezvous.back();
  const double home_s = drive_s(charger, last.carry ? last.carry_to_m : last.site_m, depot_m);
  if (!std::isfinite(home_s)) return out;
  out.arrive_by_s = std::max(0.0, last.depart_s) + home_s;
  out.depart_s = out.arrive_by_s + refill_s;
  return out;
}

/// Writes the robot's stops in the order in which it drives to them, each with its way there and home.
class StopWriter {
 public:
  StopWriter(const Charger& charger, const planner::Terrain& terrain, const Vec3& robot_m,
             data::ChargerPlan& out)
      : charger_(charger), terrain_(terrain), depot_m_(charger.start_m), at_m_(robot_m), out_(out) {
    depot_m_.z() = terrain.height_at(depot_m_.x(), depot_m_.y());
    if (!is_limited()) return;
    const RobotWay home = robot_way(charger_, terrain_, at_m_, depot_m_);
    const Part way = add_bends(home.bends_m, out_.bends);
    out_.home_first_bend = way.first;
    out_.home_bend_count = way.count;
    out_.home_speed_mps = home.speed_mps;
  }

  bool is_limited() const { return std::isfinite(charger_.battery.capacity); }
  const Vec3& depot_m() const { return depot_m_; }

  /// What is left of so much once it has driven to the depot.
  double held_at_depot(double energy) const {
    const double home_s = drive_s(charger_, at_m_, depot_m_);
    return std::isfinite(home_s) ? std::max(0.0, energy - charger_.battery.drive_per_s * home_s) : 0.0;
  }

  void add(data::Rendezvous stop, const Vec3& site_m, const Vec3& end_m) {
    const RobotWay there = robot_way(charger_, terrain_, at_m_, site_m);
    const RobotWay on = robot_way(charger_, terrain_, site_m, end_m);
    const Part way = add_bends(there.bends_m, out_.bends);
    const Part carry = add_bends(on.bends_m, out_.bends);
    stop.first_bend = way.first;
    stop.bend_count = way.count;
    stop.speed_mps = there.speed_mps;
    stop.carry_first_bend = carry.first;
    stop.carry_bend_count = carry.count;
    stop.carry_speed_mps = on.speed_mps;
    if (is_limited() && stop.kind == data::StopKind::kMeeting) {
      const RobotWay back = robot_way(charger_, terrain_, end_m, depot_m_);
      const Part home = add_bends(back.bends_m, out_.bends);
      stop.home_first_bend = home.first;
      stop.home_bend_count = home.count;
      stop.home_speed_mps = back.speed_mps;
    }
    out_.rendezvous.push_back(stop);
    at_m_ = end_m;
  }

 private:
  const Charger& charger_;
  const planner::Terrain& terrain_;
  Vec3 depot_m_;
  Vec3 at_m_;
  data::ChargerPlan& out_;
};

void add_rendezvous(const LivePlan& plan, const Charger& charger, const planner::Terrain& terrain,
                    const Vec3& robot_m, double robot_energy, data::ChargerPlan& out) {
  StopWriter stops(charger, terrain, robot_m, out);
  const auto add_depot = [&](const Rendezvous* before) {
    const data::Rendezvous stop =
        depot_stop(plan, charger, before, stops.depot_m(), stops.held_at_depot(robot_energy));
    stops.add(stop, stops.depot_m(), stops.depot_m());
  };
  for (const Rendezvous& meeting : plan.rendezvous) {
    if (meeting.by_depot) add_depot(&meeting);
    stops.add(to_data(meeting), meeting.site_m, meeting.carry ? meeting.carry_to_m : meeting.site_m);
    robot_energy = meeting.robot_energy_left;
  }
  if (stops.is_limited()) add_depot(nullptr);
}

/// The ways' bends, back where PlanKeeper has them: the first way's without the start.
void take_ways(const data::CoveragePlan& in, LivePlan& out) {
  for (std::size_t i = 0; i < in.legs.size(); ++i) {
    std::vector<Vec3>& way = i == 0 ? out.approach_m : out.legs[i - 1].transfer_m;
    for (std::uint32_t k = i == 0 ? 1 : 0; k < in.legs[i].bend_count; ++k)
      way.push_back(to_vec(in.bends.at(in.legs[i].first_bend + k)));
  }
}

}  // namespace

AircraftView to_view(const data::VehicleState& state) {
  return {state.time_s,
          to_vec(state.position),
          to_vec(state.velocity_mps),
          to_mode(state.mode),
          state.leg_index,
          state.legs_done,
          state.mode == data::VehicleMode::kCovering};
}

BatteryView to_view(const data::BatteryState& state) { return {state.time_s, state.energy, state.capacity}; }

RobotView to_view(const data::ChargerState& state) {
  return {.time_s = state.time_s,
          .position_m = to_vec(state.position),
          .has_vehicle = state.docked_vehicle_id != 0,
          .is_delayed = state.activity == data::ChargerActivity::kDelayed,
          .is_ready = state.activity == data::ChargerActivity::kReady,
          .energy = state.energy};
}

PathView to_view(const data::PathPlan& plan) {
  PathView out{.coverage_revision = plan.basis.coverage_revision, .lands = plan.lands, .waypoints = {}};
  for (const data::TimedWaypoint& w : plan.waypoints)
    out.waypoints.push_back({w.time_s, to_vec(w.position), to_phase(w.phase), w.leg_index});
  return out;
}

WirePlans to_wire(const PlanKeeper& keeper, const planner::Terrain& terrain, const Vec3& robot_m,
                  std::uint32_t terrain_revision) {
  const LivePlan& plan = keeper.plan();
  const Task& task = keeper.task();
  WirePlans out;
  data::CoveragePlan& coverage = out.coverage;
  coverage.task_id = task.id;
  coverage.vehicle_id = task.vehicle_id;
  coverage.revision = plan.revision;
  coverage.basis = {task.revision, terrain_revision, plan.battery_time_s, std::max(0.0, plan.battery_energy),
                    plan.vehicle_time_s};
  coverage.legs_done = static_cast<std::uint32_t>(plan.legs_done);
  coverage.cost = plan.end_s;
  coverage.makespan_s = plan.end_s;
  coverage.field_area_m2 = plan.area_m2;
  coverage.complete = keeper.complete();
  coverage.reason = plan.reason.substr(0, kMaxReason);
  for (const Leg& leg : plan.legs) coverage.legs.push_back(to_data(leg));
  add_ways(plan, task.start_m, coverage);
  data::ChargerPlan& charger = out.charger;
  charger.charger_id = task.charger.id;
  charger.task_id = task.id;
  charger.vehicle_id = task.vehicle_id;
  charger.revision = plan.revision;
  charger.speed_mps = task.charger.speed_mps;
  charger.charge_s_per_unit = task.battery.charge_s_per_unit;
  charger.taper_from = task.battery.taper_from;
  charger.taper_end_rate = task.battery.taper_end_rate;
  charger.landing_s = task.charger.landing_s;
  charger.take_off_s = task.charger.take_off_s;
  charger.start = to_data(task.charger.start_m);
  if (const RobotBattery& own = task.charger.battery; std::isfinite(own.capacity)) {
    charger.has_battery = true;
    charger.battery = {own.capacity, own.reserve, own.drive_per_s, own.per_charged, own.refill_s};
  }
  add_rendezvous(plan, task.charger, terrain, robot_m, keeper.robot_energy(), charger);
  return out;
}

LivePlan from_wire(const data::CoveragePlan& in, const Task& task, const planner::Terrain& terrain) {
  const FlightModel model(task.vehicle, task.battery.model, terrain);
  LivePlan out;
  out.revision = in.revision;
  out.reason = in.reason;
  out.legs_done = in.legs_done;
  out.end_s = in.makespan_s;
  out.area_m2 = in.field_area_m2;
  if (!in.complete) out.lacks = "what was left out before a restart is not known";
  for (const data::Leg& leg : in.legs) {
    out.legs.push_back({.sub_cell_id = leg.sub_cell_id,
                        .kind = leg.kind == data::LegKind::kCover ? LegKind::kCover : LegKind::kReposition,
                        .entry_m = to_vec(leg.entry),
                        .exit_m = to_vec(leg.exit),
                        .height_m = leg.height_m,
                        .width_m = task.sensor_width_m,
                        .transfer = static_cast<Transfer>(leg.transfer),
                        .energy_before = leg.energy_before,
                        .energy_after = leg.energy_after,
                        .start_s = leg.start_s,
                        .end_s = leg.end_s});
  }
  take_ways(in, out);
  for (std::size_t i = 0; i + 1 < out.legs.size(); ++i) {
    const Leg& leg = out.legs[i];
    const Leg& next = out.legs[i + 1];
    const bool at_exit = leg.transfer == Transfer::kFDUF || leg.transfer == Transfer::kFDUFDU ||
                         leg.transfer == Transfer::kFDTU;
    const bool at_entry = leg.transfer == Transfer::kFFDU || leg.transfer == Transfer::kFDUFDU;
    const double lift = model.take_off(next.entry_m).energy;
    const auto add = [&](std::uint32_t id, const Vec3& above, double needs) {
      Rendezvous meeting;
      meeting.id = id;
      meeting.site_m = model.ground(above);
      meeting.carry = leg.transfer == Transfer::kFDTU;
      meeting.carry_to_m = meeting.carry ? model.ground(next.entry_m) : meeting.site_m;
      meeting.land_s = leg.end_s;
      meeting.arrive_by_s = leg.end_s;
      meeting.robot_arrives_s = leg.end_s;
      meeting.depart_s = next.start_s;
      meeting.charge_to = std::min(task.battery.capacity, needs);
      out.rendezvous.push_back(meeting);
    };
    const double hop = model.level(leg.exit_m, next.entry_m).energy;
    if (at_exit)
      add(exit_id(i), leg.exit_m,
          leg.transfer == Transfer::kFDUFDU ? task.battery.capacity : next.energy_before + lift + hop);
    if (at_entry) add(entry_id(i + 1), next.entry_m, next.energy_before + lift);
  }
  return out;
}

}  // namespace swallowtail::coverage
