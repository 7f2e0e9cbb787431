#include "coverage/participant/coverage_participant.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "idl/data/validate.hpp"
#include "qos/memory/bus.hpp"

namespace swallowtail::coverage {
namespace {

data::CoverageTask square_task() {
  data::CoverageTask task;
  task.task_id = 3;
  task.vehicle_id = 5;
  task.charger.charger_id = 2;
  task.fields.push_back({.field_id = 1, .height_m = 20.0});
  task.rings.push_back({.area_index = 0, .first_point = 0, .point_count = 4, .is_hole = false});
  task.points = {{0, 0}, {100, 0}, {100, 60}, {0, 60}};
  task.sensor_width_m = 10.0;
  task.battery.capacity = 120.0;
  task.battery.reserve = 10.0;
  task.start = {-10, -10, 0};
  return task;
}

data::TerrainTile level_tile(float elevation_m, std::uint32_t row) {
  data::TerrainTile tile;
  tile.row = row;
  tile.origin_x_m = -50;
  tile.origin_y_m = -50;
  tile.cell_size_m = 50;
  tile.map_rows = 4;
  tile.map_cols = 5;
  tile.first_row = 2 * row;
  tile.tile_rows = 2;
  tile.tile_cols = 5;
  tile.elevation_m.assign(10, elevation_m);
  return tile;
}

class CoverageParticipantTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(other_->subscribe<data::CoveragePlan>(
        {.on_sample = [this](const data::CoveragePlan& p) { plans_.push_back(p); }}));
    ASSERT_TRUE(other_->subscribe<data::ChargerPlan>(
        {.on_sample = [this](const data::ChargerPlan& p) { charger_plans_.push_back(p); }}));
    ASSERT_TRUE(other_->subscribe<data::ParticipantStatus>(
        {.on_sample = [this](const data::ParticipantStatus& s) { status_ = s; }}));
    tasks_ = other_->publisher<data::CoverageTask>().value();
    tiles_ = other_->publisher<data::TerrainTile>().value();
    vehicles_ = other_->publisher<data::VehicleState>().value();
    batteries_ = other_->publisher<data::BatteryState>().value();
    start();
  }

  void start() { coverage_ = CoverageParticipant::make(*bus_, wall_, {}).value(); }
  void step(int times = 1) {
    for (int i = 0; i < times; ++i) {
      ASSERT_TRUE(coverage_->step());
      wall_.advance(0.02);
    }
  }
  std::uint64_t rejections(const std::string& reason) const {
    std::uint64_t count = 0;
    for (const auto& r : bus_->statistics().rejected) count += r.reason == reason ? r.count : 0;
    return count;
  }
  data::VehicleState aloft(double time_s, const data::Vec3& at, std::uint32_t leg) const {
    data::VehicleState state;
    state.vehicle_id = 5;
    state.time_s = time_s;
    state.position = at;
    state.mode = data::VehicleMode::kCovering;
    state.leg_index = leg;
    state.legs_done = leg;
    return state;
  }

  ManualClock wall_;
  MemoryNetwork network_;
  std::unique_ptr<Bus> bus_ = network_.make_bus();
  std::unique_ptr<Bus> other_ = network_.make_bus();
  std::unique_ptr<CoverageParticipant> coverage_;
  std::unique_ptr<Publisher<data::CoverageTask>> tasks_;
  std::unique_ptr<Publisher<data::TerrainTile>> tiles_;
  std::unique_ptr<Publisher<data::VehicleState>> vehicles_;
  std::unique_ptr<Publisher<data::BatteryState>> batteries_;
  std::vector<data::CoveragePlan> plans_;
  std::vector<data::ChargerPlan> charger_plans_;
  std::optional<data::ParticipantStatus> status_;
};

TEST_F(CoverageParticipantTest, PlansATaskAndTellsTheRobotOnce) {
  ASSERT_TRUE(tasks_->publish(square_task()));
  step(10);
  ASSERT_EQ(plans_.size(), 1U);
  ASSERT_EQ(charger_plans_.size(), 1U);
  const data::CoveragePlan& plan = plans_.front();
  EXPECT_EQ(plan.task_id, 3U);
  EXPECT_EQ(plan.vehicle_id, 5U);
  EXPECT_EQ(plan.revision, 1U);
  EXPECT_EQ(plan.legs.size(), 6U);
  EXPECT_TRUE(plan.complete);
  EXPECT_NEAR(plan.field_area_m2, 6000.0, 1e-6);
  EXPECT_FALSE(data::validate(plan));
  EXPECT_EQ(plan.legs.back().transfer, data::Transfer::kEnd);
  EXPECT_EQ(charger_plans_.front().revision, 1U);
  EXPECT_EQ(charger_plans_.front().charger_id, 2U);
  EXPECT_FALSE(charger_plans_.front().rendezvous.empty());
  EXPECT_FALSE(data::validate(charger_plans_.front()));
}

