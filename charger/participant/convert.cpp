#include "charger/participant/convert.hpp"

#include <algorithm>

namespace swallowtail::charger {
namespace {

Vec3 to_vec(const data::Vec3& v) { return {v.x_m, v.y_m, v.z_m}; }
data::Vec3 to_data(const Vec3& v) { return {.x_m = v.x(), .y_m = v.y(), .z_m = v.z()}; }

std::vector<Vec3> way_of(const data::ChargerPlan& plan, std::uint32_t first, std::uint32_t count) {
  std::vector<Vec3> out;
  for (std::uint32_t i = 0; i < count; ++i) out.push_back(to_vec(plan.bends.at(first + i)));
  return out;
}

data::ChargerActivity to_data(Activity activity) {
  switch (activity) {
    case Activity::kIdle:
      return data::ChargerActivity::kIdle;
    case Activity::kDriving:
      return data::ChargerActivity::kDriving;
    case Activity::kWaiting:
      return data::ChargerActivity::kWaiting;
    case Activity::kCharging:
      return data::ChargerActivity::kCharging;
    case Activity::kCarrying:
      return data::ChargerActivity::kCarrying;
    case Activity::kReady:
      return data::ChargerActivity::kReady;
    case Activity::kDelayed:
      return data::ChargerActivity::kDelayed;
    case Activity::kRefilling:
      return data::ChargerActivity::kRefilling;
  }
  return data::ChargerActivity::kIdle;
}

}  // namespace

Orders to_orders(const data::ChargerPlan& plan) {
  Orders orders;
  orders.revision = plan.revision;
  orders.speed_mps = plan.speed_mps;
  orders.charge_s_per_unit = plan.charge_s_per_unit;
  orders.taper_from = plan.taper_from;
  orders.taper_end_rate = plan.taper_end_rate;
  orders.landing_s = plan.landing_s;
  orders.take_off_s = plan.take_off_s;
  orders.start_m = to_vec(plan.start);
  if (plan.has_battery) {
    const data::RobotBattery& own = plan.battery;
    orders.battery = BatteryLimits{own.capacity, own.reserve, own.drive_per_s, own.per_charged, own.refill_s};
  }
  orders.home = {way_of(plan, plan.home_first_bend, plan.home_bend_count), plan.home_speed_mps};
  orders.meetings.reserve(plan.rendezvous.size());
  for (const data::Rendezvous& rendezvous : plan.rendezvous) {
    Meeting meeting;
    meeting.id = rendezvous.rendezvous_id;
    meeting.site_m = to_vec(rendezvous.site);
    meeting.charge_to = rendezvous.charge_to;
    meeting.arrive_by_s = rendezvous.arrive_by_s;
    if (rendezvous.carry) meeting.carry_to_m = to_vec(rendezvous.carry_to);
    meeting.way_m = way_of(plan, rendezvous.first_bend, rendezvous.bend_count);
    meeting.way_speed_mps = rendezvous.speed_mps;
    meeting.carry_way_m = way_of(plan, rendezvous.carry_first_bend, rendezvous.carry_bend_count);
    meeting.carry_speed_mps = rendezvous.carry_speed_mps;
    meeting.is_depot = rendezvous.kind == data::StopKind::kDepot;
    meeting.home = {way_of(plan, rendezvous.home_first_bend, rendezvous.home_bend_count),
                    rendezvous.home_speed_mps};
    meeting.uses = std::max(0.0, rendezvous.robot_energy - rendezvous.robot_energy_left);
    orders.meetings.push_back(meeting);
  }
  return orders;
}

VehicleView to_view(const data::VehicleState& state, std::uint32_t charger_id) {
  const bool on_ground = state.mode == data::VehicleMode::kLanded || state.mode == data::VehicleMode::kDocked;
  VehicleView view;
  view.position_m = to_vec(state.position);
  view.activity = on_ground ? VehicleActivity::kOnGround : VehicleActivity::kFlying;
  view.docked_here = state.mode == data::VehicleMode::kDocked && state.docked_charger_id == charger_id;
  view.legs_done = state.legs_done;
  return view;
}

BatteryView to_view(const data::BatteryState& state) {
  return {.time_s = state.time_s, .energy = state.energy, .capacity = state.capacity};
}

data::ChargerState to_data(const State& state, std::uint32_t charger_id, std::uint32_t vehicle_id) {
  data::ChargerState sample;
  sample.charger_id = charger_id;
  sample.time_s = state.time_s;
  sample.position = to_data(state.position_m);
  sample.speed_mps = state.speed_mps;
  sample.docked_vehicle_id = state.has_vehicle ? vehicle_id : 0;
  sample.charge_rate = state.charge_rate;
  sample.energy_delivered = state.energy_delivered;
  sample.activity = to_data(state.activity);
  sample.rendezvous_id = state.meeting_id;
  sample.rendezvous_done = state.meetings_done;
  sample.plan_revision = state.orders_revision;
  sample.energy = state.energy;
  return sample;
}

}  // namespace swallowtail::charger
