#include <algorithm>
#include <string>
#include <utility>

#include "planner/scenario/detail/read_parts.hpp"

namespace swallowtail::planner::detail {
namespace {

using Kind = ScenarioError::Kind;

constexpr Range kSpeed = above_to(0, kMaxSpeed_mps);
constexpr Range kEnergy = above_to(0, 1e9);
constexpr std::size_t kMaxFieldIds = 64;

/// All four, or none besides an altitude factor: then they are the document's.
void read_rates(Section& model, EnergyRates& out) {
  constexpr Range kRate = above_to(0, 1e6);
  const bool has_any = model.has("level_per_s") || model.has("climb_per_s") || model.has("descent_per_s") ||
                       model.has("hover_per_s");
  const Need need = has_any || !model.has("altitude_per_m") ? Need::kRequired : Need::kOptional;
  model.number("level_per_s", need, kRate, out.level_per_s);
  model.number("climb_per_s", need, kRate, out.climb_per_s);
  model.number("descent_per_s", need, kRate, out.descent_per_s);
  model.number("hover_per_s", need, kRate, out.hover_per_s);
}

void read_multirotor(Section& model, MultirotorSpec& out) {
  model.number("unit_j", Need::kOptional, above_to(0, 1e9), out.unit_j);
  auto craft = model.section("multirotor", Need::kRequired);
  if (!craft || !craft->is_map()) return;
  craft->number("mass_kg", Need::kRequired, above_to(0, 1e3), out.mass_kg);
  craft->number("payload_kg", Need::kOptional, from_to(0, 1e3), out.payload_kg);
  craft->integer("rotors", Need::kOptional, from_to(1, 64), out.rotors);
  craft->number("rotor_radius_m", Need::kRequired, above_to(0, 10), out.rotor_radius_m);
  craft->number("drag_area_m2", Need::kOptional, from_to(0, 10), out.drag_area_m2);
  craft->number("solidity", Need::kOptional, from_to(0, 1), out.solidity);
  craft->number("blade_drag", Need::kOptional, from_to(0, 1), out.blade_drag);
  craft->number("tip_speed_mps", Need::kOptional, above_to(0, 340), out.tip_speed_mps);
  craft->number("induced_factor", Need::kOptional, from_to(1, 3), out.induced_factor);
  craft->number("efficiency", Need::kOptional, from_to(0.05, 1), out.efficiency);
  craft->number("avionics_w", Need::kOptional, from_to(0, 1e6), out.avionics_w);
  craft->number("air_density_kgpm3", Need::kOptional, above_to(0, 10), out.air_density_kgpm3);
  craft->number("air_speed_max_mps", Need::kOptional, kSpeed, out.air_speed_max_mps);
  craft->finish();
}

void read_energy_model(Section& vehicle, VehicleSpec& out) {
  const RawNode* node = vehicle.raw("energy_model", Need::kOptional);
  if (node == nullptr) return;
  if (node->kind == RawNode::Kind::kScalar && node->scalar == "document") return;
  if (node->kind != RawNode::Kind::kMap) {
    vehicle.fail(node->kind == RawNode::Kind::kScalar ? Kind::kRange : Kind::kType, "energy_model",
                 "must be document or a map of rates");
    return;
  }
  Section model(*node, vehicle.path_of("energy_model"), vehicle.log());
  model.number("landed_per_s", Need::kOptional, from_to(0, 1e6), out.energy.landed_per_s);
  model.number("altitude_per_m", Need::kOptional, from_to(0, 1), out.energy.altitude_per_m);
  model.number("altitude_from_m", Need::kOptional, from_to(-1000, 1e4), out.energy.altitude_from_m);
  if (model.has("multirotor")) {
    out.multirotor.emplace();
    read_multirotor(model, *out.multirotor);
  } else {
    read_rates(model, out.energy);
  }
  model.finish();
}

void read_heights(Section& coverage, HeightSpec& out) {
  auto heights = coverage.section("heights", Need::kRequired);
  if (!heights || !heights->is_map()) return;
  constexpr Range kHeight = above_to(0, 1e4);
  heights->number("default_m", Need::kRequired, kHeight, out.default_m);
  std::vector<std::pair<std::string, double>> classes;
  if (heights->numbers_by_name("classes", Need::kOptional, kHeight, classes))
    out.classes.insert(classes.begin(), classes.end());
  heights->finish();
}

void read_rules(Section& coverage, const std::string& folder, CoverageSpec& out) {
  if (coverage.has("no_fly")) resolve_file(coverage, "no_fly", folder, out.no_fly_file);
  coverage.number("overlap", Need::kOptional, from_to(0, 0.9), out.overlap);
  double sweep_rad = 0.0;
  if (coverage.has("sweep_deg") &&
      coverage.angle_deg("sweep_deg", Need::kOptional, from_to(-360, 360), sweep_rad))
    out.sweep_rad = sweep_rad;
  if (auto headland = coverage.section("headland", Need::kOptional); headland && headland->is_map()) {
    std::string use;
    if (headland->choice("use", Need::kRequired, {"skip", "fly"}, use))
      out.headland = use == "skip" ? HeadlandUse::kSkip : HeadlandUse::kFly;
    headland->number("width_m", Need::kRequired, above_to(0, 1e4), out.headland_m);
    headland->finish();
  }
  std::string beyond;
  if (coverage.choice("lines_beyond_borders", Need::kOptional, {"never", "slanted"}, beyond))
    out.lines_beyond_borders = beyond == "slanted";
  coverage.number("ceiling_m", Need::kOptional, above_to(0, 1e4), out.ceiling_m);
}

void read_battery(Section& coverage, BatterySpec& out) {
  auto battery = coverage.section("battery", Need::kRequired);
  if (!battery || !battery->is_map()) return;
  bool ok = battery->number("capacity", Need::kRequired, kEnergy, out.capacity);
  battery->integer("levels", Need::kRequired, from_to(2, 100), out.levels);
  ok = battery->number("reserve", Need::kRequired, from_to(0, 1e9), out.reserve) && ok;
  battery->number("charge_s_per_unit", Need::kRequired, above_to(0, 1e4), out.charge_s_per_unit);
  battery->number("taper_from", Need::kOptional, from_to(0, 1), out.taper_from);
  battery->number("taper_end_rate", Need::kOptional, from_to(0.001, 1), out.taper_end_rate);
  battery->finish();
  if (ok && out.reserve >= out.capacity) battery->fail(Kind::kRelation, "reserve", "must be below capacity");
}

void read_ground(Section& charger, const std::string& folder, ChargerSpec& out) {
  if (auto roads = charger.section("roads", Need::kOptional); roads && roads->is_map()) {
    RoadSpec& spec = out.ground.emplace<RoadSpec>();
    resolve_file(*roads, "file", folder, spec.file);
    roads->number("off_road_speed_mps", Need::kOptional, from_to(0, kMaxSpeed_mps), spec.off_road_speed_mps);
    roads->number("off_road_max_m", Need::kOptional, from_to(0, 1e5), spec.off_road_max_m);
    roads->finish();
  }
  if (auto rough = charger.section("rough_ground", Need::kOptional); rough && rough->is_map()) {
    if (std::holds_alternative<RoadSpec>(out.ground))
      charger.fail(Kind::kRelation, "rough_ground", "must not stand beside roads");
    RoughGroundSpec& spec = out.ground.emplace<RoughGroundSpec>();
    rough->angle_deg("slope_max_deg", Need::kRequired, from_to(0, 85), spec.slope_max_rad);
    if (rough->has("forbidden")) resolve_file(*rough, "forbidden", folder, spec.forbidden_file);
    rough->number("cell_m", Need::kOptional, above_to(0, 1e3), spec.cell_m);
    rough->finish();
  }
}

void read_charger(Section& coverage, const std::string& folder, const Bounds& bounds, ChargerSpec& out) {
  auto charger = coverage.section("charger", Need::kRequired);
  if (!charger || !charger->is_map()) return;
  charger->integer("id", Need::kOptional, kId, out.id);
  charger->number("speed_mps", Need::kRequired, kSpeed, out.speed_mps);
  charger->number("take_off_s", Need::kOptional, from_to(0, 1e4), out.take_off_s);
  charger->number("landing_s", Need::kOptional, from_to(0, 1e4), out.landing_s);
  const bool has_start =
      charger->vector("start_m", Need::kRequired, from_to(-kMaxXy_m, kMaxXy_m), out.start_m);
  if (has_start && !bounds.contains({out.start_m.x(), out.start_m.y(), bounds.min_m.z()})) {
    charger->fail(Kind::kRelation, "start_m", "must be within bounds_m");
  }
  read_ground(*charger, folder, out);
  if (auto battery = charger->section("battery", Need::kOptional); battery && battery->is_map()) {
    RobotBatterySpec& spec = out.battery.emplace();
    battery->number("capacity", Need::kRequired, kEnergy, spec.capacity);
    battery->number("drive_per_s", Need::kRequired, from_to(0, 1e6), spec.drive_per_s);
    battery->number("per_charged", Need::kOptional, from_to(0, 1e3), spec.per_charged);
    battery->number("refill_s", Need::kOptional, from_to(0, 1e6), spec.refill_s);
    battery->number("reserve", Need::kOptional, from_to(0, 1e9), spec.reserve);
    battery->finish();
    if (spec.capacity > 0.0 && spec.reserve >= spec.capacity)
      battery->fail(Kind::kRelation, "reserve", "must be below capacity");
  }
  charger->finish();
}

void read_field_ids(Section& coverage, std::vector<std::string>& out) {
  for (const Section::Item& item : coverage.list("field_ids", Need::kOptional, 1, kMaxFieldIds)) {
    const bool is_id = item.node->kind == RawNode::Kind::kScalar && !item.node->scalar.empty();
    if (!is_id) {
      coverage.log().add(Kind::kType, item.node->line, item.path, shown(*item.node),
                         "must be the id of a field");
    } else if (std::ranges::find(out, item.node->scalar) != out.end()) {
      coverage.log().add(Kind::kDuplicate, item.node->line, item.path, shown(*item.node),
                         "stands twice in the list");
    } else {
      out.push_back(item.node->scalar);
    }
  }
}

void read_weights(Section& planning, PlanningSpec& out) {
  auto weights = planning.section("weights", Need::kOptional);
  if (!weights || !weights->is_map()) return;
  for (const char* name : {"length", "energy", "range", "clearance", "altitude", "smoothness", "concealment",
                           "threat", "violation", "contact", "collision", "F1", "F2", "F3", "F4"}) {
    std::optional<double> weight;
    if (weights->number(name, Need::kOptional, from_to(0, 1e9), weight) && weight) {
      out.weights.emplace_back(name, *weight);
    }
  }
  weights->finish();
}

}  // namespace

void read_vehicle(Section& top, Scenario& scenario) {
  auto section = top.section("vehicle", Need::kRequired);
  if (!section || !section->is_map()) return;
  VehicleLimits& limits = scenario.vehicle.limits;
  section->integer("id", Need::kOptional, kId, scenario.vehicle.id);
  section->number("radius_m", Need::kRequired, above_to(0, 100), limits.radius_m);
  section->number("margin_m", Need::kRequired, from_to(0, 1000), limits.margin_m);
  section->number("cruise_speed_mps", Need::kRequired, kSpeed, limits.cruise_speed_mps);
  section->number("climb_speed_mps", Need::kOptional, kSpeed, limits.climb_speed_mps);
  section->number("descent_speed_mps", Need::kOptional, kSpeed, limits.descent_speed_mps);
  section->angle_deg("turn_max_deg", Need::kOptional, above_to(0, 180), limits.turn_max_rad);
  section->angle_deg("climb_max_deg", Need::kOptional, above_to(0, 89), limits.climb_max_rad);
  read_energy_model(*section, scenario.vehicle);
  section->finish();
}

void read_planning(Section& top, Scenario& scenario) {
  auto section = top.section("planning", Need::kOptional);
  if (!section || !section->is_map()) return;
  PlanningSpec& planning = scenario.planning;
  section->choice("algorithm", Need::kOptional,
                  {"boa", "pso", "ibabc", "aco", "nmopso", "boa-seed", "pso-seed", "ibabc-seed", "aco-seed",
                   "nmopso-seed"},
                  planning.algorithm);
  section->integer("waypoints", Need::kOptional, from_to(1, 64), planning.waypoints);
  section->choice(
      "cost", Need::kOptional,
      {"default", "BOA", "PSO", "IBABC", "NMOPSO", "SPSO", "boa", "pso", "ibabc", "nmopso", "spso"},
      planning.cost);
  read_weights(*section, planning);
  Vec2 band = Vec2::Zero();
  if (section->vector("altitude_m", Need::kOptional, from_to(0, 1e4), band)) {
    planning.altitude_m = band;
    if (band.x() >= band.y())
      section->fail(Kind::kRelation, "altitude_m", "must rise from least to greatest");
  }
  section->finish();
}

void read_coverage(Section& top, const std::string& folder, Scenario& scenario) {
  auto section = top.section("coverage", Need::kOptional);
  if (!section || !section->is_map()) return;
  CoverageSpec coverage;
  resolve_file(*section, "fields", folder, coverage.fields_file);
  read_field_ids(*section, coverage.field_ids);
  Vec2 place = Vec2::Zero();
  if (section->has("place_at_m") &&
      section->vector("place_at_m", Need::kOptional, from_to(-kMaxXy_m, kMaxXy_m), place)) {
    coverage.place_at_m = place;
  }
  section->number("sensor_width_m", Need::kRequired, above_to(0, 1e4), coverage.sensor_width_m);
  read_heights(*section, coverage.heights);
  section->number("height_tolerance_m", Need::kOptional, above_to(0, 1e4), coverage.height_tolerance_m);
  section->number("height_band_m", Need::kOptional, from_to(0, 1e4), coverage.height_band_m);
  section->integer("neighbours", Need::kOptional, from_to(1, 1000), coverage.neighbours);
  read_rules(*section, folder, coverage);
  read_battery(*section, coverage.battery);
  read_charger(*section, folder, scenario.bounds, coverage.charger);
  section->finish();
  scenario.coverage = std::move(coverage);
}

void read_disturbances(Section& top, Scenario& scenario) {
  if (auto wind = top.section("wind", Need::kOptional); wind && wind->is_map()) {
    wind->number("speed_mps", Need::kRequired, from_to(0, 50), scenario.wind.speed_mps);
    wind->angle_deg("direction_deg", Need::kRequired, from_to(0, 360), scenario.wind.direction_rad);
    wind->number("gust_mps", Need::kOptional, from_to(0, 50), scenario.wind.gust_mps);
    wind->finish();
  }
  top.number("battery_noise", Need::kOptional, from_to(0, 0.5), scenario.battery_noise);
}

}  // namespace swallowtail::planner::detail
