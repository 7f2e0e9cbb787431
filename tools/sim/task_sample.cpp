#include "tools/sim/task_sample.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "coverage/task/energy_of.hpp"
#include "coverage/task/fields_of.hpp"
#include "coverage/task/ground_of.hpp"
#include "tools/sim/convert.hpp"

namespace swallowtail::sim {
namespace {

std::uint32_t count_of(std::size_t size) { return static_cast<std::uint32_t>(size); }

void add_points(data::CoverageTask& task, const std::vector<Vec2>& points) {
  for (const Vec2& p : points) task.points.push_back({.x_m = p.x(), .y_m = p.y()});
}

void add_area(data::CoverageTask& task, data::AreaKind kind, std::uint32_t index,
              const coverage::Polygon& area) {
  const auto add_ring = [&](const coverage::Ring& ring, bool is_hole) {
    task.rings.push_back({.area_index = index,
                          .first_point = count_of(task.points.size()),
                          .point_count = count_of(ring.size()),
                          .is_hole = is_hole,
                          .kind = kind});
    add_points(task, ring);
  };
  add_ring(area.outline, false);
  for (const coverage::Ring& hole : area.holes) add_ring(hole, true);
}

Status add_fields(std::vector<coverage::Field> wanted, TaskSample& out) {
  for (coverage::Field& field : wanted) {
    auto parts = coverage::clean(field.polygon);
    if (!parts) {
      out.refused.push_back("field " + field.name + ": " + parts.error().message);
      continue;
    }
    for (coverage::Polygon& part : *parts) {
      add_area(out.task, data::AreaKind::kField, count_of(out.task.fields.size()), part);
      out.task.fields.push_back({.field_id = field.id, .height_m = field.height_m});
      out.fields.push_back({field.id, field.name, std::move(part), field.height_m});
    }
  }
  if (!out.task.fields.empty()) return {};
  return bad_input("None of the scenario's fields can be flown; the first: " +
                   (out.refused.empty() ? std::string("there is none") : out.refused.front()) + ".");
}

/// In what was cleaned, so that every participant finds valid polygons.
Status add_no_fly(const std::vector<coverage::Polygon>& areas, TaskSample& out) {
  for (std::size_t i = 0; i < areas.size(); ++i) {
    auto parts = coverage::clean(areas[i]);
    if (!parts) return bad_input("No-fly area " + std::to_string(i) + ": " + parts.error().message);
    for (coverage::Polygon& part : *parts) {
      add_area(out.task, data::AreaKind::kNoFly, count_of(out.no_fly.size()), part);
      out.no_fly.push_back(std::move(part));
    }
  }
  return {};
}

data::FieldRules rules_of(const planner::CoverageSpec& spec) {
  data::FieldRules out;
  out.overlap = spec.overlap;
  out.has_sweep = spec.sweep_rad.has_value();
  out.sweep_rad = spec.sweep_rad.value_or(0.0);
  if (spec.headland == planner::HeadlandUse::kSkip) out.headland = data::HeadlandUse::kSkip;
  if (spec.headland == planner::HeadlandUse::kFly) out.headland = data::HeadlandUse::kFly;
  out.headland_m = spec.headland_m;
  out.lines_beyond_borders = spec.lines_beyond_borders;
  out.has_ceiling = spec.ceiling_m.has_value();
  out.ceiling_m = spec.ceiling_m.value_or(0.0);
  return out;
}

data::EnergyModel model_of(const planner::Scenario& scenario) {
  const coverage::EnergyModel model = coverage::energy_model_of(scenario);
  data::EnergyModel out{.level_per_s = model.level_per_s,
                        .climb_per_s = model.climb_per_s,
                        .descent_per_s = model.descent_per_s,
                        .hover_per_s = model.hover_per_s,
                        .landed_per_s = model.landed_per_s,
                        .altitude_per_m = model.altitude_per_m,
                        .altitude_from_m = model.altitude_from_m,
                        .multirotor = {},
                        .unit_j = model.unit_j,
                        .wind_east_mps = model.wind_mps.x(),
                        .wind_north_mps = model.wind_mps.y()};
  if (!model.multirotor) return out;
  const coverage::Multirotor& craft = *model.multirotor;
  out.is_multirotor = true;
  out.multirotor = {.mass_kg = craft.mass_kg,
                    .payload_kg = craft.payload_kg,
                    .rotors = static_cast<std::uint32_t>(craft.rotors),
                    .rotor_radius_m = craft.rotor_radius_m,
                    .drag_area_m2 = craft.drag_area_m2,
                    .solidity = craft.solidity,
                    .blade_drag = craft.blade_drag,
                    .tip_speed_mps = craft.tip_speed_mps,
                    .induced_factor = craft.induced_factor,
                    .efficiency = craft.efficiency,
                    .avionics_w = craft.avionics_w,
                    .air_density_kgpm3 = craft.air_density_kgpm3,
                    .air_speed_max_mps = craft.air_speed_max_mps};
  return out;
}

Status add_ground(const planner::Scenario& scenario, const std::optional<planner::GeoOrigin>& origin,
                  data::CoverageTask& task) {
  const planner::ChargerSpec& charger = scenario.coverage->charger;
  const auto read = coverage::read_robot_ground(charger, origin);
  if (!read) return read.error();
  data::GroundLimits& ground = task.charger.ground;
  const planner::Bounds& bounds = scenario.bounds;
  ground.area_min = {.x_m = bounds.min_m.x(), .y_m = bounds.min_m.y()};
  ground.area_max = {.x_m = bounds.max_m.x(), .y_m = bounds.max_m.y()};
  if (const auto* roads = std::get_if<planner::RoadSpec>(&charger.ground)) {
    ground.kind = data::GroundKind::kRoads;
    ground.off_road_speed_mps = roads->off_road_speed_mps;
    ground.off_road_max_m = roads->off_road_max_m;
  }
  if (const auto* rough = std::get_if<planner::RoughGroundSpec>(&charger.ground)) {
    ground.kind = data::GroundKind::kRough;
    ground.slope_max_rad = rough->slope_max_rad;
    ground.cell_m = rough->cell_m;
  }
  for (const std::vector<Vec2>& line : read->roads) {
    task.roads.push_back({.first_point = count_of(task.points.size()), .point_count = count_of(line.size())});
    add_points(task, line);
  }
  for (std::size_t i = 0; i < read->closed.size(); ++i)
    add_area(task, data::AreaKind::kNoDrive, count_of(i), read->closed[i]);
  return {};
}

void fill_limits(const planner::Scenario& scenario, const planner::Terrain& terrain,
                 data::CoverageTask& task) {
  const planner::CoverageSpec& spec = *scenario.coverage;
  task.task_id = kTaskId;
  task.vehicle_id = scenario.vehicle.id;
  task.sensor_width_m = spec.sensor_width_m;
  task.rules = rules_of(spec);
  task.height_tolerance_m = spec.height_tolerance_m;
  task.height_band_m = spec.height_band_m;
  task.neighbours = static_cast<std::uint32_t>(spec.neighbours);
  task.vehicle = to_data(scenario.vehicle.limits);
  task.battery = {.capacity = spec.battery.capacity,
                  .reserve = spec.battery.reserve,
                  .levels = static_cast<std::uint32_t>(spec.battery.levels),
                  .charge_s_per_unit = spec.battery.charge_s_per_unit,
                  .taper_from = spec.battery.taper_from,
                  .taper_end_rate = spec.battery.taper_end_rate,
                  .model = model_of(scenario)};
  const Vec2& site = spec.charger.start_m;
  task.charger = {.charger_id = spec.charger.id,
                  .speed_mps = spec.charger.speed_mps,
                  .take_off_s = spec.charger.take_off_s,
                  .landing_s = spec.charger.landing_s,
                  .start = {.x_m = site.x(), .y_m = site.y(), .z_m = terrain.height_at(site.x(), site.y())},
                  .ground = {},
                  .battery = {}};
  if (const auto& own = spec.charger.battery) {
    task.charger.has_battery = true;
    task.charger.battery = {own->capacity, own->reserve, own->drive_per_s, own->per_charged, own->refill_s};
  }
}

Status check_bounds(const data::CoverageTask& task) {
  std::uint32_t areas = 0;
  for (const data::Ring& ring : task.rings) {
    if (ring.kind != data::AreaKind::kField) areas = std::max(areas, ring.area_index + 1);
  }
  const auto check = [](std::size_t count, std::size_t bound, const char* what) -> Status {
    if (count <= bound) return {};
    return bad_input("A coverage task holds at most " + std::to_string(bound) + " " + what +
                     "; the scenario has " + std::to_string(count) +
                     ". Choose some with coverage.field_ids, or simplify them.");
  };
  if (Status s = check(task.fields.size(), data::kMaxFields, "fields"); !s) return s;
  if (Status s = check(areas, data::kMaxAreas, "no-fly areas, and as many closed to the robot"); !s) return s;
  if (Status s = check(task.rings.size(), data::kMaxRings, "rings"); !s) return s;
  if (Status s = check(task.roads.size(), data::kMaxRoads, "roads"); !s) return s;
  return check(task.points.size(), data::kMaxTaskPoints, "points");
}

}  // namespace

Result<TaskSample> task_sample(const planner::Scenario& scenario, const planner::Terrain& terrain) {
  auto wanted = coverage::fields_of(scenario);
  if (!wanted) return wanted.error();
  TaskSample out;
  out.origin = wanted->origin;
  fill_limits(scenario, terrain, out.task);
  if (Status added = add_fields(std::move(wanted->fields), out); !added) return added.error();
  if (Status added = add_no_fly(wanted->no_fly, out); !added) return added.error();
  if (Status added = add_ground(scenario, out.origin, out.task); !added) return added.error();
  if (Status fits = check_bounds(out.task); !fits) return fits.error();
  return out;
}

}  // namespace swallowtail::sim
