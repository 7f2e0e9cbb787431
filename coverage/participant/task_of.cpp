#include "coverage/participant/task_of.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "coverage/field/widen.hpp"
#include "coverage/ground/road_network.hpp"
#include "coverage/ground/rough_ground.hpp"

namespace swallowtail::coverage {
namespace {

using Travel = std::shared_ptr<const GroundTravel>;

std::vector<Vec2> points_of(const data::CoverageTask& task, std::uint32_t first, std::uint32_t count) {
  std::vector<Vec2> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    const data::Point2& p = task.points.at(first + i);
    out.emplace_back(p.x_m, p.y_m);
  }
  return out;
}

std::vector<Polygon> areas_of(const data::CoverageTask& task, data::AreaKind kind) {
  std::vector<Polygon> out;
  for (const data::Ring& ring : task.rings) {
    if (ring.kind != kind) continue;
    if (ring.area_index >= out.size()) out.resize(ring.area_index + 1);
    Polygon& area = out[ring.area_index];
    Ring points = points_of(task, ring.first_point, ring.point_count);
    if (ring.is_hole) {
      area.holes.push_back(std::move(points));
    } else {
      area.outline = std::move(points);
    }
  }
  return out;
}

FieldRules rules_of(const data::FieldRules& in) {
  FieldRules out;
  out.overlap = in.overlap;
  if (in.headland == data::HeadlandUse::kSkip) out.headland = Headland::kSkip;
  if (in.headland == data::HeadlandUse::kFly) out.headland = Headland::kFly;
  out.headland_m = in.headland_m;
  if (in.lines_beyond_borders) out.beyond = Beyond::kSlantedBorders;
  if (in.has_ceiling) out.ceiling_m = in.ceiling_m;
  return out;
}

EnergyModel model_of(const data::EnergyModel& in) {
  EnergyModel out;
  out.level_per_s = in.level_per_s;
  out.climb_per_s = in.climb_per_s;
  out.descent_per_s = in.descent_per_s;
  out.hover_per_s = in.hover_per_s;
  out.landed_per_s = in.landed_per_s;
  out.altitude_per_m = in.altitude_per_m;
  out.altitude_from_m = in.altitude_from_m;
  if (!in.is_multirotor) return out;
  const data::Multirotor& craft = in.multirotor;
  out.multirotor = Multirotor{.mass_kg = craft.mass_kg,
                              .payload_kg = craft.payload_kg,
                              .rotors = static_cast<int>(craft.rotors),
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
  out.unit_j = in.unit_j;
  out.wind_mps = Vec2(in.wind_east_mps, in.wind_north_mps);
  return out;
}

Battery battery_of(const data::BatteryLimits& in) {
  Battery out;
  out.capacity = in.capacity;
  out.reserve = in.reserve;
  out.levels = static_cast<int>(std::min<std::uint32_t>(in.levels, 1000));
  out.charge_s_per_unit = in.charge_s_per_unit;
  out.taper_from = in.taper_from;
  out.taper_end_rate = in.taper_end_rate;
  out.model = model_of(in.model);
  return out;
}

Vec3 to_vec(const data::Vec3& v) { return {v.x_m, v.y_m, v.z_m}; }

Status check_fields(const std::vector<Field>& fields) {
  for (const Field& field : fields) {
    const Result<std::vector<Polygon>> parts = clean(field.polygon);
    if (!parts) return bad_input("Field " + std::to_string(field.id) + ": " + parts.error().message);
  }
  return {};
}

Result<Travel> along_roads(const data::CoverageTask& task) {
  RoadParams params;
  for (const data::Road& road : task.roads)
    params.lines.push_back(points_of(task, road.first_point, road.point_count));
  params.speed_mps = task.charger.speed_mps;
  params.off_road_speed_mps = task.charger.ground.off_road_speed_mps;
  params.off_road_max_m = task.charger.ground.off_road_max_m;
  const auto roads = RoadNetwork::make(params);
  if (!roads) return roads.error();
  return Travel(*roads);
}

Result<Travel> over_ground(const data::CoverageTask& task, const planner::Terrain& terrain) {
  const data::GroundLimits& limits = task.charger.ground;
  RoughGroundParams params;
  params.lo_m = Vec2(limits.area_min.x_m, limits.area_min.y_m);
  params.hi_m = Vec2(limits.area_max.x_m, limits.area_max.y_m);
  params.cell_m = limits.cell_m;
  params.speed_mps = task.charger.speed_mps;
  params.slope_max_rad = limits.slope_max_rad;
  for (const Polygon& area : areas_of(task, data::AreaKind::kNoDrive)) {
    const Result<std::vector<Polygon>> parts = clean(area);
    if (!parts) return bad_input("An area closed to the ground robot: " + parts.error().message);
    params.forbidden.insert(params.forbidden.end(), parts->begin(), parts->end());
  }
  const auto ground = RoughGround::make(params, terrain);
  if (!ground) return ground.error();
  return Travel(*ground);
}

}  // namespace

Result<Task> task_of(const data::CoverageTask& in) {
  Task out;
  out.id = in.task_id;
  out.revision = in.revision;
  out.vehicle_id = in.vehicle_id;
  out.origin = planner::GeoOrigin{in.origin.lat_deg, in.origin.lon_deg, in.origin.elevation_m};
  std::vector<Polygon> polygons = areas_of(in, data::AreaKind::kField);
  for (std::size_t i = 0; i < in.fields.size(); ++i) {
    const data::Field& field = in.fields[i];
    out.fields.push_back({field.field_id, "field " + std::to_string(field.field_id),
                          std::move(polygons.at(i)), field.height_m});
  }
  if (const Status status = check_fields(out.fields); !status) return status.error();
  auto no_fly = widened(areas_of(in, data::AreaKind::kNoFly), kOffNoFly_m);
  if (!no_fly) return Error{no_fly.error().code, "No-fly areas: " + no_fly.error().message};
  out.no_fly = std::move(*no_fly);
  out.sensor_width_m = in.sensor_width_m;
  out.height_tolerance_m = in.height_tolerance_m;
  out.height_band_m = in.height_band_m;
  out.neighbours = static_cast<int>(in.neighbours);
  if (in.rules.has_sweep) out.sweep_rad = in.rules.sweep_rad;
  out.rules = rules_of(in.rules);
  out.vehicle = {in.vehicle.radius_m,        in.vehicle.margin_m,          in.vehicle.cruise_speed_mps,
                 in.vehicle.climb_speed_mps, in.vehicle.descent_speed_mps, in.vehicle.turn_max_rad,
                 in.vehicle.climb_max_rad};
  out.battery = battery_of(in.battery);
  out.charger.id = in.charger.charger_id;
  out.charger.speed_mps = in.charger.speed_mps;
  out.charger.take_off_s = in.charger.take_off_s;
  out.charger.landing_s = in.charger.landing_s;
  out.charger.start_m = to_vec(in.charger.start);
  if (in.charger.has_battery) {
    const data::RobotBattery& own = in.charger.battery;
    out.charger.battery = {own.capacity, own.drive_per_s, own.per_charged, own.refill_s, own.reserve};
  }
  out.start_m = to_vec(in.start);
  out.seed = in.seed;
  return out;
}

Result<Travel> travel_of(const data::CoverageTask& task, const planner::Terrain& terrain) {
  switch (task.charger.ground.kind) {
    case data::GroundKind::kRoads:
      return along_roads(task);
    case data::GroundKind::kRough:
      return over_ground(task, terrain);
    case data::GroundKind::kOpen:
      break;
  }
  return Travel();
}

}  // namespace swallowtail::coverage
