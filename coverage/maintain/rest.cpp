#include "coverage/maintain/rest.hpp"

#include <cmath>
#include <limits>

#include "coverage/schedule/expand.hpp"

namespace swallowtail::coverage {

std::optional<RestPlan> plan_rest(const Rest& rest, const ScheduleStart& start, std::size_t first_index,
                                  const FlightModel& model, const RestParams& params) {
  if (rest.legs.empty()) return std::nullopt;
  std::vector<SubCell> cells;
  std::vector<Visit> visits;
  for (std::size_t i = 0; i < rest.legs.size(); ++i) {
    const Leg& leg = rest.legs[i];
    // The cache's id must be unique here, whatever the sub-cells are called.
    cells.push_back(
        {static_cast<std::uint32_t>(i), leg.field_id, leg.entry_m, leg.exit_m, leg.height_m, leg.width_m});
    visits.push_back({i, false});
  }
  LinkCache links(model, params.stops.charger);
  StopPlanner stops(links, params.stops);
  if (params.schedules > 0) {
    ImproveParams improve;
    improve.stops = params.stops;
    improve.stop = params.stop;
    improve.stop.max_evaluations = std::min(improve.stop.max_evaluations, params.schedules);
    improve.first_free = rest.fixed;
    visits = improve_order(cells, std::move(visits), start, links, improve).visits;
  }
  std::vector<RouteLeg> route;
  for (const Visit& visit : visits) route.push_back(route_leg(cells[visit.sub_cell], visit));
  const std::optional<StopPlan> schedule = stops.plan(route, start);
  if (!schedule) return std::nullopt;
  Expansion expansion = expand(cells, visits, start, *schedule, links, first_index);
  RestPlan out;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    expansion.legs[i].sub_cell_id = rest.legs[visits[i].sub_cell].sub_cell_id;
    expansion.legs[i].kind = rest.legs[visits[i].sub_cell].kind;
  }
  out.legs = std::move(expansion.legs);
  out.approach_m = std::move(expansion.approach_m);
  // By the time it is flown the aircraft is somewhere on its way.
  if (start.kind == StartKind::kAir && !out.approach_m.empty())
    out.approach_m.insert(out.approach_m.begin(), start.position_m);
  out.rendezvous = std::move(expansion.rendezvous);
  out.first = schedule->first;
  out.end_s = schedule->end_s;
  return out;
}

std::string why_no_rest(std::span<const Leg> legs, const FlightModel& model, const StopParams& stops) {
  const Battery& battery = stops.battery;
  const double room = battery.capacity - battery.reserve - stops.spare;
  for (const Leg& leg : legs) {
    const FlightCost flight =
        model.take_off(leg.entry_m) + model.level(leg.entry_m, leg.exit_m) + model.landing(leg.exit_m);
    const double needs = flight.energy * stops.energy_factor;
    if (needs > room) {
      return "sub-cell " + std::to_string(leg.sub_cell_id) + " takes energy " +
             std::to_string(std::lround(std::ceil(needs))) + ", and the battery has " +
             std::to_string(std::lround(std::floor(room))) + " to use";
    }
  }
  for (const Leg& leg : legs) {
    if (!std::isfinite(drive_s(stops.charger, stops.charger.start_m, leg.exit_m)) &&
        !std::isfinite(drive_s(stops.charger, stops.charger.start_m, leg.entry_m)))
      return "the robot has no way to sub-cell " + std::to_string(leg.sub_cell_id);
  }
  return "the energy of a full battery does not reach from one place that the robot can get to to the next";
}

}  // namespace swallowtail::coverage
