#include "tests/unit/idl/samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace swallowtail::testing {

namespace {

using namespace data;

constexpr std::uint32_t kMax32 = std::numeric_limits<std::uint32_t>::max();

/// Draws numbers and lengths for one sample.
class Draw {
 public:
  Draw(Extent extent, Rng& rng) : extent_(extent), rng_(rng) {}

  std::size_t length(std::size_t bound, std::size_t least = 0) {
    if (extent_ == Extent::kEmpty) return least;
    if (extent_ == Extent::kFull) return bound;
    return least + rng_.below(std::min<std::size_t>(bound, least + 40) - least + 1);
  }
  double in(double lo, double hi) {
    if (extent_ == Extent::kFull) return rng_.below(2) ? lo : hi;
    return rng_.uniform(lo, hi);
  }
  /// In (0, hi].
  double positive(double hi) { return extent_ == Extent::kFull ? hi : hi * (1.0 - rng_.uniform()); }
  std::uint32_t id() { return extent_ == Extent::kFull ? kMax32 : static_cast<std::uint32_t>(rng_() >> 32); }
  std::uint64_t wide() { return extent_ == Extent::kFull ? ~std::uint64_t{0} : rng_(); }
  bool coin() { return rng_.below(2) == 1; }
  template <class Enum>
  Enum any(Enum last) {
    const auto count = static_cast<std::uint64_t>(last) + 1;
    return static_cast<Enum>(extent_ == Extent::kFull ? count - 1 : rng_.below(count));
  }
  std::string text(std::size_t bound) {
    std::string text(length(bound), ' ');
    for (char& c : text) c = static_cast<char>('!' + rng_.below(90));
    return text;
  }
  Vec3 position() { return {in(-1e6, 1e6), in(-1e6, 1e6), in(-1e3, 2e4)}; }
  Vec3 velocity() { return {in(-100, 100), in(-100, 100), in(-100, 100)}; }
  GeoOrigin origin() { return {in(-90, 90), in(-180, 180), in(-1e3, 2e4)}; }
  double time() { return in(0, 1e7); }
  VehicleLimits limits() {
    return {positive(1e4), in(0, 1e4),     positive(200), positive(200),
            positive(200), positive(3.14), positive(1.57)};
  }
  RobotBattery robot_battery() {
    const double capacity = positive(1e9);
    return {capacity, 0.5 * in(0, capacity), in(0, 1e6), in(0, 1e6), time()};
  }

 private:
  Extent extent_;
  Rng& rng_;
};

/// One outline for each field, then no-fly and no-drive areas, holes of the first field, and roads; all rings
/// circles of their own.
void fill_areas(CoverageTask& s, Draw& draw, Extent extent, Rng& rng) {
  const bool full = extent == Extent::kFull;
  const auto add_points = [&](std::uint32_t count) {
    const Point2 centre{rng.uniform(-9e5, 9e5), rng.uniform(-9e5, 9e5)};
    for (std::uint32_t k = 0; k < count; ++k) {
      const double angle = 6.283185307179586 * k / count;
      s.points.push_back({centre.x_m + 1e3 * std::cos(angle), centre.y_m + 1e3 * std::sin(angle)});
    }
  };
  const auto add_ring = [&](std::uint32_t area, AreaKind kind, bool is_hole) {
    const std::uint32_t count = full ? 12 : 3 + static_cast<std::uint32_t>(rng.below(14));
    s.rings.push_back({area, static_cast<std::uint32_t>(s.points.size()), count, is_hole, kind});
    add_points(count);
  };
  for (std::uint32_t i = 0; i < s.fields.size(); ++i) add_ring(i, AreaKind::kField, false);
  const std::uint32_t others = full ? 100 : static_cast<std::uint32_t>(draw.length(4));
  for (const AreaKind kind : {AreaKind::kNoFly, AreaKind::kNoDrive}) {
    for (std::uint32_t i = 0; i < others; ++i) add_ring(i, kind, false);
  }
  if (others > 0) add_ring(0, AreaKind::kNoFly, true);
  const std::size_t rings = std::max(s.rings.size(), draw.length(kMaxRings, 1));
  while (s.rings.size() < rings) add_ring(0, AreaKind::kField, true);
  s.roads.resize(draw.length(kMaxRoads));
  for (Road& road : s.roads) {
    road = {static_cast<std::uint32_t>(s.points.size()), 2 + static_cast<std::uint32_t>(rng.below(3))};
    add_points(road.point_count);
  }
  if (full) add_points(static_cast<std::uint32_t>(kMaxTaskPoints - s.points.size()));
}

void fill_model(EnergyModel& m, Draw& draw) {
  m = {draw.in(0, 1e6), draw.in(0, 1e6), draw.in(0, 1e6), draw.in(0, 1e6), draw.in(0, 1e6)};
  m.altitude_per_m = draw.in(0, 1);
  m.altitude_from_m = draw.in(-1e3, 2e4);
  m.is_multirotor = draw.coin();
  Multirotor& craft = m.multirotor;
  craft.rotors = 1 + static_cast<std::uint32_t>(draw.length(63));
  for (double* value :
       {&craft.mass_kg, &craft.payload_kg, &craft.rotor_radius_m, &craft.drag_area_m2, &craft.solidity,
        &craft.blade_drag, &craft.tip_speed_mps, &craft.induced_factor, &craft.efficiency, &craft.avionics_w,
        &craft.air_density_kgpm3, &craft.air_speed_max_mps}) {
    *value = draw.in(0, 1e6);
  }
  m.unit_j = draw.positive(1e9);
  m.wind_east_mps = draw.in(-200, 200);
  m.wind_north_mps = draw.in(-200, 200);
}

/// The next part of a pool of bends.
std::uint32_t draw_bends(std::vector<Vec3>& bends, std::uint32_t count, Draw& draw) {
  for (std::uint32_t i = 0; i < count; ++i) bends.push_back(draw.position());
  return count;
}

}  // namespace

