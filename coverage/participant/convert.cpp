#include "coverage/participant/convert.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::coverage {
namespace {

constexpr std::size_t kMaxReason = 128;

Vec3 to_vec(const data::Vec3& v) { return {v.x_m, v.y_m, v.z_m}; }
data::Vec3 to_data(const Vec3& v) { return {.x_m = v.x(), .y_m = v.y(), .z_m = v.z()}; }

planner::VehicleLimits to_limits(const data::VehicleLimits& v) {
  return {v.radius_m,          v.margin_m,     v.cruise_speed_mps, v.climb_speed_mps,
          v.descent_speed_mps, v.turn_max_rad, v.climb_max_rad};
}

Battery to_battery(const data::BatteryLimits& b) {
  const data::EnergyModel& m = b.model;
  Battery out;
  out.capacity = b.capacity;
  out.reserve = b.reserve;
  out.levels = static_cast<int>(std::min<std::uint32_t>(b.levels, 1000));
  out.charge_s_per_unit = b.charge_s_per_unit;
  out.model = {m.level_per_s, m.climb_per_s, m.descent_per_s, m.hover_per_s, m.landed_per_s};
  return out;
}

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
  return out;
}

}  // namespace

Task to_task(const data::CoverageTask& in) {
  Task out;
  out.id = in.task_id;
  out.revision = in.revision;
  out.vehicle_id = in.vehicle_id;
  out.origin = planner::GeoOrigin{in.origin.lat_deg, in.origin.lon_deg, in.origin.elevation_m};
  for (const data::Field& field : in.fields) {
    out.fields.push_back({field.field_id, "field " + std::to_string(field.field_id), {}, field.height_m});
  }
  for (const data::Ring& ring : in.rings) {
    Ring points;
    for (std::uint32_t i = 0; i < ring.point_count; ++i) {
      const data::Point2& p = in.points.at(ring.first_point + i);
      points.emplace_back(p.x_m, p.y_m);
    }
    Polygon& polygon = out.fields.at(ring.area_index).polygon;
    if (ring.is_hole) {
      polygon.holes.push_back(std::move(points));
    } else {
      polygon.outline = std::move(points);
    }
  }
  out.sensor_width_m = in.sensor_width_m;
  out.height_tolerance_m = in.height_tolerance_m;
  out.height_band_m = in.height_band_m;
  out.neighbours = static_cast<int>(in.neighbours);
  out.vehicle = to_limits(in.vehicle);
  out.battery = to_battery(in.battery);
  out.charger = {in.charger.charger_id, in.charger.speed_mps, in.charger.take_off_s, in.charger.landing_s,
                 to_vec(in.charger.start)};
  out.start_m = to_vec(in.start);
  out.seed = in.seed;
  return out;
}

Status check_polygons(const Task& task) {
  for (const Field& field : task.fields) {
    const Result<std::vector<Polygon>> parts = clean(field.polygon);
    if (!parts) return bad_input("Field " + std::to_string(field.id) + ": " + parts.error().message);
  }
  return {};
}

AircraftView to_view(const data::VehicleState& state) {
  return {state.time_s,        to_vec(state.position), to_vec(state.velocity_mps),
          to_mode(state.mode), state.leg_index,        state.legs_done};
}

BatteryView to_view(const data::BatteryState& state) { return {state.time_s, state.energy, state.capacity}; }

RobotView to_view(const data::ChargerState& state) {
  return {state.time_s, to_vec(state.position), state.docked_vehicle_id != 0,
          state.activity == data::ChargerActivity::kDelayed};
}

WirePlans to_wire(const PlanKeeper& keeper, std::uint32_t terrain_revision) {
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
  data::ChargerPlan& charger = out.charger;
  charger.charger_id = task.charger.id;
  charger.task_id = task.id;
  charger.vehicle_id = task.vehicle_id;
  charger.revision = plan.revision;
  charger.speed_mps = task.charger.speed_mps;
  charger.charge_s_per_unit = task.battery.charge_s_per_unit;
  charger.landing_s = task.charger.landing_s;
  charger.take_off_s = task.charger.take_off_s;
  charger.start = to_data(task.charger.start_m);
  for (const Rendezvous& meeting : plan.rendezvous) charger.rendezvous.push_back(to_data(meeting));
  return out;
}

LivePlan from_wire(const data::CoveragePlan& in, const Task& task, const planner::Terrain& terrain) {
  const FlightModel model(task.vehicle, task.battery.model, terrain);
  LivePlan out;
  out.revision = in.revision;
  out.reason = in.reason;
  out.legs_done = 0;  // counted anew from VehicleState
  out.end_s = in.makespan_s;
  out.area_m2 = in.field_area_m2;
  out.complete = in.complete;
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
  for (std::size_t i = 0; i + 1 < out.legs.size(); ++i) {
    const Leg& leg = out.legs[i];
    const Leg& next = out.legs[i + 1];
    const bool at_exit = leg.transfer == Transfer::kFDUF || leg.transfer == Transfer::kFDUFDU ||
                         leg.transfer == Transfer::kFDTU;
    const bool at_entry = leg.transfer == Transfer::kFFDU || leg.transfer == Transfer::kFDUFDU;
    const double lift = model.take_off(next.entry_m).energy;
    const auto add = [&](std::size_t id, const Vec3& above, double needs) {
      Rendezvous meeting;
      meeting.id = static_cast<std::uint32_t>(id);
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
      add(2 * i, leg.exit_m,
          leg.transfer == Transfer::kFDUFDU ? task.battery.capacity : next.energy_before + lift + hop);
    if (at_entry) add(2 * i + 1, next.entry_m, next.energy_before + lift);
  }
  return out;
}

}  // namespace swallowtail::coverage
