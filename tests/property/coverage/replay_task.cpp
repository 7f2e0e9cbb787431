#include "tests/property/coverage/replay_task.hpp"

#include <vector>

#include "coverage/ground/road_network.hpp"
#include "coverage/ground/rough_ground.hpp"
#include "planner/base/clock.hpp"
#include "planner/base/rng.hpp"
#include "tests/property/coverage/random_task.hpp"
#include "tests/property/coverage/rare_traits.hpp"

namespace swallowtail::coverage::test {
namespace {

planner::Terrain random_terrain(Rng& rng) {
  if (rng.uniform() < 0.5) return planner::Terrain::flat(rng.uniform(-10.0, 200.0));
  std::vector<planner::Mountain> hills;
  const int count = 1 + static_cast<int>(rng.below(4));
  for (int i = 0; i < count; ++i) {
    hills.push_back({rng.uniform(-150.0, 350.0), rng.uniform(-150.0, 150.0), rng.uniform(2.0, 25.0),
                     rng.uniform(2000.0, 20000.0)});
  }
  return *planner::mountains_terrain(hills, Vec2(-200.0, -200.0), Vec2(400.0, 200.0), 5.0);
}

/// All of them fly at about a unit per second.
EnergyModel random_energy(Rng& rng) {
  EnergyModel out;
  const double kind = rng.uniform();
  if (kind > 0.2) {
    out = {rng.uniform(0.5, 1.2), rng.uniform(0.7, 1.5), rng.uniform(0.3, 1.2), rng.uniform(0.5, 1.2),
           rng.uniform() < 0.5 ? 0.0 : rng.uniform(0.0, 0.02)};
  }
  if (kind > 0.5) {
    out.altitude_per_m = rng.uniform(0.0, 0.01);
    out.altitude_from_m = rng.uniform(-10.0, 100.0);
  }
  if (kind > 0.7) {
    Multirotor craft;
    craft.mass_kg = rng.uniform(1.0, 6.0);
    craft.payload_kg = rng.uniform(0.0, 2.0);
    craft.rotors = 4 + 2 * static_cast<int>(rng.below(3));
    craft.rotor_radius_m = rng.uniform(0.12, 0.3);
    craft.drag_area_m2 = rng.uniform(0.01, 0.1);
    craft.air_speed_max_mps = 40.0;
    out.multirotor = craft;
    out.wind_mps = Vec2(rng.uniform(-8.0, 8.0), rng.uniform(-8.0, 8.0));
    out.unit_j = power_w(craft, Vec3::Zero());
  }
  return out;
}

void add_no_fly(Rng& rng, Task& task) {
  const Vec2 centre(rng.uniform(-100.0, 250.0), rng.uniform(-80.0, 80.0));
  const double half = rng.uniform(5.0, 20.0);
  task.no_fly.push_back({{centre + Vec2(-half, -half), centre + Vec2(half, -half), centre + Vec2(half, half),
                          centre + Vec2(-half, half)},
                         {}});
}

/// Streets in a grid, or open ground with a slope limit and forbidden boxes.
void set_ground(Rng& rng, ReplayTask& out) {
  const double kind = rng.uniform();
  if (kind < 0.6) return;
  test_support::ReplayRoads& robot = out.robot;
  if (kind < 0.85) {
    RoadParams params;
    const double apart = rng.uniform(30.0, 80.0);
    const double turn = rng.uniform(0.0, 1.5);
    const auto crossing = [&](int row, int col) -> Vec2 {
      return rotated(Vec2(apart * col, apart * row), turn) + Vec2(80.0, 0.0);
    };
    for (int line = -5; line <= 5; ++line) {
      params.lines.emplace_back();
      for (int at = -5; at <= 5; ++at) params.lines.back().push_back(crossing(line, at));
      params.lines.emplace_back();
      for (int at = -5; at <= 5; ++at) params.lines.back().push_back(crossing(at, line));
    }
    params.speed_mps = rng.uniform(1.0, 5.0);
    params.off_road_speed_mps = rng.uniform() < 0.2 ? 0.0 : rng.uniform(0.2, 1.0) * params.speed_mps;
    params.off_road_max_m = rng.uniform(20.0, 300.0);
    robot.roads = params.lines;
    robot.road_speed_mps = params.speed_mps;
    robot.off_road_speed_mps = params.off_road_speed_mps;
    out.task.charger.travel = *RoadNetwork::make(params);
    return;
  }
  RoughGroundParams params;
  params.lo_m = Vec2(-200.0, -200.0);
  params.hi_m = Vec2(400.0, 200.0);
  params.cell_m = rng.uniform(8.0, 16.0);
  params.speed_mps = out.task.charger.speed_mps;
  params.slope_max_rad = rng.uniform(0.2, 0.6);
  for (int i = static_cast<int>(rng.below(4)); i > 0; --i)
    params.forbidden.push_back(random_polygon(rng, Vec2(rng.uniform(-100.0, 250.0), rng.uniform(-80.0, 80.0)),
                                              rng.uniform(5.0, 40.0)));
  robot.forbidden = params.forbidden;
  robot.slope_max_rad = params.slope_max_rad;
  out.task.charger.travel = *RoughGround::make(params, out.terrain);
}

}  // namespace

ReplayTask random_replay_task(std::uint64_t seed) {
  Rng rng(seed);
  ReplayTask out;
  out.terrain = random_terrain(rng);
  Task& task = out.task;
  const int fields = 1 + static_cast<int>(rng.below(2));
  for (int f = 0; f < fields; ++f) {
    const Vec2 centre(160.0 * f + rng.uniform(-20.0, 20.0), rng.uniform(-30.0, 30.0));
    task.fields.push_back({static_cast<std::uint32_t>(f + 1), "random",
                           random_polygon(rng, centre, rng.uniform(20.0, 50.0)), rng.uniform(8.0, 40.0)});
  }
  if (rng.uniform() < 0.3) add_no_fly(rng, task);
  // Drawn apart: the other tasks are as they were.
  Rng rare(seed * 7907);
  const bool is_rare = rare.uniform() < 0.5;
  if (is_rare) add_rare_ground(rare, out);
  task.sensor_width_m = rng.uniform(9.0, 20.0);
  task.height_tolerance_m = rng.uniform(1.0, 4.0);
  task.vehicle.cruise_speed_mps = rng.uniform(4.0, 12.0);
  task.vehicle.climb_speed_mps = rng.uniform(1.0, 5.0);
  task.vehicle.descent_speed_mps = rng.uniform(1.0, 5.0);
  task.vehicle.turn_max_rad = rng.uniform(0.3, 2.0);
  task.battery.capacity = rng.uniform(60.0, 180.0);
  task.battery.reserve = rng.uniform(2.0, 10.0);
  task.battery.levels = rng.uniform() < 0.05 ? 10 : 1 + static_cast<int>(rng.below(4));
  task.battery.charge_s_per_unit = rng.uniform(0.2, 3.0);
  task.battery.model = random_energy(rng);
  task.charger.speed_mps = rng.uniform(0.8, 4.0);
  task.charger.take_off_s = rng.uniform(0.0, 8.0);
  task.charger.landing_s = rng.uniform(0.0, 8.0);
  task.charger.start_m = Vec3(rng.uniform(-120.0, 0.0), -120.0, 0.0);
  task.start_m = Vec3(rng.uniform(-120.0, 0.0), -100.0, 0.0);
  if (rng.uniform() < 0.4) {
    task.battery.taper_from = rng.uniform(0.0, 1.0);
    task.battery.taper_end_rate = rng.uniform(0.02, 1.0);
  }
  if (is_rare) add_rare_wishes(rare, out);
  set_ground(rng, out);
  out.options.seed = seed;
  // Drawn apart: the tasks are else as they were.
  Rng robot(seed * 6151);
  if (robot.uniform() < 0.5) {
    RobotBattery& own = task.charger.battery;
    own.capacity = task.battery.capacity * robot.uniform(0.4, 1.2);
    own.drive_per_s = robot.uniform(0.0, 0.3);
    own.per_charged = robot.uniform(0.8, 1.3);
    own.refill_s = robot.uniform(0.0, 120.0);
    own.reserve = robot.uniform(0.0, 0.1) * own.capacity;
    own.capacity += own.reserve;
  }
  out.options.energy_margin = rng.uniform(0.0, 0.15);
  out.options.energy_spare = rng.uniform(0.0, 0.04);
  out.options.lead_s = rng.uniform(0.0, 2.0);
  out.options.stop.max_evaluations = 40;
  out.options.stop.max_iterations = 40;
  if (rng.uniform() < 0.9) {
    // Any order will do for most: what is judged here is the schedule.
    static const ManualClock kStill;
    out.options.stop.clock = &kStill;
    out.options.stop.deadline_s = 0.0;
  }
  return out;
}

test_support::ReplayQuestion question_of(const ReplayTask& random) {
  test_support::ReplayQuestion out;
  out.robot = random.robot;
  const planner::Terrain& terrain = random.terrain;
  out.ground_m = [&terrain](double x_m, double y_m) { return terrain.height_at(x_m, y_m); };
  out.lead_s = random.options.lead_s;
  out.energy_margin = random.options.energy_margin;
  out.energy_spare = random.options.energy_spare * random.task.battery.capacity;
  if (!terrain.is_flat()) {
    // Both look for the highest ground on the way: one exactly, the other at steps.
    out.time_tolerance_s = 0.05;
    out.energy_tolerance = 0.05;
    out.height_tolerance_m = 0.05;
  }
  return out;
}

}  // namespace swallowtail::coverage::test
