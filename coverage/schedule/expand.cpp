#include "coverage/schedule/expand.hpp"

#include <algorithm>

namespace swallowtail::coverage {
namespace {

/// Walks along one sortie and dates its legs.
void date_legs(const Sortie& sortie, std::span<const RouteLeg> route, const ScheduleStart& start,
               LinkCache& links, std::span<Leg> legs) {
  if (sortie.leg_count == 0) return;
  const FlightModel& model = links.model();
  const FlownLeg& first = route[sortie.first_leg].flown;
  const auto along = first.direction().norm() > 1e-3 ? std::optional<Vec3>(first.direction()) : std::nullopt;
  FlightCost so_far;
  if (sortie.from.kind == Site::Kind::kEntry) {
    so_far = model.take_off(first.entry_m);
  } else if (sortie.from.kind == Site::Kind::kExit) {
    const RouteLeg& before = route[sortie.first_leg - 1];
    so_far = links.get(before.id, before.flown, route[sortie.first_leg].id, first).lift_from_exit;
  } else if (start.kind == StartKind::kAir) {
    so_far = model.transfer(start.position_m, first.entry_m, {start.direction, along});
  } else {
    const bool above = (start.position_m - first.entry_m).head<2>().norm() < 1e-3;
    so_far =
        above ? model.take_off(first.entry_m) : model.take_off_to(start.position_m, first.entry_m, along);
  }
  for (std::size_t i = sortie.first_leg; i < sortie.first_leg + sortie.leg_count; ++i) {
    if (i > sortie.first_leg)
      so_far += links.get(route[i - 1].id, route[i - 1].flown, route[i].id, route[i].flown).hop;
    legs[i].start_s = sortie.take_off_s + so_far.time_s;
    legs[i].energy_before = sortie.energy_at_take_off - so_far.energy;
    so_far += model.level(route[i].flown.entry_m, route[i].flown.exit_m);
    legs[i].end_s = sortie.take_off_s + so_far.time_s;
    legs[i].energy_after = sortie.energy_at_take_off - so_far.energy;
  }
}

Vec3 place(const Site& site, std::span<const RouteLeg> route, const FlightModel& model) {
  const FlownLeg& leg = route[site.leg].flown;
  return model.ground(site.kind == Site::Kind::kExit ? leg.exit_m : leg.entry_m);
}

/// Of the robot's way.
std::vector<Vec3> bends(const LinkCache& links, const Vec3& from, const Vec3& to) {
  std::vector<Vec3> out;
  if (!links.charger().travel) return out;
  for (const Vec2& p : links.charger().travel->bends(from.head<2>(), to.head<2>()))
    out.push_back(links.model().ground(Vec3(p.x(), p.y(), 0.0)));
  return out;
}

std::vector<Vec3> bends(const FlightModel& model, const Vec3& from, const Vec3& to) {
  const std::vector<Vec3> way = model.way(from, to);
  return {way.begin() + 1, way.end() - 1};
}

}  // namespace

Expansion expand(std::span<const SubCell> sub_cells, std::span<const Visit> visits,
                 const ScheduleStart& start, const StopPlan& stops, LinkCache& links,
                 std::size_t first_index) {
  Expansion out;
  std::vector<RouteLeg> route;
  for (const Visit& visit : visits) {
    const SubCell& cell = sub_cells[visit.sub_cell];
    route.push_back(route_leg(cell, visit));
    Leg leg;
    leg.sub_cell_id = cell.id;
    leg.field_id = cell.field_id;
    leg.kind = cell.length_m() < 1e-9 ? LegKind::kReposition : LegKind::kCover;
    leg.entry_m = route.back().flown.entry_m;
    leg.exit_m = route.back().flown.exit_m;
    leg.height_m = cell.height_m;
    leg.width_m = cell.width_m;
    leg.transfer = Transfer::kFF;
    out.legs.push_back(leg);
  }
  for (const Sortie& sortie : stops.sorties) date_legs(sortie, route, start, links, out.legs);
  Vec3 robot_m = start.kind == StartKind::kDocked ? start.position_m : start.robot_m;
  for (std::size_t k = 0; k < stops.recharges.size(); ++k) {
    const Recharge& recharge = stops.recharges[k];
    const Sortie& next = stops.sorties[k + 1];
    const bool at_exit = recharge.at.kind == Site::Kind::kExit;
    const std::size_t leg = at_exit ? recharge.at.leg : recharge.at.leg - 1;
    Transfer& transfer = out.legs[leg].transfer;
    if (recharge.carried_to) {
      transfer = Transfer::kFDTU;
    } else if (at_exit) {
      transfer = next.leg_count == 0 ? Transfer::kFDUFDU : Transfer::kFDUF;
    } else if (transfer != Transfer::kFDUFDU) {
      transfer = Transfer::kFFDU;
    }
    Rendezvous meeting;
    meeting.id = at_exit ? exit_id(first_index + leg) : entry_id(first_index + leg + 1);
    meeting.site_m = place(recharge.at, route, links.model());
    meeting.robot_arrives_s = recharge.robot_arrives_s;
    meeting.land_s = stops.sorties[k].land_s;
    meeting.arrive_by_s = meeting.land_s;
    meeting.depart_s = next.take_off_s;
    meeting.energy_from = recharge.energy_from;
    meeting.charge_to = recharge.energy_to;
    meeting.wait_s = recharge.wait_s;
    meeting.carry = recharge.carried_to.has_value();
    meeting.carry_to_m =
        recharge.carried_to ? place(*recharge.carried_to, route, links.model()) : meeting.site_m;
    meeting.robot_bends_m = bends(links, robot_m, meeting.site_m);
    meeting.carry_bends_m = bends(links, meeting.site_m, meeting.carry_to_m);
    robot_m = meeting.carry_to_m;
    out.rendezvous.push_back(meeting);
  }
  if (!out.legs.empty()) out.legs.back().transfer = Transfer::kEnd;
  for (std::size_t i = 0; i + 1 < out.legs.size(); ++i) {
    const Transfer transfer = out.legs[i].transfer;
    if (transfer == Transfer::kFDTU) continue;
    const Vec3& to = out.legs[i + 1].entry_m;
    Vec3 from = out.legs[i].exit_m;
    if (transfer == Transfer::kFDUF || transfer == Transfer::kFDUFDU) from.z() = to.z();
    out.legs[i].transfer_m = bends(links.model(), from, to);
  }
  if (!out.legs.empty()) {
    const Vec3& to = out.legs.front().entry_m;
    Vec3 from = start.position_m;
    if (start.kind != StartKind::kAir) from.z() = to.z();
    out.approach_m = bends(links.model(), from, to);
  }
  return out;
}

void add_totals(const StopPlan& stops, const ScheduleStart& start, Plan& plan) {
  plan.energy_min = start.energy;
  for (const Sortie& sortie : stops.sorties) {
    plan.flight_m += sortie.flight.length_m;
    plan.flight_s += sortie.flight.time_s;
    plan.energy_used += sortie.flight.energy;
    plan.energy_min = std::min(plan.energy_min, sortie.energy_on_landing);
  }
  for (const Recharge& recharge : stops.recharges) {
    plan.wait_s += recharge.wait_s;
    plan.energy_min = std::min(plan.energy_min, recharge.energy_from);
    if (recharge.energy_to > recharge.energy_from + 1e-9) ++plan.recharges;
  }
  plan.makespan_s = stops.end_s - start.time_s;
  plan.cost = plan.makespan_s;
}

}  // namespace swallowtail::coverage
