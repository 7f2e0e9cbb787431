#pragma once

#include <chrono>
#include <cstdint>
#include <thread>

#include "idl/data/types.hpp"
#include "planner/base/result.hpp"
#include "tools/record/contract.hpp"

/// What the test publishers of both vendors send. `base` tells them apart: it is the key of everything a
/// publisher sends. expected.mjs states the same values again, for a reader that shares no code with us.
namespace swallowtail::record_test {

struct Sizes {
  std::uint32_t states = 1000;
  std::uint32_t tiles = 100;
  std::uint32_t tile_cells = 15000;
};

inline constexpr std::chrono::microseconds kStatePeriod{2000};

inline data::VehicleState vehicle_state(std::uint32_t base, std::uint32_t i) {
  data::VehicleState s;
  s.vehicle_id = base;
  s.time_s = 0.002 * i;
  s.position = {0.5 * i, -1.0 * i, 30.0};
  s.velocity_mps = {8.0, 0.0, -0.25};
  s.yaw_rad = 1.5;
  s.mode = data::VehicleMode::kCovering;
  s.path_revision = 3;
  s.leg_index = i;
  s.legs_done = i;
  return s;
}

inline data::TerrainTile terrain_tile(std::uint32_t base, std::uint32_t i, std::uint32_t cells) {
  data::TerrainTile t;
  t.map_id = base;
  t.row = i / 10;
  t.col = i % 10;
  t.origin = {52.1, 5.3, 12.0};
  t.map_rows = 1000;
  t.map_cols = 1500;
  t.first_row = t.row * 100;
  t.first_col = t.col * 150;
  t.tile_rows = 100;
  t.tile_cols = cells / 100;
  t.elevation_m.resize(cells);
  for (std::uint32_t c = 0; c < cells; ++c)
    t.elevation_m[c] = static_cast<float>(i) + static_cast<float>(c % 1000) * 0.25F;
  return t;
}

inline data::Obstacle obstacle(std::uint32_t base, std::uint32_t i) {
  data::Obstacle o;
  o.obstacle_id = base + i;
  o.shape = i == 0 ? data::ObstacleShape::kMesh : data::ObstacleShape::kSphere;
  o.position = {10.0 * i, 20.0, 30.0};
  o.radius_m = 5.0 + i;
  if (i == 0) o.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return o;
}

inline data::CoveragePlan coverage_plan(std::uint32_t base) {
  data::CoveragePlan p;
  p.task_id = 1;
  p.vehicle_id = base;
  p.revision = 7;
  p.reason = "battery lower than predicted";
  p.complete = true;
  p.legs.resize(data::kMaxLegs);
  for (std::uint32_t i = 0; i < p.legs.size(); ++i) {
    p.legs[i].sub_cell_id = i;
    p.legs[i].entry = {1.0 * i, 2.0 * i, 20.0};
    p.legs[i].transfer = data::Transfer::kFF;
    p.legs[i].start_s = i == 0 ? 0.0 : 10.0 * (i - 1);
    p.legs[i].end_s = 10.0 * i;
    p.legs[i].first_bend = 2 * i;
    p.legs[i].bend_count = 2;
  }
  p.bends.resize(data::kMaxBends);
  for (std::uint32_t i = 0; i < p.bends.size(); ++i) p.bends[i] = {0.5 * i, -0.5 * i, 25.0};
  return p;
}

inline data::PathPlan path_plan(std::uint32_t base) {
  data::PathPlan p;
  p.vehicle_id = base;
  p.revision = 9;
  p.verdict = data::PathVerdict::kCertified;
  p.reason = "obstacle 9 appeared";
  p.clearance_min_m = 4.5;
  p.waypoints.resize(500);
  for (std::uint32_t i = 0; i < p.waypoints.size(); ++i)
    p.waypoints[i] = {0.5 * i, {1.0 * i, 2.0, 3.0}, data::PathPhase::kCover, i};
  return p;
}

inline data::CoverageTask coverage_task(std::uint32_t base) {
  data::CoverageTask t;
  t.task_id = base;
  t.fields = {{1, 20.0}};
  t.rings = {{0, 0, 4, false}};
  t.points = {{0, 0}, {100, 0}, {100, 50}, {0, 50}};
  t.rings.push_back({0, 0, 3, false, data::AreaKind::kNoFly});
  t.roads = {{1, 3}};
  t.rules = {.overlap = 0.25, .has_sweep = true, .sweep_rad = 1.5, .headland = data::HeadlandUse::kFly};
  t.battery.taper_from = 0.75;
  t.battery.model.is_multirotor = true;
  t.battery.model.multirotor.rotors = 6;
  t.battery.model.wind_north_mps = -2.5;
  t.charger.ground.kind = data::GroundKind::kRoads;
  t.charger.ground.area_max = {7, 8};
  t.seed = 18446744073709551615u;
  t.has_terrain = true;
  return t;
}

inline data::ChargerPlan charger_plan(std::uint32_t base) {
  data::ChargerPlan p;
  p.charger_id = base;
  p.speed_mps = 1.6;
  p.has_battery = true;
  p.battery = {.capacity = 300.0, .reserve = 20.0, .drive_per_s = 0.1, .per_charged = 1.1, .refill_s = 60.0};
  p.rendezvous = {{.rendezvous_id = 5,
                   .site = {1, 2, 0},
                   .arrive_by_s = 100.0,
                   .depart_s = 150.0,
                   .charge_to = 500.0,
                   .carry = true,
                   .carry_to = {3, 4, 0},
                   .first_bend = 0,
                   .bend_count = 1,
                   .speed_mps = 1.5,
                   .carry_first_bend = 1,
                   .carry_bend_count = 2,
                   .carry_speed_mps = 1.25,
                   .robot_energy = 250.0,
                   .robot_energy_left = 80.0}};
  p.bends = {{5, 6, 7}, {8, 9, 10}, {11, 12, 13}};
  return p;
}

inline data::ParticipantStatus participant_status(std::uint32_t base) {
  data::ParticipantStatus s;
  s.participant_id = base;
  s.name = "test publisher";
  s.health = data::Health::kReady;
  s.accepted = 12345678901234u;
  s.rejected = {{"Obstacle", "not finite", 3}};
  s.message = "all is well";
  return s;
}

/// Sends everything. `Out` has send(sample), dispose(last), sync() (waits until reliable readers have all)
/// and prepare() (makes all writers, VehicleState's first).
template <class Out>
Status publish_scenario(Out& out, std::uint32_t base, const Sizes& sizes) {
  if (const Status prepared = out.prepare(); !prepared) return prepared;
  data::BatteryState battery{base, 1.0, 400.0, 500.0, 1.0, 0.9};
  out.send(battery);
  out.send(coverage_task(base));
  data::Goal goal;
  goal.vehicle_id = base;
  goal.position = {780.0, 590.0, 40.0};
  goal.bounds_max = {800.0, 600.0, 150.0};
  out.send(goal);
  // Discovery tells a reader of writers in the order of their making: with this acknowledged, VehicleState
  // has matched too.
  if (const Status synced = out.sync(); !synced) return synced;
  out.send(data::MissionClock{2.5, 4.0, data::ClockState::kRunning});
  out.send(charger_plan(base));
  out.send(participant_status(base));
  data::ChargerState charger;
  charger.charger_id = base;
  charger.activity = data::ChargerActivity::kWaiting;
  charger.energy_delivered = 75.5;
  charger.energy = 240.25;
  out.send(charger);
  std::thread burst([&] {
    out.send(path_plan(base));
    for (std::uint32_t i = 0; i < sizes.tiles; ++i) out.send(terrain_tile(base, i, sizes.tile_cells));
    out.send(coverage_plan(base));
  });
  auto due = std::chrono::steady_clock::now();
  for (std::uint32_t i = 0; i < sizes.states; ++i) {
    out.send(vehicle_state(base, i));
    due += kStatePeriod;
    std::this_thread::sleep_until(due);
  }
  burst.join();
  for (std::uint32_t i = 0; i < 3; ++i) out.send(obstacle(base, i));
  if (const Status synced = out.sync(); !synced) return synced;
  out.dispose(obstacle(base, 1));
  return out.sync();
}

}  // namespace swallowtail::record_test