void fill(TerrainTile& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.map_id = draw.id(),
       .row = draw.id(),
       .col = draw.id(),
       .revision = draw.id(),
       .origin = draw.origin()};
  s.origin_x_m = draw.in(-1e5, 1e5);
  s.origin_y_m = draw.in(-1e5, 1e5);
  s.cell_size_m = draw.positive(100.0);
  s.tile_rows = static_cast<std::uint32_t>(draw.length(100, 1));
  s.tile_cols = static_cast<std::uint32_t>(draw.length(150, 1));
  s.first_row = static_cast<std::uint32_t>(rng.below(1000));
  s.first_col = static_cast<std::uint32_t>(rng.below(1000));
  s.map_rows = s.first_row + s.tile_rows;
  s.map_cols = s.first_col + s.tile_cols;
  s.elevation_m.resize(std::size_t{s.tile_rows} * s.tile_cols);
  for (float& elevation : s.elevation_m) elevation = static_cast<float>(draw.in(-1e3, 2e4));
}

void fill(Obstacle& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.obstacle_id = draw.id(), .revision = draw.id()};
  s.shape = extent == Extent::kEmpty ? ObstacleShape::kSphere : draw.any(ObstacleShape::kMesh);
  s.position = draw.position();
  s.velocity_mps = draw.velocity();
  s.state_time_s = draw.time();
  s.valid_until_s = extent == Extent::kFull ? 1e9 : s.state_time_s + rng.uniform(0, 100);
  s.radius_m = draw.positive(1e4);
  s.height_m = draw.positive(1e4);
  s.size_m = {draw.positive(1e4), draw.positive(1e4), draw.positive(1e4)};
  s.yaw_rad = draw.in(-3.14, 3.14);
  s.margin_m = draw.in(0, 1e4);
  if (s.shape != ObstacleShape::kMesh) return;
  s.vertices.resize(draw.length(kMaxMeshVertices, 4));
  for (Vec3& v : s.vertices) v = {rng.uniform(-1e4, 1e4), rng.uniform(-1e4, 1e4), rng.uniform(-1e4, 1e4)};
}

void fill(VehicleState& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.vehicle_id = draw.id(),
       .time_s = draw.time(),
       .position = draw.position(),
       .velocity_mps = draw.velocity()};
  s.roll_rad = draw.in(-3.14, 3.14);
  s.pitch_rad = draw.in(-1.5, 1.5);
  s.yaw_rad = draw.in(-3.14, 3.14);
  s.mode = draw.any(VehicleMode::kDocked);
  s.docked_charger_id = s.mode == VehicleMode::kDocked ? std::max(1u, draw.id()) : 0;
  s.path_revision = draw.id();
  s.coverage_revision = draw.id();
  s.leg_index = static_cast<std::uint32_t>(draw.length(kMaxLegs));
  s.legs_done = static_cast<std::uint32_t>(draw.length(kMaxLegs));
}

void fill(BatteryState& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.vehicle_id = draw.id(), .time_s = draw.time(), .capacity = draw.positive(1e9)};
  s.energy = draw.in(0, s.capacity);
  s.power = draw.in(-1e6, 1e6);
  s.health = draw.in(0, 1);
}

