#include "coverage/schedule/plan.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "coverage/field/places.hpp"
#include "coverage/schedule/expand.hpp"
#include "coverage/schedule/order.hpp"
#include "coverage/schedule/robot_trips.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

/// Two stops and a turn at cruise speed: what one more piece costs in metres.
constexpr double kPieceStops = 2.0;
/// Share of the longest flight that a sub-cell may be: the rest is for getting there.
constexpr double kLengthShare = 0.95;

double piece_cost_m(const Task& task) {
  return task.sensor_width_m + kPieceStops * planner::kStopToTurn_s * task.vehicle.cruise_speed_mps;
}

/// What one battery flies straight at a height over ground of an elevation, whatever the direction, its own
/// take-off and landing left aside; not positive: it does not even lift.
double longest_leg_m(const Task& task, double height_m, double ground_m, const StopParams& stops) {
  const EnergyModel& energy = task.battery.model;
  const planner::Terrain ground = planner::Terrain::flat(ground_m);
  const FlightModel model(task.vehicle, energy, ground);
  const Vec3 above(0.0, 0.0, ground_m + height_m);
  const double left = (task.battery.capacity - task.battery.reserve - stops.spare) / stops.energy_factor -
                      model.take_off(above).energy - model.landing(above).energy;
  const double power = greatest_level_power(energy, task.vehicle.cruise_speed_mps) *
                       altitude_factor(energy, ground_m + height_m);
  return kLengthShare * left / power * task.vehicle.cruise_speed_mps;
}

double highest_ground_m(const Field& field, const planner::Terrain& terrain) {
  const Box box = bounds_of(field.polygon.outline);
  return terrain.max_in(box.lo, box.hi);
}

FieldReport report_of(const FieldCut& cut, double wall_ms) {
  FieldReport out;
  out.id = cut.id;
  out.name = cut.name;
  out.status = cut.status;
  out.reason = cut.reason;
  out.area_m2 = cut.area_m2;
  out.covered_m2 = cut.covered_m2;
  out.outside_m2 = cut.outside_m2;
  out.sweep_rad = cut.sweep_rad;
  out.strips = cut.strips;
  out.cells = cut.cells;
  out.sub_cells = static_cast<int>(cut.sub_cells.size());
  out.beyond_tolerance = cut.beyond_tolerance;
  out.wall_ms = wall_ms;
  return out;
}

/// Valid ones: a field that meets another refuses it by name.
std::vector<Polygon> no_fly_areas(const Task& task) {
  std::vector<Polygon> out;
  for (const Polygon& area : task.no_fly) {
    const Result<std::vector<Polygon>> parts = clean(area);
    if (parts) out.insert(out.end(), parts->begin(), parts->end());
  }
  return out;
}

/// Whether the clean field has all its holes still: none sticks out and became its outline's.
bool has_all_holes(const Field& field, const std::vector<Polygon>& parts) {
  return parts.size() == 1 && parts.front().holes.size() == field.polygon.holes.size();
}

/// Of a clean field, as holes of polygons, those that it lost too.
std::vector<Polygon> with_holes(const Field& field, const std::vector<Polygon>& parts) {
  if (has_all_holes(field, parts)) return parts;
  Polygon out;
  for (const Ring& ring : field.polygon.holes) {
    const Result<std::vector<Polygon>> hole = clean({ring, {}});
    if (!hole) continue;
    for (const Polygon& part : *hole) out.holes.emplace_back(part.outline.rbegin(), part.outline.rend());
  }
  return {out};
}

void add_field_totals(Plan& plan) {
  double covered = 0.0;
  for (const FieldReport& field : plan.fields) {
    if (field.status != FieldStatus::kPlanned) plan.status = PlanStatus::kPartial;
    if (field.status == FieldStatus::kRefused) continue;
    plan.area_m2 += field.area_m2;
    covered += field.covered_m2;
  }
  plan.covered_percent = plan.area_m2 > 0.0 ? 100.0 * covered / plan.area_m2 : 0.0;
}

}  // namespace

Status validate(const Task& task) {
  if (task.fields.empty()) return bad_input("The task has no field.");
  if (!is_positive(task.sensor_width_m))
    return bad_input("The sensor width must be a positive number of metres.");
  if (!is_non_negative(task.height_tolerance_m) || !is_non_negative(task.height_band_m)) {
    return bad_input("Height tolerance and height band must not be negative.");
  }
  if (task.neighbours < 1) return bad_input("There must be at least one neighbour in the graph.");
  if (!is_finite(task.start_m)) return bad_input("The start must be finite.");
  const Vec2 start_m = task.start_m.head<2>();
  if (const auto barred = barred_at(task.fields, task.no_fly, start_m))
    return bad_input("The aircraft's start " + place_text(start_m) + " lies within " + *barred + ".");
  if (task.sweep_rad && !is_finite(*task.sweep_rad)) return bad_input("The sweep direction must be finite.");
  if (const Status status = validate(task.rules); !status) return status;
  if (const Status status = validate(task.battery); !status) return status;
  if (const Status status = validate(task.charger); !status) return status;
  if (const Status status = planner::validate(task.vehicle); !status) return status;
  return validate(task.battery.model, task.vehicle);
}

StopParams stop_params(const Task& task, const PlanOptions& options) {
  StopParams out;
  out.battery = task.battery;
  out.charger = task.charger;
  out.energy_factor = 1.0 + options.energy_margin;
  out.spare = options.energy_spare * task.battery.capacity;
  out.lead_s = options.lead_s;
  return out;
}

