#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "charger/participant/charger_participant.hpp"
#include "qos/memory/bus.hpp"

namespace swallowtail::charger {
namespace {

using data::ChargerActivity;

data::ChargerPlan plan_to(const data::Vec3& site, std::uint32_t revision = 1) {
  data::ChargerPlan plan;
  plan.charger_id = 1;
  plan.task_id = 1;
  plan.vehicle_id = 5;
  plan.revision = revision;
  plan.speed_mps = 2.0;
  plan.charge_s_per_unit = 1.0;
  plan.start = {10, 0, 0};
  plan.rendezvous.push_back({.rendezvous_id = 1,
                             .site = site,
                             .arrive_by_s = 100,
                             .depart_s = 200,
                             .charge_to = 50,
                             .carry = false,
                             .carry_to = {}});
  return plan;
}

class ChargerParticipantTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(other_->subscribe<data::ChargerState>(
        {.on_sample = [this](const data::ChargerState& state) { states_.push_back(state); }}));
    ASSERT_TRUE(other_->subscribe<data::ParticipantStatus>(
        {.on_sample = [this](const data::ParticipantStatus& status) { status_ = status; }}));
    charger_ = ChargerParticipant::make(*bus_, wall_, {.charger_id = 1}).value();
    plans_ = other_->publisher<data::ChargerPlan>().value();
    clocks_ = other_->publisher<data::MissionClock>().value();
    vehicles_ = other_->publisher<data::VehicleState>().value();
    batteries_ = other_->publisher<data::BatteryState>().value();
  }

  void run(double wall_s, double rate = 1.0) {
    for (double t = 0.0; t < wall_s - 1e-9; t += 0.02) {
      ASSERT_TRUE(
          clocks_->publish({.time_s = mission_s_, .rate = rate, .state = data::ClockState::kRunning}));
      ASSERT_TRUE(charger_->step());
      wall_.advance(0.02);
      mission_s_ += 0.02 * rate;
    }
  }

  std::uint64_t rejections(const std::string& reason) const {
    std::uint64_t count = 0;
    for (const auto& r : bus_->statistics().rejected) count += r.reason == reason ? r.count : 0;
    return count;
  }

  ManualClock wall_;
  double mission_s_ = 0.0;
  MemoryNetwork network_;
  std::unique_ptr<Bus> bus_ = network_.make_bus();
  std::unique_ptr<Bus> other_ = network_.make_bus();
  std::vector<data::ChargerState> states_;
  std::optional<data::ParticipantStatus> status_;
  std::unique_ptr<ChargerParticipant> charger_;
  std::unique_ptr<Publisher<data::ChargerPlan>> plans_;
  std::unique_ptr<Publisher<data::MissionClock>> clocks_;
  std::unique_ptr<Publisher<data::VehicleState>> vehicles_;
  std::unique_ptr<Publisher<data::BatteryState>> batteries_;
};

TEST_F(ChargerParticipantTest, IsReadyButSilentBeforeAPlan) {
  run(1.0);
  ASSERT_TRUE(status_);
  EXPECT_EQ(status_->participant_id, data::kChargerId);
  EXPECT_EQ(status_->health, data::Health::kReady);
  EXPECT_TRUE(states_.empty());
}

TEST_F(ChargerParticipantTest, DrivesByMissionTimeAndTellsItsStateAtFiftyHertz) {
  ASSERT_TRUE(plans_->publish(plan_to({90, 0, 0})));
  run(1.0, 20.0);
  EXPECT_NEAR(static_cast<double>(states_.size()), 50.0, 3.0);
  EXPECT_EQ(states_.back().activity, ChargerActivity::kDriving);
  EXPECT_NEAR(states_.back().position.x_m, 10.0 + 2.0 * 20.0, 3.0);
  run(2.0, 20.0);
  EXPECT_EQ(states_.back().activity, ChargerActivity::kWaiting);
  EXPECT_NEAR(states_.back().position.x_m, 90.0, 1e-6);
}

TEST_F(ChargerParticipantTest, StartsWhereItIsWhenItComesLate) {
  mission_s_ = 500.0;
  run(0.1);
  ASSERT_TRUE(plans_->publish(plan_to({90, 0, 0})));
  run(0.1);
  EXPECT_LT(states_.back().position.x_m, 11.0) << "it has not been driving for 500 s";
}

TEST_F(ChargerParticipantTest, StartsAnewWithTheMissionClock) {
  ASSERT_TRUE(plans_->publish(plan_to({90, 0, 0})));
  run(2.0, 20.0);
  EXPECT_GT(states_.back().position.x_m, 50.0);
  mission_s_ = 0.0;
  run(0.1, 20.0);
  EXPECT_LT(states_.back().position.x_m, 20.0);
}

TEST_F(ChargerParticipantTest, CountsStrangers) {
  data::ChargerPlan other = plan_to({90, 0, 0});
  other.charger_id = 2;
  ASSERT_TRUE(plans_->publish(other));
  ASSERT_TRUE(plans_->publish(plan_to({90, 0, 0})));
  run(0.1);
  data::VehicleState vehicle;
  vehicle.vehicle_id = 6;
  ASSERT_TRUE(vehicles_->publish(vehicle));
  data::BatteryState battery;
  battery.vehicle_id = 6;
  battery.capacity = 1.0;
  ASSERT_TRUE(batteries_->publish(battery));
  run(0.1);
  EXPECT_EQ(rejections("unknown charger"), 1U);
  EXPECT_EQ(rejections("unknown vehicle"), 2U);
}

