#include "idl/codec/fastdds/plan.hpp"

namespace swallowtail::codec::fast {

namespace {

data::Refusal get_bend(const swallowtail_wire::Vector3& w, data::Vec3& d) {
  d = vec3(w);
  return {};
}

void put_bend(const data::Vec3& d, swallowtail_wire::Vector3& w) { w = vec3(d); }

data::Refusal get_leg(const swallowtail_wire::Leg& w, data::Leg& d) {
  d.sub_cell_id = w.sub_cell_id();
  if (!get_enum(w.kind(), data::LegKind::kReposition, d.kind)) return kBadEnumerator;
  d.entry = vec3(w.entry());
  d.exit = vec3(w.exit());
  d.height_m = w.height_m();
  if (!get_enum(w.transfer(), data::Transfer::kEnd, d.transfer)) return kBadEnumerator;
  d.energy_before = w.energy_before();
  d.energy_after = w.energy_after();
  d.start_s = w.start_s();
  d.end_s = w.end_s();
  d.first_bend = w.first_bend();
  d.bend_count = w.bend_count();
  return {};
}

void put_leg(const data::Leg& d, swallowtail_wire::Leg& w) {
  w.sub_cell_id() = d.sub_cell_id;
  put_enum(d.kind, w.kind());
  w.entry() = vec3(d.entry);
  w.exit() = vec3(d.exit);
  w.height_m() = d.height_m;
  put_enum(d.transfer, w.transfer());
  w.energy_before() = d.energy_before;
  w.energy_after() = d.energy_after;
  w.start_s() = d.start_s;
  w.end_s() = d.end_s;
  w.first_bend() = d.first_bend;
  w.bend_count() = d.bend_count;
}

data::Refusal get_coverage_basis(const swallowtail_wire::CoverageBasis& w, data::CoverageBasis& d) {
  d.task_revision = w.task_revision();
  d.terrain_revision = w.terrain_revision();
  d.battery_time_s = w.battery_time_s();
  d.battery_energy = w.battery_energy();
  d.vehicle_time_s = w.vehicle_time_s();
  return {};
}

void put_coverage_basis(const data::CoverageBasis& d, swallowtail_wire::CoverageBasis& w) {
  w.task_revision() = d.task_revision;
  w.terrain_revision() = d.terrain_revision;
  w.battery_time_s() = d.battery_time_s;
  w.battery_energy() = d.battery_energy;
  w.vehicle_time_s() = d.vehicle_time_s;
}

data::Refusal get_rendezvous(const swallowtail_wire::Rendezvous& w, data::Rendezvous& d) {
  d.rendezvous_id = w.rendezvous_id();
  if (!get_enum(w.kind(), data::StopKind::kDepot, d.kind)) return kBadEnumerator;
  d.site = vec3(w.site());
  d.arrive_by_s = w.arrive_by_s();
  d.depart_s = w.depart_s();
  d.charge_to = w.charge_to();
  d.carry = w.carry();
  d.carry_to = vec3(w.carry_to());
  d.first_bend = w.first_bend();
  d.bend_count = w.bend_count();
  d.speed_mps = w.speed_mps();
  d.carry_first_bend = w.carry_first_bend();
  d.carry_bend_count = w.carry_bend_count();
  d.carry_speed_mps = w.carry_speed_mps();
  d.robot_energy = w.robot_energy();
  d.robot_energy_left = w.robot_energy_left();
  d.home_first_bend = w.home_first_bend();
  d.home_bend_count = w.home_bend_count();
  d.home_speed_mps = w.home_speed_mps();
  return {};
}

void put_rendezvous(const data::Rendezvous& d, swallowtail_wire::Rendezvous& w) {
  w.rendezvous_id() = d.rendezvous_id;
  put_enum(d.kind, w.kind());
  w.site() = vec3(d.site);
  w.arrive_by_s() = d.arrive_by_s;
  w.depart_s() = d.depart_s;
  w.charge_to() = d.charge_to;
  w.carry() = d.carry;
  w.carry_to() = vec3(d.carry_to);
  w.first_bend() = d.first_bend;
  w.bend_count() = d.bend_count;
  w.speed_mps() = d.speed_mps;
  w.carry_first_bend() = d.carry_first_bend;
  w.carry_bend_count() = d.carry_bend_count;
  w.carry_speed_mps() = d.carry_speed_mps;
  w.robot_energy() = d.robot_energy;
  w.robot_energy_left() = d.robot_energy_left;
  w.home_first_bend() = d.home_first_bend;
  w.home_bend_count() = d.home_bend_count;
  w.home_speed_mps() = d.home_speed_mps;
}

data::Refusal get_timed_waypoint(const swallowtail_wire::TimedWaypoint& w, data::TimedWaypoint& d) {
  d.time_s = w.time_s();
  d.position = vec3(w.position());
  if (!get_enum(w.phase(), data::PathPhase::kLanding, d.phase)) return kBadEnumerator;
  d.leg_index = w.leg_index();
  return {};
}

void put_timed_waypoint(const data::TimedWaypoint& d, swallowtail_wire::TimedWaypoint& w) {
  w.time_s() = d.time_s;
  w.position() = vec3(d.position);
  put_enum(d.phase, w.phase());
  w.leg_index() = d.leg_index;
}

data::Refusal get_path_basis(const swallowtail_wire::PathBasis& w, data::PathBasis& d) {
  d.coverage_revision = w.coverage_revision();
  d.goal_revision = w.goal_revision();
  d.terrain_revision = w.terrain_revision();
  d.obstacle_revision = w.obstacle_revision();
  d.vehicle_time_s = w.vehicle_time_s();
  return {};
}

void put_path_basis(const data::PathBasis& d, swallowtail_wire::PathBasis& w) {
  w.coverage_revision() = d.coverage_revision;
  w.goal_revision() = d.goal_revision;
  w.terrain_revision() = d.terrain_revision;
  w.obstacle_revision() = d.obstacle_revision;
  w.vehicle_time_s() = d.vehicle_time_s;
}

}  // namespace

data::Refusal to_data(const swallowtail_wire::CoveragePlan& w, data::CoveragePlan& d) {
  d.task_id = w.task_id();
  d.vehicle_id = w.vehicle_id();
  d.revision = w.revision();
  if (const auto refusal = get_coverage_basis(w.basis(), d.basis)) return refusal;
  d.legs_done = w.legs_done();
  d.cost = w.cost();
  d.makespan_s = w.makespan_s();
  d.field_area_m2 = w.field_area_m2();
  d.complete = w.complete();
  get_text(w.reason(), d.reason);
  if (const auto refusal = get_sequence(w.legs(), data::kMaxLegs, d.legs, get_leg)) return refusal;
  if (const auto refusal = get_sequence(w.bends(), data::kMaxBends, d.bends, get_bend)) return refusal;
  return {};
}

void to_wire(const data::CoveragePlan& d, swallowtail_wire::CoveragePlan& w) {
  w.task_id() = d.task_id;
  w.vehicle_id() = d.vehicle_id;
  w.revision() = d.revision;
  put_coverage_basis(d.basis, w.basis());
  w.legs_done() = d.legs_done;
  w.cost() = d.cost;
  w.makespan_s() = d.makespan_s;
  w.field_area_m2() = d.field_area_m2;
  w.complete() = d.complete;
  put_text(d.reason, w.reason());
  put_sequence(d.legs, w.legs(), put_leg);
  put_sequence(d.bends, w.bends(), put_bend);
}

data::Refusal to_data(const swallowtail_wire::ChargerPlan& w, data::ChargerPlan& d) {
  d.charger_id = w.charger_id();
  d.task_id = w.task_id();
  d.vehicle_id = w.vehicle_id();
  d.revision = w.revision();
  d.speed_mps = w.speed_mps();
  d.charge_s_per_unit = w.charge_s_per_unit();
  d.taper_from = w.taper_from();
  d.taper_end_rate = w.taper_end_rate();
  d.landing_s = w.landing_s();
  d.take_off_s = w.take_off_s();
  d.start = vec3(w.start());
  d.has_battery = w.has_battery();
  d.battery = robot_battery(w.battery());
  d.home_first_bend = w.home_first_bend();
  d.home_bend_count = w.home_bend_count();
  d.home_speed_mps = w.home_speed_mps();
  if (const auto refusal = get_sequence(w.rendezvous(), data::kMaxRendezvous, d.rendezvous, get_rendezvous))
    return refusal;
  if (const auto refusal = get_sequence(w.bends(), data::kMaxBends, d.bends, get_bend)) return refusal;
  return {};
}

void to_wire(const data::ChargerPlan& d, swallowtail_wire::ChargerPlan& w) {
  w.charger_id() = d.charger_id;
  w.task_id() = d.task_id;
  w.vehicle_id() = d.vehicle_id;
  w.revision() = d.revision;
  w.speed_mps() = d.speed_mps;
  w.charge_s_per_unit() = d.charge_s_per_unit;
  w.taper_from() = d.taper_from;
  w.taper_end_rate() = d.taper_end_rate;
  w.landing_s() = d.landing_s;
  w.take_off_s() = d.take_off_s;
  w.start() = vec3(d.start);
  w.has_battery() = d.has_battery;
  w.battery() = robot_battery(d.battery);
  w.home_first_bend() = d.home_first_bend;
  w.home_bend_count() = d.home_bend_count;
  w.home_speed_mps() = d.home_speed_mps;
  put_sequence(d.rendezvous, w.rendezvous(), put_rendezvous);
  put_sequence(d.bends, w.bends(), put_bend);
}

data::Refusal to_data(const swallowtail_wire::PathPlan& w, data::PathPlan& d) {
  d.vehicle_id = w.vehicle_id();
  d.revision = w.revision();
  if (const auto refusal = get_path_basis(w.basis(), d.basis)) return refusal;
  if (!get_enum(w.verdict(), data::PathVerdict::kNoSafePath, d.verdict)) return kBadEnumerator;
  get_text(w.reason(), d.reason);
  d.lands = w.lands();
  d.length_m = w.length_m();
  d.duration_s = w.duration_s();
  d.clearance_min_m = w.clearance_min_m();
  d.replan_ms = w.replan_ms();
  if (const auto refusal = get_sequence(w.waypoints(), data::kMaxWaypoints, d.waypoints, get_timed_waypoint))
    return refusal;
  return {};
}

void to_wire(const data::PathPlan& d, swallowtail_wire::PathPlan& w) {
  w.vehicle_id() = d.vehicle_id;
  w.revision() = d.revision;
  put_path_basis(d.basis, w.basis());
  put_enum(d.verdict, w.verdict());
  put_text(d.reason, w.reason());
  w.lands() = d.lands;
  w.length_m() = d.length_m;
  w.duration_s() = d.duration_s;
  w.clearance_min_m() = d.clearance_min_m;
  w.replan_ms() = d.replan_ms;
  put_sequence(d.waypoints, w.waypoints(), put_timed_waypoint);
}

}  // namespace swallowtail::codec::fast
