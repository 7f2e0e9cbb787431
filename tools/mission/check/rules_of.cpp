#include "tools/mission/check/rules_of.hpp"

#include "coverage/task/fields_of.hpp"
#include "planner/scenario/load.hpp"
#include "tools/mission/check/solids_of.hpp"

namespace swallowtail::check {
namespace {

P3 point(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Ground ground_of(const planner::Terrain& terrain) {
  const auto* grid = terrain.grid();
  if (grid == nullptr) return {.z_m = {static_cast<float>(terrain.flat_elevation_m())}};
  return {grid->origin_m.x(),
          grid->origin_m.y(),
          grid->cell_size_m,
          static_cast<std::size_t>(grid->rows),
          static_cast<std::size_t>(grid->cols),
          grid->elevation_m};
}

data::VehicleLimits limits_of(const planner::VehicleLimits& limits) {
  return {limits.radius_m,          limits.margin_m,     limits.cruise_speed_mps, limits.climb_speed_mps,
          limits.descent_speed_mps, limits.turn_max_rad, limits.climb_max_rad};
}

std::vector<P2> ring_of(const coverage::Ring& vertices) {
  std::vector<P2> ring;
  for (const auto& v : vertices) ring.push_back({v.x(), v.y()});
  return ring;
}

Status add_coverage(const planner::Scenario& scenario, Rules& rules) {
  const auto fields = coverage::fields_of(scenario);
  if (!fields) return fields.error();
  for (const auto& field : fields->fields) {
    FieldArea area{field.name.empty() ? std::to_string(field.id) : field.name,
                   field.height_m,
                   {ring_of(field.polygon.outline)}};
    for (const auto& hole : field.polygon.holes) area.rings.push_back(ring_of(hole));
    rules.fields.push_back(std::move(area));
  }
  const auto& coverage = *scenario.coverage;
  rules.has_coverage = true;
  rules.sensor_width_m = coverage.sensor_width_m;
  rules.height_tolerance_m = coverage.height_tolerance_m;
  rules.battery_capacity = coverage.battery.capacity;
  rules.battery_reserve = coverage.battery.reserve;
  rules.charger_speed_mps = coverage.charger.speed_mps;
  return {};
}

}  // namespace

Result<Rules> rules_of(const planner::Scenario& scenario) {
  const auto terrain = planner::load_terrain(scenario);
  if (!terrain) return terrain.error();
  Rules rules;
  rules.vehicle = limits_of(scenario.vehicle.limits);
  rules.bounds_min = point(scenario.bounds.min_m);
  rules.bounds_max = point(scenario.bounds.max_m);
  rules.solids = solids_of(scenario);
  rules.ground = ground_of(*terrain);
  if (scenario.coverage) {
    if (auto status = add_coverage(scenario, rules); !status) return status.error();
  }
  return rules;
}

}  // namespace swallowtail::check
