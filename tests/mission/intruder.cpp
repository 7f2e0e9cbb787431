#include "tests/mission/intruder.hpp"

#include <limits>

#include "tests/interop/raw_writer.hpp"

namespace swallowtail::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kOurs = 1;  ///< id of the mission's vehicle, robot and task
constexpr std::uint32_t kStranger = 99;
constexpr double kAboveTheTask = 600.0;  ///< units; two_heights.yaml has 300

data::Obstacle obstacle(std::uint32_t id, double x_m, double radius_m) {
  data::Obstacle sample;
  sample.obstacle_id = id;
  sample.position = {x_m, 92.0, 12.0};
  sample.radius_m = radius_m;
  return sample;
}

data::VehicleState vehicle(std::uint32_t id, double x_m) {
  data::VehicleState sample;
  sample.vehicle_id = id;
  sample.time_s = 1.0;
  sample.position = {x_m, 92.0, 12.0};
  sample.mode = data::VehicleMode::kCovering;
  return sample;
}

data::BatteryState battery(std::uint32_t id, double energy, double capacity) {
  return {.vehicle_id = id, .time_s = 1.0, .energy = energy, .capacity = capacity};
}

data::CoverageTask bow_tie() {
  data::CoverageTask sample;
  sample.task_id = kOurs;
  sample.revision = 1000;
  sample.vehicle_id = kOurs;
  sample.fields = {{.field_id = 1, .height_m = 12.0}};
  sample.points = {{0, 0}, {100, 100}, {100, 0}, {0, 100}};
  sample.rings = {{.area_index = 0, .first_point = 0, .point_count = 4, .is_hole = false}};
  return sample;
}

data::TerrainTile short_tile() {
  data::TerrainTile sample;
  sample.map_rows = sample.map_cols = sample.tile_rows = sample.tile_cols = 10;
  sample.elevation_m.assign(99, 0.0F);
  return sample;
}

data::ChargerState charger(double x_m) {
  data::ChargerState sample;
  sample.charger_id = kOurs;
  sample.time_s = 1.0;
  sample.position = {x_m, 0.0, 0.0};
  return sample;
}

}  // namespace

struct Intruder::Writers {
  explicit Writers(std::shared_ptr<fast::Participant> p)
      : obstacles(p), vehicles(p), batteries(p), tasks(p), tiles(p), chargers(p) {}
  RawWriter<data::Obstacle> obstacles;
  RawWriter<data::VehicleState> vehicles;
  RawWriter<data::BatteryState> batteries;
  RawWriter<data::CoverageTask> tasks;
  RawWriter<data::TerrainTile> tiles;
  RawWriter<data::ChargerState> chargers;
};

Intruder::Intruder(std::uint32_t domain)
    : writers_(std::make_unique<Writers>(std::shared_ptr<fast::Participant>(
          fast::Participant::create({.domain = domain, .participant_name = "intruder"}).value()))) {}

Intruder::~Intruder() = default;

void Intruder::write_all() {
  writers_->obstacles.write(obstacle(9001, kNan, 5.0));
  writers_->obstacles.write(obstacle(9002, 60.0, -5.0));
  writers_->vehicles.write(vehicle(kOurs, kNan));
  writers_->vehicles.write(vehicle(kStranger, 60.0));
  writers_->batteries.write(battery(kOurs, 1.01 * kAboveTheTask, kAboveTheTask));
  writers_->batteries.write(battery(kStranger, 10.0, 300.0));
  writers_->tasks.write(bow_tie());
  writers_->tiles.write(short_tile());
  writers_->chargers.write(charger(kNan));
}

void Intruder::write_battery_above_the_task() {
  writers_->batteries.write(battery(kOurs, kAboveTheTask, 2.0 * kAboveTheTask));
}

bool Intruder::is_heard_by_the_recorder() const {
  // Besides it: the planner; the participants that judge states, and the test itself; coverage and charger.
  return writers_->obstacles.readers() >= 2 && writers_->vehicles.readers() >= 5 &&
         writers_->batteries.readers() >= 3;
}

std::vector<Refusal> Intruder::expected() {
  using enum data::ParticipantId;
  const std::string nowhere = "position out of range";
  const std::string stranger = "unknown vehicle";
  return {{kPlannerId, "Obstacle", nowhere},
          {kPlannerId, "Obstacle", "radius out of range"},
          {kPlannerId, "VehicleState", nowhere},
          {kCoverageId, "VehicleState", nowhere},
          {kChargerId, "VehicleState", nowhere},
          {kPlannerId, "VehicleState", stranger},
          {kCoverageId, "VehicleState", stranger},
          {kChargerId, "VehicleState", stranger},
          {kCoverageId, "BatteryState", "energy above capacity"},
          {kChargerId, "BatteryState", "energy above capacity"},
          {kCoverageId, "BatteryState", "energy above the task's capacity"},
          {kCoverageId, "BatteryState", stranger},
          {kChargerId, "BatteryState", stranger},
          {kPlannerId, "CoverageTask", "ring crosses itself"},
          {kCoverageId, "CoverageTask", "ring crosses itself"},
          {kPlannerId, "TerrainTile", "tile size differs from its elevations"},
          {kCoverageId, "TerrainTile", "tile size differs from its elevations"},
          {kPlannerId, "ChargerState", nowhere},
          {kCoverageId, "ChargerState", nowhere},
          {kSimulatorId, "ChargerState", nowhere}};
}

}  // namespace swallowtail::testing
