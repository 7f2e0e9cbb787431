#include "coverage/maintain/rest.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "coverage/schedule/expand.hpp"

namespace swallowtail::coverage {
namespace {

constexpr std::size_t kMostBegins = 16;

std::vector<Vec3> bends(const FlightModel& model, const Vec3& from, const Vec3& to) {
  const std::vector<Vec3> way = model.way(from, to);
  return {way.begin() + 1, way.end() - 1};
}

/// By the time it is flown the aircraft is somewhere on its way.
std::vector<Vec3> with_begin(std::vector<Vec3> way, const Vec3& begin_m) {
  if (!way.empty()) way.insert(way.begin(), begin_m);
  return way;
}

/// Aloft, all but the last of the fixed legs are flown one after the other: no landing between them reaches
/// the aircraft in time. The rest is scheduled from there.
std::optional<RestPlan> plan_behind_begun(const Rest& rest, const ScheduleStart& start,
                                          std::size_t first_index, const FlightModel& model,
                                          const RestParams& params) {
  const auto begun = static_cast<std::ptrdiff_t>(rest.fixed) - 1;
  ScheduleStart later = start;
  RestPlan out;
  out.approach_m = with_begin(bends(model, start.position_m, rest.legs.front().entry_m), start.position_m);
  for (auto at = rest.legs.begin(); at != rest.legs.begin() + begun; ++at) {
    Leg leg = *at;
    const Vec3 along = leg.exit_m - leg.entry_m;
    const FlightCost hop = model.transfer(later.position_m, leg.entry_m, {later.direction, along});
    const FlightCost cover = model.level(leg.entry_m, leg.exit_m);
    leg.start_s = later.time_s + hop.time_s;
    leg.energy_before = std::max(0.0, later.energy - hop.energy);
    later.time_s = leg.end_s = leg.start_s + cover.time_s;
    later.energy -= hop.energy + cover.energy;
    leg.energy_after = std::max(0.0, later.energy);
    leg.transfer = Transfer::kFF;
    later.position_m = leg.exit_m;
    if (along.norm() > 1e-3) later.direction = along;
    leg.transfer_m = bends(model, leg.exit_m, std::next(at)->entry_m);
    out.legs.push_back(leg);
  }
  const Rest behind{{rest.legs.begin() + begun, rest.legs.end()}, 1};
  auto found = plan_rest(behind, later, first_index + static_cast<std::size_t>(begun), model, params);
  if (!found) return std::nullopt;
  out.legs.insert(out.legs.end(), found->legs.begin(), found->legs.end());
  out.rendezvous = std::move(found->rendezvous);
  out.end_s = found->end_s;
  return out;
}

/// With which of the legs that are free to begin, one after the other until the rest can be flown; from the
/// air with the first only.
std::vector<std::size_t> begins(const Rest& rest, StartKind start) {
  const std::size_t free = rest.legs.size() - std::min(rest.fixed, rest.legs.size());
  const std::size_t most = start == StartKind::kAir ? 1 : kMostBegins;
  const std::size_t step = std::max<std::size_t>(1, (free + most - 1) / most);
  std::vector<std::size_t> out{0};
  for (std::size_t begin = step; begin < free && out.size() < most; begin += step) out.push_back(begin);
  return out;
}

}  // namespace

std::optional<RestPlan> plan_rest(const Rest& rest, const ScheduleStart& start, std::size_t first_index,
                                  const FlightModel& model, const RestParams& params) {
  if (rest.legs.empty()) return std::nullopt;
  if (start.kind == StartKind::kAir && rest.fixed > 1)
    return plan_behind_begun(rest, start, first_index, model, params);
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
  ImproveParams improve;
  improve.stops = params.stops;
  improve.stop = params.stop;
  improve.stop.max_evaluations = std::min(improve.stop.max_evaluations, params.schedules);
  improve.first_free = rest.fixed;
  std::optional<StopPlan> schedule;
  for (const std::size_t begin : begins(rest, start.kind)) {
    std::vector<Visit> turned = visits;
    const auto free = turned.begin() + static_cast<std::ptrdiff_t>(std::min(rest.fixed, turned.size()));
    std::rotate(free, free + static_cast<std::ptrdiff_t>(begin), turned.end());
    if (params.schedules > 0) turned = improve_order(cells, std::move(turned), start, links, improve).visits;
    std::vector<RouteLeg> route;
    for (const Visit& visit : turned) route.push_back(route_leg(cells[visit.sub_cell], visit));
    schedule = stops.plan(route, start);
    if (schedule) {
      visits = std::move(turned);
      break;
    }
  }
  if (!schedule) return std::nullopt;
  Expansion expansion = expand(cells, visits, start, *schedule, links, first_index);
  RestPlan out;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    expansion.legs[i].sub_cell_id = rest.legs[visits[i].sub_cell].sub_cell_id;
    expansion.legs[i].kind = rest.legs[visits[i].sub_cell].kind;
  }
  out.legs = std::move(expansion.legs);
  out.approach_m = std::move(expansion.approach_m);
  if (start.kind == StartKind::kAir) out.approach_m = with_begin(std::move(out.approach_m), start.position_m);
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