TEST_F(CoverageParticipantTest, WaitsForEveryTileOfTheTerrainAndFliesAboveIt) {
  data::CoverageTask task = square_task();
  task.has_terrain = true;
  ASSERT_TRUE(tasks_->publish(task));
  ASSERT_TRUE(tiles_->publish(level_tile(30.0F, 0)));
  step(5);
  EXPECT_TRUE(plans_.empty());
  ASSERT_TRUE(tiles_->publish(level_tile(30.0F, 1)));
  step(2);
  ASSERT_EQ(plans_.size(), 1U);
  for (const data::Leg& leg : plans_.front().legs) EXPECT_NEAR(leg.entry.z_m, 50.0, 1e-6);
  EXPECT_EQ(plans_.front().basis.terrain_revision, 1U);
}

TEST_F(CoverageParticipantTest, RefusesWhatDoesNotFitAndChangesNothing) {
  ASSERT_TRUE(tasks_->publish(square_task()));
  step();
  ASSERT_EQ(plans_.size(), 1U);
  data::CoverageTask holed = square_task();
  holed.revision = 2;
  holed.rings.push_back({.area_index = 0, .first_point = 4, .point_count = 3, .is_hole = true});
  holed.points.insert(holed.points.end(), {{500, 500}, {510, 500}, {505, 510}});
  ASSERT_TRUE(tasks_->publish(holed));
  step();
  EXPECT_EQ(rejections("field polygon not valid"), 1U);
  data::VehicleState stranger = aloft(1.0, {0, 0, 20}, 0);
  stranger.vehicle_id = 9;
  ASSERT_TRUE(vehicles_->publish(stranger));
  data::BatteryState battery;
  battery.vehicle_id = 5;
  battery.energy = 400.0;
  battery.capacity = 500.0;
  ASSERT_TRUE(batteries_->publish(battery));
  step(3);
  EXPECT_EQ(rejections("unknown vehicle"), 1U);
  EXPECT_EQ(rejections("energy above the task's capacity"), 1U);
  EXPECT_EQ(plans_.size(), 1U);
}

TEST_F(CoverageParticipantTest, ANewRevisionOfTheTaskIsPlannedAfreshBeforeTheFlightAndTakenUpLater) {
  ASSERT_TRUE(tasks_->publish(square_task()));
  step();
  data::CoverageTask wider = square_task();
  wider.revision = 2;
  wider.sensor_width_m = 20.0;
  ASSERT_TRUE(tasks_->publish(wider));
  step();
  ASSERT_EQ(plans_.size(), 2U);
  EXPECT_EQ(plans_.back().revision, 2U);
  EXPECT_EQ(plans_.back().legs.size(), 3U);
  ASSERT_TRUE(vehicles_->publish(aloft(30.0, plans_.back().legs[1].entry, 1)));
  step();
  const data::Leg flown = plans_.back().legs[0];
  wider.revision = 3;
  for (data::Point2& point : wider.points) point.x_m *= 1.5;
  ASSERT_TRUE(tasks_->publish(wider));
  step();
  ASSERT_EQ(plans_.size(), 3U);
  EXPECT_EQ(plans_.back().legs[0].exit, flown.exit);
  EXPECT_EQ(plans_.back().basis.task_revision, 3U);
  EXPECT_NE(plans_.back().reason.find("fields were changed"), std::string::npos) << plans_.back().reason;
  data::CoverageTask other = wider;
  other.task_id = wider.task_id + 1;
  ASSERT_TRUE(tasks_->publish(other));
  step();
  EXPECT_EQ(plans_.size(), 3U);
  EXPECT_EQ(rejections("a mission is under way"), 1U);
}