Ways ways_of(const Task& task, std::span<const Polygon> polygons) {
  std::vector<Polygon> barred = no_fly_areas(task);
  std::vector<Polygon> around;
  // A hole that a no-fly area or its field's outline joins to the ground around is no polygon's any more.
  for (const Field& field : task.fields) {
    if (field.polygon.holes.empty()) continue;
    const auto parts = clean(field.polygon);
    if (!parts) continue;
    const auto is_among = [&](const Polygon& polygon) { return polygon.outline == parts->front().outline; };
    if (has_all_holes(field, *parts) && std::ranges::any_of(polygons, is_among)) continue;
    const std::vector<Polygon> holed = with_holes(field, *parts);
    std::ranges::move(holes_without_fields(holed, polygons), std::back_inserter(barred));
    std::ranges::move(holes_around_fields(holed, polygons), std::back_inserter(around));
  }
  return Ways(polygons, barred, around);
}

FieldsCut cut_fields(const Task& task, const planner::Terrain& terrain, const PlanOptions& options) {
  FieldsCut out;
  const StopParams stops = stop_params(task, options);
  for (const Field& field : task.fields) {
    const double began = options.clock != nullptr ? options.clock->now_s() : 0.0;
    CutParams params;
    params.sensor_width_m = task.sensor_width_m;
    params.sweep_rad = task.sweep_rad;
    params.piece_cost_m = piece_cost_m(task);
    params.turn = {planner::kStopToTurn_s * task.vehicle.cruise_speed_mps, task.vehicle.turn_max_rad};
    params.height_tolerance_m = task.height_tolerance_m;
    params.clearance_m = task.vehicle.clearance_m();
    params.rules = task.rules;
    params.no_fly = task.no_fly;
    // Over terrain a sub-cell's ends stand higher above ground than asked by the tolerance at most.
    params.max_length_m = longest_leg_m(task, field.height_m + 2.0 * task.height_tolerance_m,
                                        highest_ground_m(field, terrain), stops);
    FieldCut cut = cut_field(field, terrain, params);
    if (cut.status != FieldStatus::kRefused && out.sub_cells.size() + cut.sub_cells.size() > kMaxSubCells) {
      cut.status = FieldStatus::kRefused;
      cut.reason = "Field '" + cut.name + "': the task's fields together need more than " +
                   std::to_string(kMaxSubCells) + " sub-cells.";
      cut.sub_cells.clear();
    }
    const double wall_ms = options.clock != nullptr ? (options.clock->now_s() - began) * 1e3 : 0.0;
    out.reports.push_back(report_of(cut, wall_ms));
    if (cut.status != FieldStatus::kRefused)
      out.polygons.insert(out.polygons.end(), cut.polygons.begin(), cut.polygons.end());
    for (SubCell cell : cut.sub_cells) {
      cell.id = static_cast<std::uint32_t>(out.sub_cells.size());
      out.sub_cells.push_back(cell);
    }
  }
  return out;
}

Result<Plan> plan_coverage(const Task& task, const planner::Terrain& terrain, const PlanOptions& options) {
  const double began = options.clock != nullptr ? options.clock->now_s() : 0.0;
  if (const Status status = validate(task); !status) return status.error();
  if (!is_within(options.energy_margin, 0.0, 1.0) || !is_within(options.energy_spare, 0.0, 0.5) ||
      !is_non_negative(options.lead_s)) {
    return bad_input("The energy margin must be 0 to 1, the spare 0 to 0.5 and the lead not negative.");
  }
  FieldsCut cut = cut_fields(task, terrain, options);
  Plan plan;
  plan.fields = std::move(cut.reports);
  plan.sub_cells = std::move(cut.sub_cells);
  add_field_totals(plan);
  if (plan.sub_cells.empty()) {
    return infeasible("No field can be planned. " + plan.fields.front().reason);
  }
  if (const auto barred = barred_at(task.fields, task.no_fly, task.charger.start_m.head<2>())) {
    plan.notes.push_back("The charger's start " + place_text(task.charger.start_m.head<2>()) +
                         " lies within " + *barred + ": only the aircraft keeps out of it.");
  }
  plan.polygons = std::move(cut.polygons);
  const Ways ways = ways_of(task, plan.polygons);
  const FlightModel model(task.vehicle, task.battery.model, terrain, &ways);
  LinkCache links(model, task.charger);
  ScheduleStart start;
  start.position_m = model.ground(task.start_m);
  start.energy = task.battery.capacity;
  start.robot_m = task.charger.start_m;
  Result<Order> order = find_order(plan.sub_cells, start, task, options, links);
  if (!order) return order.error();
  StopPlanner stops(links, stop_params(task, options));
  std::vector<RouteLeg> route;
  for (const Visit& visit : order->visits) route.push_back(route_leg(plan.sub_cells[visit.sub_cell], visit));
  const std::optional<StopPlan> schedule = stops.plan(route, start);
  if (!schedule) return internal_error("The order found cannot be scheduled.");
  Expansion expansion = expand(plan.sub_cells, order->visits, start, *schedule, links, 0);
  plan.approach_m = std::move(expansion.approach_m);
  plan.legs = std::move(expansion.legs);
  plan.rendezvous = std::move(expansion.rendezvous);
  add_totals(*schedule, start, plan);
  if (const Status status = limit_robot(task, model, plan); !status) return status.error();
  plan.statistics = order->statistics;
  if (options.clock != nullptr) plan.statistics.wall_s = options.clock->now_s() - began;
  return plan;
}

}  // namespace swallowtail::coverage
