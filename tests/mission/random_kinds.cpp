#include "tests/mission/random_kinds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

namespace swallowtail::mission {
namespace {

void draw_hills(Rng& rng, RandomMission& mission) {
  planner::MountainTerrain hills;
  for (std::uint64_t i = 0; i < 1 + rng.below(3); ++i)
    hills.mountains.push_back({rng.uniform(-80.0, 180.0), rng.uniform(-80.0, 80.0), rng.uniform(2.0, 14.0),
                               rng.uniform(2500.0, 9000.0)});
  hills.cell_size_m = 5.0;
  mission.scenario.terrain = hills;
  mission.faults += "hills; ";
}

void draw_flight(Rng& rng, RandomMission& mission) {
  planner::EnergyRates& rates = mission.scenario.vehicle.energy;
  rates.climb_per_s = rng.uniform(1.0, 1.7);
  rates.descent_per_s = rng.uniform(0.7, 1.0);
  rates.hover_per_s = rng.uniform(0.95, 1.15);
  if (rng.uniform() < 0.5) rates.altitude_per_m = rng.uniform(0.0, 0.004);
  mission.faults += "rates of flight; ";
}

void draw_lines(Rng& rng, RandomMission& mission) {
  planner::CoverageSpec& spec = *mission.scenario.coverage;
  if (rng.uniform() < 0.4) spec.overlap = rng.uniform(0.05, 0.3);
  if (rng.uniform() < 0.3) spec.sweep_rad = rng.uniform(0.0, std::numbers::pi);
  if (rng.uniform() < 0.3) {
    spec.headland = planner::HeadlandUse::kFly;
    spec.headland_m = rng.uniform(0.6, 1.2) * spec.sensor_width_m;
  }
  if (spec.sweep_rad) mission.faults += "one direction; ";
  if (spec.headland_m > 0.0) mission.faults += "headland; ";
}

/// The robot's map of closed ground has cells of 2 m.
const std::array<Vec2, 9> kAround{Vec2(0, 0),      Vec2(3, 0),      Vec2(-3, 0),
                                  Vec2(0, 3),      Vec2(0, -3),     Vec2(2.1, 2.1),
                                  Vec2(2.1, -2.1), Vec2(-2.1, 2.1), Vec2(-2.1, -2.1)};

void draw_closed_ground(Rng& rng, RandomMission& mission, const std::string& file) {
  std::vector<coverage::Polygon> areas;
  for (std::uint64_t i = 0; i < 1 + rng.below(3); ++i) {
    const Vec2 centre(rng.uniform(-30.0, 160.0), rng.uniform(-60.0, 60.0));
    const double radius_m = rng.uniform(5.0, 20.0);
    coverage::Polygon area;
    for (int k = 0; k < 5; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 5.0;
      area.outline.push_back(centre + radius_m * Vec2(std::cos(angle), std::sin(angle)));
    }
    areas.push_back(area);
  }
  write_polygons(areas, file);
  mission.is_closed = [areas](const Vec2& p) {
    return std::ranges::any_of(areas, [&](const coverage::Polygon& area) {
      return std::ranges::any_of(kAround, [&](const Vec2& off) { return within(area.outline, p + off); });
    });
  };
  mission.scenario.coverage->charger.ground = planner::RoughGroundSpec{.forbidden_file = file};
  mission.faults += "closed ground; ";
}

/// One road from the robot's start through the middle, one across it.
void draw_roads(Rng& rng, RandomMission& mission, const std::string& file) {
  planner::ChargerSpec& charger = mission.scenario.coverage->charger;
  const double across_m = rng.uniform(-20.0, 60.0);
  const nlohmann::json ways = {
      {{charger.start_m.x(), charger.start_m.y()}, {-60.0, 0.0}, {across_m, 0.0}, {220.0, 10.0}},
      {{across_m, -90.0}, {across_m, 0.0}, {across_m + 5.0, 90.0}}};
  nlohmann::json features = nlohmann::json::array();
  for (const nlohmann::json& way : ways)
    features.push_back({{"type", "Feature"},
                        {"properties", {{"crs", "local metres"}}},
                        {"geometry", {{"type", "LineString"}, {"coordinates", way}}}});
  std::ofstream(file) << nlohmann::json{{"type", "FeatureCollection"}, {"features", features}};
  const double slow_mps = rng.uniform(0.5, 1.0) * charger.speed_mps;
  const double most_m = rng.uniform(60.0, 150.0);
  charger.ground = planner::RoadSpec{.file = file, .off_road_speed_mps = slow_mps, .off_road_max_m = most_m};
  if (charger.battery) charger.battery->capacity += charger.battery->drive_per_s * 800.0 / charger.speed_mps;
  mission.is_closed = [ways, most_m](const Vec2& p) {
    double away_m = 1e9;
    for (const nlohmann::json& way : ways) {
      for (std::size_t i = 1; i < way.size(); ++i) {
        const Vec2 a(way[i - 1][0], way[i - 1][1]);
        const Vec2 along = Vec2(way[i][0], way[i][1]) - a;
        const double share = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
        away_m = std::min(away_m, (p - a - share * along).norm());
      }
    }
    return away_m > most_m - 1.0;
  };
  mission.faults += "roads; ";
}

}  // namespace

void draw_kinds(Rng& rng, RandomMission& mission, const std::string& folder) {
  planner::CoverageSpec& spec = *mission.scenario.coverage;
  const std::string name = folder + "/" + std::to_string(mission.seed);
  if (rng.uniform() < 0.3) draw_hills(rng, mission);
  if (rng.uniform() < 0.3) draw_flight(rng, mission);
  if (rng.uniform() < 0.4) spec.heights.classes["f0"] = rng.uniform(6.0, 30.0);
  // Within the tolerance there is still clearance.
  if (std::holds_alternative<planner::MountainTerrain>(mission.scenario.terrain)) {
    const double clearance_m = 3.0;
    const double lowest_m = std::min(spec.heights.default_m,
                                     spec.heights.classes.contains("f0") ? spec.heights.classes["f0"] : 1e9);
    spec.height_tolerance_m = rng.uniform(2.0, std::clamp(lowest_m - clearance_m, 2.1, 6.0));
  }
  if (rng.uniform() < 0.3) {
    spec.battery.taper_from = rng.uniform(0.6, 0.95);
    spec.battery.taper_end_rate = rng.uniform(0.1, 0.5);
  }
  draw_lines(rng, mission);
  const double ground = rng.uniform();
  if (ground < 0.2) return draw_closed_ground(rng, mission, name + "_closed.geojson");
  if (ground < 0.4) draw_roads(rng, mission, name + "_roads.geojson");
}

double greatest_rate(const planner::Scenario& scenario) {
  const planner::EnergyRates& rates = scenario.vehicle.energy;
  return std::max({rates.level_per_s, rates.climb_per_s, rates.descent_per_s, rates.hover_per_s}) *
         (1.0 + rates.altitude_per_m * scenario.bounds.max_m.z());
}

}  // namespace swallowtail::mission