TEST_F(CoverageParticipantTest, ALossOfEnergyBringsANewRevisionWithTheFlownLegsUntouched) {
  ASSERT_TRUE(tasks_->publish(square_task()));
  step();
  ASSERT_EQ(plans_.size(), 1U);
  const data::CoveragePlan first = plans_.front();
  const data::Vec3 entry = first.legs[1].entry;
  const data::Vec3 exit = first.legs[1].exit;
  const data::Vec3 middle{(entry.x_m + exit.x_m) / 2, (entry.y_m + exit.y_m) / 2, entry.z_m};
  ASSERT_TRUE(vehicles_->publish(aloft(40.0, middle, 1)));
  data::BatteryState battery;
  battery.vehicle_id = 5;
  battery.time_s = 40.0;
  battery.energy = 30.0;
  battery.capacity = 120.0;
  ASSERT_TRUE(batteries_->publish(battery));
  step(3);
  ASSERT_EQ(plans_.size(), 2U);
  const data::CoveragePlan& second = plans_.back();
  EXPECT_EQ(second.revision, 2U);
  EXPECT_EQ(second.legs_done, 1U);
  EXPECT_EQ(second.legs[0].exit, first.legs[0].exit);
  EXPECT_FALSE(second.reason.empty());
  EXPECT_FALSE(data::validate(second));
  EXPECT_FALSE(data::validate(charger_plans_.back()));
  EXPECT_EQ(charger_plans_.back().revision, 2U);
  EXPECT_NE(second.legs[1].transfer, data::Transfer::kFF) << "it must land soon";
}

TEST_F(CoverageParticipantTest, AfterARestartThePlanIsAboveTheOneThatIsFlown) {
  data::VehicleState state = aloft(50.0, {50, 30, 20}, 2);
  state.coverage_revision = 4;
  ASSERT_TRUE(vehicles_->publish(state));
  step();
  ASSERT_TRUE(tasks_->publish(square_task()));
  step();
  ASSERT_EQ(plans_.size(), 1U);
  EXPECT_GT(plans_.front().revision, 4U);
  EXPECT_EQ(plans_.front().legs_done, 2U);
  int covers = 0;
  for (const data::Leg& leg : plans_.front().legs) covers += leg.kind == data::LegKind::kCover ? 1 : 0;
  EXPECT_EQ(covers, 6) << "what was flown is not known: all is flown";
  EXPECT_FALSE(data::validate(plans_.front()));
}

TEST_F(CoverageParticipantTest, AfterARestartItGoesOnWithThePlanFromTheWire) {
  ASSERT_TRUE(tasks_->publish(square_task()));
  step();
  ASSERT_TRUE(vehicles_->publish(aloft(40.0, plans_.front().legs[1].entry, 1)));
  step();
  const data::CoveragePlan before = plans_.back();
  coverage_.reset();
  start();
  step(3);
  ASSERT_FALSE(plans_.empty());
  EXPECT_EQ(plans_.back().revision, before.revision);
  EXPECT_EQ(plans_.back().legs, before.legs) << "nothing has happened since";
  ASSERT_TRUE(vehicles_->publish(aloft(60.0, before.legs[2].entry, 2)));
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .time_s = 60.0, .energy = 30.0, .capacity = 120.0}));
  step(3);
  const data::CoveragePlan& after = plans_.back();
  EXPECT_GT(after.revision, before.revision);
  EXPECT_EQ(after.legs_done, 2U);
  EXPECT_EQ(after.legs[1].exit, before.legs[1].exit);
  EXPECT_NE(after.reason.find("energy"), std::string::npos) << after.reason;
}

TEST_F(CoverageParticipantTest, AnotherAircraftFliesWhatTheFirstOneLeft) {
  ASSERT_TRUE(tasks_->publish(square_task()));
  step();
  ASSERT_TRUE(vehicles_->publish(aloft(40.0, plans_.front().legs[2].entry, 2)));
  step();
  data::VehicleState other = aloft(90.0, square_task().start, 0);
  other.mode = data::VehicleMode::kLanded;
  ASSERT_TRUE(vehicles_->publish(other));
  step();
  ASSERT_GE(plans_.size(), 2U);
  const data::CoveragePlan& after = plans_.back();
  EXPECT_NE(after.reason.find("another aircraft"), std::string::npos) << after.reason;
  EXPECT_EQ(after.legs_done, 0U);
  EXPECT_LE(after.legs.size(), plans_.front().legs.size() - 2);
  EXPECT_FALSE(data::validate(after));
  EXPECT_FALSE(data::validate(charger_plans_.back()));
}

}  // namespace
}  // namespace swallowtail::coverage
