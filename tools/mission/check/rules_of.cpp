#include "tools/mission/check/rules_of.hpp"

#include <variant>

#include "coverage/task/fields_of.hpp"
#include "coverage/task/ground_of.hpp"
#include "planner/scenario/load.hpp"
#include "tools/mission/check/solids_of.hpp"

namespace swallowtail::check {
namespace {

/// The robot counts as on a road this near to it.
constexpr double kOnRoad_m = 2.0;
/// Off the road it may also drive straight from one place to another over at most off_road_max_m, both within
/// that of a road: half way it is farther from it.
constexpr double kStraightShare = 1.5;

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

Rings rings_of(const coverage::Polygon& polygon) {
  Rings rings{ring_of(polygon.outline)};
  for (const auto& hole : polygon.holes) rings.push_back(ring_of(hole));
  return rings;
}

Status add_robot_ground(const planner::Scenario& scenario, const std::optional<planner::GeoOrigin>& origin,
                        Rules& rules) {
  const planner::ChargerSpec& charger = scenario.coverage->charger;
  const auto ground = coverage::read_robot_ground(charger, origin);
  if (!ground) return ground.error();
  for (const auto& line : ground->roads) rules.roads.push_back(ring_of(line));
  for (const auto& area : ground->closed) rules.no_drive.push_back(rings_of(area));
  if (const auto* roads = std::get_if<planner::RoadSpec>(&charger.ground))
    rules.off_road_m = roads->off_road_speed_mps > 0.0 ? kStraightShare * roads->off_road_max_m : kOnRoad_m;
  return {};
}

RobotBattery robot_battery_of(const planner::Scenario& scenario) {
  const planner::ChargerSpec& charger = scenario.coverage->charger;
  const planner::RobotBatterySpec& own = *charger.battery;
  RobotBattery out{own.capacity,
                   own.reserve,
                   own.drive_per_s,
                   own.per_charged,
                   {charger.start_m.x(), charger.start_m.y()},
                   {}};
  for (const auto& event : scenario.events)
    if (const auto* loss = std::get_if<planner::ChargerLoss>(&event.what))
      out.losses.push_back({event.at_s, loss->energy});
  return out;
}

Status add_coverage(const planner::Scenario& scenario, Rules& rules) {
  const auto fields = coverage::fields_of(scenario);
  if (!fields) return fields.error();
  for (const auto& field : fields->fields) {
    rules.fields.push_back({field.name.empty() ? std::to_string(field.id) : field.name, field.height_m,
                            rings_of(field.polygon)});
  }
  const auto& coverage = *scenario.coverage;
  rules.has_coverage = true;
  rules.sensor_width_m = coverage.sensor_width_m;
  rules.height_tolerance_m = coverage.height_tolerance_m;
  rules.battery_capacity = coverage.battery.capacity;
  rules.battery_reserve = coverage.battery.reserve;
  for (const auto& event : scenario.events)
    if (const auto* other = std::get_if<planner::AircraftReplaced>(&event.what))
      rules.replacements.push_back(
          {event.at_s, other->energy.value_or(other->capacity.value_or(coverage.battery.capacity))});
  rules.charger_speed_mps = coverage.charger.speed_mps;
  if (coverage.charger.battery) rules.robot_battery = robot_battery_of(scenario);
  for (const auto& area : fields->no_fly) rules.no_fly.push_back(rings_of(area));
  if (coverage.headland == planner::HeadlandUse::kSkip) rules.skipped_border_m = coverage.headland_m;
  return add_robot_ground(scenario, fields->origin, rules);
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