void fill(CoverageTask& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.task_id = draw.id(), .revision = draw.id(), .vehicle_id = draw.id(), .origin = draw.origin()};
  s.fields.resize(draw.length(kMaxFields, 1));
  for (Field& field : s.fields) field = {draw.id(), draw.positive(1e4)};
  fill_areas(s, draw, extent, rng);
  s.sensor_width_m = draw.positive(1e4);
  s.height_tolerance_m = draw.positive(1e4);
  s.height_band_m = draw.in(0, 1e4);
  s.neighbours = 1 + static_cast<std::uint32_t>(draw.length(20));
  s.vehicle = draw.limits();
  s.battery = {.capacity = draw.positive(1e9), .levels = 1 + static_cast<std::uint32_t>(draw.length(999))};
  s.battery.reserve = draw.in(0, s.battery.capacity);
  s.battery.charge_s_per_unit = draw.in(0, 1e6);
  s.battery.taper_from = draw.in(0, 1);
  s.battery.taper_end_rate = draw.in(1e-3, 1);
  fill_model(s.battery.model, draw);
  s.charger = {draw.id(), draw.in(0, 200), draw.time(), draw.time(), draw.position()};
  s.charger.has_battery = draw.coin();
  s.charger.battery = draw.robot_battery();
  s.charger.ground = {.kind = s.roads.empty() ? GroundKind::kOpen : draw.any(GroundKind::kRough),
                      .off_road_speed_mps = draw.in(0, 200),
                      .off_road_max_m = draw.in(0, 1e6),
                      .slope_max_rad = draw.in(0, 1.57),
                      .cell_m = draw.positive(1e4),
                      .area_min = {draw.in(-1e6, -1e3), draw.in(-1e6, -1e3)},
                      .area_max = {draw.in(0, 1e6), draw.in(0, 1e6)}};
  s.rules = {.overlap = draw.in(0, 0.9),
             .has_sweep = draw.coin(),
             .sweep_rad = draw.in(-3.14, 3.14),
             .headland = draw.any(HeadlandUse::kFly),
             .headland_m = draw.in(0, 1e4),
             .lines_beyond_borders = draw.coin(),
             .has_ceiling = draw.coin(),
             .ceiling_m = draw.positive(1e4)};
  s.start = draw.position();
  s.seed = draw.wide();
  s.has_terrain = draw.coin();
}

void fill(Goal& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.vehicle_id = draw.id(), .revision = draw.id(), .origin = draw.origin(), .start = draw.position()};
  s.position = draw.position();
  s.vehicle = draw.limits();
  s.bounds_min = {-1e6, -1e6, -1e3};
  s.bounds_max = {1e6, 1e6, 2e4};
  s.seed = draw.wide();
  s.has_terrain = draw.coin();
}

void fill(MissionClock& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {draw.time(), draw.in(0, 1e4), draw.any(ClockState::kEnded)};
}

void fill(CoveragePlan& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.task_id = draw.id(), .vehicle_id = draw.id(), .revision = draw.id()};
  s.basis = {draw.id(), draw.id(), draw.time(), draw.in(0, 1e9), draw.time()};
  s.cost = draw.in(0, 1e15);
  s.makespan_s = draw.time();
  s.field_area_m2 = draw.in(0, 1e15);
  s.complete = draw.coin();
  s.reason = draw.text(128);
  s.legs.resize(draw.length(kMaxLegs));
  s.legs_done = static_cast<std::uint32_t>(s.legs.size() / 3);
  double time_s = 0.0;
  for (std::size_t i = 0; i < s.legs.size(); ++i) {
    Leg& leg = s.legs[i];
    leg = {.sub_cell_id = draw.id(), .kind = draw.any(LegKind::kReposition), .entry = draw.position()};
    leg.exit = leg.kind == LegKind::kReposition ? leg.entry : draw.position();
    leg.height_m = draw.in(0, 1e4);
    leg.transfer = i + 1 < s.legs.size() ? static_cast<Transfer>(rng.below(5)) : Transfer::kEnd;
    leg.energy_before = draw.in(0, 1e9);
    leg.energy_after = draw.in(0, 1e9);
    leg.start_s = time_s;
    leg.end_s = time_s += rng.uniform(0, 100);
    leg.first_bend = static_cast<std::uint32_t>(s.bends.size());
    leg.bend_count =
        draw_bends(s.bends, extent == Extent::kFull ? 2 : static_cast<std::uint32_t>(rng.below(3)), draw);
  }
}