TEST_F(ChargerParticipantTest, RefusesABatteryOfAnotherCapacity) {
  ASSERT_TRUE(plans_->publish(plan_to({90, 0, 0})));
  run(0.1);
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .energy = 40, .capacity = 100}));
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .energy = 600, .capacity = 1200}));
  run(0.1);
  EXPECT_EQ(rejections("another capacity"), 1u);
}

/// Before it has flown a leg nothing else tells that the aircraft is another one.
TEST_F(ChargerParticipantTest, TakesAnotherCapacityOnceTheOneBeforeIsSilent) {
  ASSERT_TRUE(plans_->publish(plan_to({90, 0, 0})));
  run(0.1);
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .time_s = 10, .energy = 40, .capacity = 100}));
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .time_s = 12, .energy = 30, .capacity = 80}));
  EXPECT_EQ(rejections("another capacity"), 1u);
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .time_s = 15.5, .energy = 30, .capacity = 80}));
  EXPECT_EQ(rejections("another capacity"), 1u);
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .time_s = 16, .energy = 40, .capacity = 100}));
  EXPECT_EQ(rejections("another capacity"), 2u);
}

TEST_F(ChargerParticipantTest, AnotherAircraftHasABatteryOfItsOwn) {
  ASSERT_TRUE(plans_->publish(plan_to({90, 0, 0})));
  run(0.1);
  data::VehicleState vehicle;
  vehicle.vehicle_id = 5;
  vehicle.time_s = 10;
  vehicle.legs_done = 3;
  ASSERT_TRUE(vehicles_->publish(vehicle));
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .time_s = 10, .energy = 40, .capacity = 100}));
  vehicle.time_s = 20;
  vehicle.legs_done = 0;
  ASSERT_TRUE(vehicles_->publish(vehicle));
  // A state of the one before that comes late does not make its capacity known again.
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .time_s = 19, .energy = 40, .capacity = 100}));
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .time_s = 21, .energy = 70, .capacity = 80}));
  run(0.1);
  EXPECT_EQ(rejections("another capacity"), 0u);
  ASSERT_TRUE(batteries_->publish({.vehicle_id = 5, .time_s = 22, .energy = 70, .capacity = 100}));
  EXPECT_EQ(rejections("another capacity"), 1u);
}

TEST_F(ChargerParticipantTest, TellsWhatItsOwnBatteryHolds) {
  data::ChargerPlan plan = plan_to({90, 0, 0});
  plan.has_battery = true;
  plan.battery = {.capacity = 100, .reserve = 10, .drive_per_s = 2.0, .per_charged = 1.0, .refill_s = 5};
  plan.home_speed_mps = 2.0;
  plan.rendezvous[0].home_speed_mps = 2.0;
  ASSERT_TRUE(plans_->publish(plan));
  run(2.0, 5.0);
  ASSERT_FALSE(states_.empty());
  const double driven_s = (states_.back().position.x_m - 10.0) / 2.0;
  EXPECT_GT(driven_s, 8.0);
  EXPECT_NEAR(states_.back().energy, 100.0 - 2.0 * driven_s, 1e-6);
}

TEST_F(ChargerParticipantTest, RefusesOrdersThatItCannotFollow) {
  ASSERT_TRUE(plans_->publish(plan_to({90, 0, 0})));
  run(0.1);
  data::ChargerPlan still = plan_to({10, 90, 0}, 2);
  still.charge_s_per_unit = 0.0;
  ASSERT_TRUE(plans_->publish(still));
  run(0.1);
  EXPECT_EQ(rejections("orders out of range"), 1U);
  EXPECT_EQ(states_.back().plan_revision, 1U);
}

TEST_F(ChargerParticipantTest, TakesTheVehicleOnBoardAndSaysSoAtOnce) {
  ASSERT_TRUE(plans_->publish(plan_to({10, 0, 0})));
  data::VehicleState vehicle;
  vehicle.vehicle_id = 5;
  vehicle.mode = data::VehicleMode::kLanding;
  ASSERT_TRUE(vehicles_->publish(vehicle));
  data::BatteryState battery;
  battery.vehicle_id = 5;
  battery.energy = 20;
  battery.capacity = 100;
  ASSERT_TRUE(batteries_->publish(battery));
  run(0.1);
  vehicle.mode = data::VehicleMode::kLanded;
  vehicle.position = {10.2, 0, 0};
  vehicle.legs_done = 1;
  ASSERT_TRUE(vehicles_->publish(vehicle));
  run(0.1);
  EXPECT_EQ(states_.back().activity, ChargerActivity::kCharging);
  EXPECT_EQ(states_.back().docked_vehicle_id, 5U);
  EXPECT_NEAR(states_.back().charge_rate, 1.0, 1e-9);
}

}  // namespace
}  // namespace swallowtail::charger