void fill(ChargerPlan& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.charger_id = draw.id(), .task_id = draw.id(), .vehicle_id = draw.id(), .revision = draw.id()};
  s.speed_mps = draw.in(0, 200);
  s.charge_s_per_unit = draw.in(0, 1e6);
  s.taper_from = draw.in(0, 1);
  s.taper_end_rate = draw.in(1e-3, 1);
  s.landing_s = draw.time();
  s.take_off_s = draw.time();
  s.start = draw.position();
  s.has_battery = extent == Extent::kFull || draw.coin();
  s.battery = draw.robot_battery();
  s.home_speed_mps = draw.in(0, 200);
  if (extent != Extent::kFull)
    s.home_bend_count = draw_bends(s.bends, static_cast<std::uint32_t>(rng.below(3)), draw);
  s.rendezvous.resize(draw.length(kMaxRendezvous));
  std::uint32_t id = 0;
  for (Rendezvous& r : s.rendezvous) {
    r = {.rendezvous_id = id += 1 + static_cast<std::uint32_t>(rng.below(5)), .site = draw.position()};
    r.arrive_by_s = rng.uniform(0, 5e6);
    r.depart_s = r.arrive_by_s + rng.uniform(0, 5e6);
    r.charge_to = draw.in(0, 1e9);
    if (s.has_battery && extent != Extent::kFull) r.kind = draw.any(StopKind::kDepot);
    r.carry = r.kind == StopKind::kMeeting && draw.coin();
    r.robot_energy = draw.in(0, 1e9);
    r.robot_energy_left = draw.in(0, 1e9);
    r.home_speed_mps = draw.in(0, 200);
    r.carry_to = draw.position();
    r.speed_mps = draw.in(0, 200);
    r.carry_speed_mps = draw.in(0, 200);
    const bool full = extent == Extent::kFull;
    r.first_bend = static_cast<std::uint32_t>(s.bends.size());
    r.bend_count = draw_bends(s.bends, full ? 4 : static_cast<std::uint32_t>(rng.below(3)), draw);
    r.carry_first_bend = static_cast<std::uint32_t>(s.bends.size());
    r.carry_bend_count = draw_bends(s.bends, full ? 2 : static_cast<std::uint32_t>(rng.below(3)), draw);
    r.home_first_bend = static_cast<std::uint32_t>(s.bends.size());
    r.home_bend_count = draw_bends(s.bends, full ? 2 : static_cast<std::uint32_t>(rng.below(3)), draw);
  }
}

void fill(PathPlan& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.vehicle_id = draw.id(), .revision = draw.id()};
  s.basis = {draw.id(), draw.id(), draw.id(), draw.id(), draw.time()};
  s.waypoints.resize(draw.length(kMaxWaypoints));
  s.verdict = s.waypoints.empty() ? PathVerdict::kNoSafePath : draw.any(PathVerdict::kNoSafePath);
  s.reason = draw.text(128);
  s.lands = draw.coin();
  s.length_m = draw.in(0, 1e9);
  s.duration_s = draw.time();
  s.clearance_min_m = draw.in(-1e6, 1e6);
  s.replan_ms = draw.in(0, 1e6);
  double time_s = 0.0;
  for (TimedWaypoint& w : s.waypoints) {
    w = {time_s, draw.position(), draw.any(PathPhase::kLanding), draw.id()};
    time_s += rng.uniform(0, 100);
  }
}

void fill(ChargerState& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.charger_id = draw.id(),
       .time_s = draw.time(),
       .position = draw.position(),
       .speed_mps = draw.in(0, 200)};
  s.docked_vehicle_id = std::max(1u, draw.id());
  s.charge_rate = draw.in(0, 1e6);
  s.energy_delivered = draw.in(0, 1e9);
  s.activity = draw.any(ChargerActivity::kRefilling);
  s.rendezvous_id = draw.id();
  s.rendezvous_done = draw.id();
  s.plan_revision = draw.id();
  s.energy = draw.in(0, 1e9);
}

void fill(ParticipantStatus& s, Extent extent, Rng& rng) {
  Draw draw(extent, rng);
  s = {.participant_id = draw.id(),
       .name = draw.text(32),
       .health = draw.any(Health::kFailed),
       .accepted = draw.wide()};
  s.rejected.resize(draw.length(kMaxRejections));
  for (Rejection& r : s.rejected) r = {draw.text(32), draw.text(64), draw.wide()};
  s.missed_deadlines = draw.wide();
  s.incompatible_qos = draw.wide();
  s.replans = draw.wide();
  s.latency_p50_ms = draw.in(0, 1e6);
  s.latency_p99_ms = draw.in(0, 1e6);
  s.latency_max_ms = draw.in(0, 1e6);
  s.message = draw.text(256);
}

}  // namespace swallowtail::testing
