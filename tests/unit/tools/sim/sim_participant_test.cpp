#include "tools/sim/sim_participant.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "charger/participant/charger_participant.hpp"
#include "path_fixture.hpp"
#include "qos/memory/bus.hpp"
#include "scenario_fixture.hpp"

namespace swallowtail::sim {
namespace {

using data::VehicleMode;

/// A network with the simulator, a real charger, and a scripted rest: coverage with two strips and a recharge
/// between them, and a planner that flies them.
class SimParticipantTest : public testing::Test {
 protected:
  void start(const std::string& more = {}, SimOptions options = {}) {
    options.on_progress = [this](const std::string& line) { lines_.push_back(line); };
    subscribe();
    auto made = SimParticipant::make(*sim_bus_, clock_, scenario_with(more), std::move(options));
    ASSERT_TRUE(made.ok()) << made.error().message;
    sim_ = std::move(made).value();
    charger_ = charger::ChargerParticipant::make(*charger_bus_, clock_, {.charger_id = 1}).value();
    coverage_plans_ = other_bus_->publisher<data::CoveragePlan>().value();
    charger_plans_ = other_bus_->publisher<data::ChargerPlan>().value();
    path_plans_ = other_bus_->publisher<data::PathPlan>().value();
    statuses_ = other_bus_->publisher<data::ParticipantStatus>().value();
  }

  void subscribe() {
    const auto keep = [this](auto type, auto& last) {
      using T = decltype(type);
      ASSERT_TRUE(other_bus_->subscribe<T>({.on_sample = [&last](const T& sample) { last = sample; }}));
    };
    keep(data::VehicleState{}, vehicle_);
    keep(data::BatteryState{}, battery_);
    keep(data::MissionClock{}, mission_clock_);
    keep(data::ChargerState{}, charger_state_);
    keep(data::CoverageTask{}, task_);
    ASSERT_TRUE(other_bus_->subscribe<data::Obstacle>(
        {.on_sample = [this](const data::Obstacle& o) { obstacles_[o.obstacle_id] = o; },
         .on_gone = [this](const InstanceKey& key) { obstacles_.erase(key[0]); }}));
  }

  /// Steps everything for so much wall time; false once the simulator is done.
  bool run(double wall_s) {
    for (double t = 0.0; t < wall_s - 1e-9; t += 0.005) {
      clock_.advance(0.005);
      const auto more = sim_->step();
      EXPECT_TRUE(more.ok()) << more.error().message;
      EXPECT_TRUE(charger_->step());
      if (!more.ok() || !*more) return false;
    }
    return true;
  }

  void publish_plans() {
    data::CoveragePlan plan = plan_of({strip({0, 5, 20}, {100, 5, 20}), strip({100, 15, 20}, {0, 15, 20})});
    plan.legs[0].transfer = data::Transfer::kFDUF;
    ASSERT_TRUE(coverage_plans_->publish(plan));
    data::ChargerPlan meetings;
    meetings.charger_id = 1;
    meetings.task_id = 1;
    meetings.vehicle_id = 1;
    meetings.revision = 1;
    meetings.speed_mps = 3.0;
    meetings.charge_s_per_unit = 0.5;
    meetings.landing_s = 2.0;
    meetings.take_off_s = 2.0;
    meetings.start = {-20, 5, 0};
    meetings.rendezvous.push_back({.rendezvous_id = 1,
                                   .site = {100, 5, 0},
                                   .arrive_by_s = 30,
                                   .depart_s = 60,
                                   .charge_to = 95,
                                   .carry = false,
                                   .carry_to = {}});
    ASSERT_TRUE(charger_plans_->publish(meetings));
  }

  data::PathPlan first_sortie(double time_s) {
    return PathBuilder(1, time_s, {-20, 5, 0})
        .to({-20, 5, 20}, 5.0, PathPhase::kTakeOff)
        .to({0, 5, 20}, 2.0, PathPhase::kTransfer)
        .to({100, 5, 20}, 10.0, PathPhase::kCover)
        .to({100, 5, 0}, 5.0, PathPhase::kLanding)
        .plan;
  }
  data::PathPlan second_sortie(double time_s) {
    return PathBuilder(2, time_s, {100, 5, 0})
        .to({100, 5, 20}, 5.0, PathPhase::kTakeOff, 1)
        .to({100, 15, 20}, 1.0, PathPhase::kTransfer, 1)
        .to({0, 15, 20}, 10.0, PathPhase::kCover, 1)
        .to({0, 15, 0}, 5.0, PathPhase::kLanding, 1)
        .plan;
  }

  ManualClock clock_;
  MemoryNetwork network_;
  std::unique_ptr<Bus> sim_bus_ = network_.make_bus();
  std::unique_ptr<Bus> charger_bus_ = network_.make_bus();
  std::unique_ptr<Bus> other_bus_ = network_.make_bus();
  std::optional<data::VehicleState> vehicle_;
  std::optional<data::BatteryState> battery_;
  std::optional<data::MissionClock> mission_clock_;
  std::optional<data::ChargerState> charger_state_;
  std::optional<data::CoverageTask> task_;
  std::map<std::uint32_t, data::Obstacle> obstacles_;
  std::vector<std::string> lines_;
  std::unique_ptr<SimParticipant> sim_;
  std::unique_ptr<charger::ChargerParticipant> charger_;
  std::unique_ptr<Publisher<data::CoveragePlan>> coverage_plans_;
  std::unique_ptr<Publisher<data::ChargerPlan>> charger_plans_;
  std::unique_ptr<Publisher<data::PathPlan>> path_plans_;
  std::unique_ptr<Publisher<data::ParticipantStatus>> statuses_;
};

TEST_F(SimParticipantTest, TellsTheWorldAndWaits) {
  start("obstacles:\n  - {id: 4, shape: sphere, center_m: [50, 200, 40], radius_m: 5}\n", {.await = {1, 3}});
  ASSERT_TRUE(run(0.2));
  ASSERT_TRUE(task_ && vehicle_ && battery_ && mission_clock_);
  EXPECT_EQ(obstacles_.size(), 1U);
  EXPECT_EQ(mission_clock_->state, data::ClockState::kWaiting);
  EXPECT_EQ(vehicle_->mode, VehicleMode::kLanded);
  EXPECT_EQ(vehicle_->position, (data::Vec3{-20, 5, 0}));
  EXPECT_EQ(battery_->energy, 100.0);
  publish_plans();
  ASSERT_TRUE(run(0.5));
  EXPECT_EQ(mission_clock_->state, data::ClockState::kWaiting) << "participant 1 is not there";
  data::ParticipantStatus status;
  status.participant_id = 1;
  status.health = data::Health::kReady;
  ASSERT_TRUE(statuses_->publish(status));
  ASSERT_TRUE(run(0.5));
  EXPECT_EQ(mission_clock_->state, data::ClockState::kRunning);
  EXPECT_GT(mission_clock_->time_s, 0.4);
}

TEST_F(SimParticipantTest, FliesAMissionWithARechargeAndEndsTheClock) {
  start("events:\n  - {at_s: 12, battery_loss: 30}\n", {.rate = 20.0});
  publish_plans();
  ASSERT_TRUE(run(0.1));
  ASSERT_TRUE(path_plans_->publish(first_sortie(mission_clock_->time_s + 3.0)));
  for (int i = 0; i < 1000 && charger_state_->activity != data::ChargerActivity::kReady; ++i)
    ASSERT_TRUE(run(0.05));
  ASSERT_EQ(charger_state_->activity, data::ChargerActivity::kReady);
  EXPECT_EQ(vehicle_->mode, VehicleMode::kDocked);
  EXPECT_EQ(vehicle_->docked_charger_id, 1U);
  EXPECT_EQ(vehicle_->legs_done, 1U);
  EXPECT_LE(sim_->simulation().battery()->energy(), 95.0);
  EXPECT_GE(sim_->simulation().battery()->energy(), 94.5);
  ASSERT_TRUE(path_plans_->publish(second_sortie(mission_clock_->time_s + 3.0)));
  for (int i = 0; i < 1000 && run(0.05); ++i) continue;
  EXPECT_EQ(mission_clock_->state, data::ClockState::kEnded);
  ASSERT_TRUE(sim_->simulation().outcome());
  EXPECT_TRUE(sim_->simulation().outcome()->completed) << sim_->simulation().outcome()->reason;
  const auto summary = nlohmann::json::parse(sim_->summary());
  EXPECT_EQ(summary["status"], "completed");
  EXPECT_EQ(summary["recharges"], 1);
  EXPECT_EQ(summary["violations"], 0);
  EXPECT_EQ(summary["covered_percent"], 100.0);
  EXPECT_EQ(summary["replans"], 2);
  EXPECT_EQ(summary["charger_activity"], "idle");
  EXPECT_GE(lines_.size(), 3U);
  EXPECT_EQ(sim_->slipped_s(), 0.0);
}

TEST_F(SimParticipantTest, PublishesAndDisposesObstaclesAsTheyCome) {
  start(
      "events:\n  - {at_s: 5, obstacle: {id: 9, shape: sphere, center_m: [50, 200, 30], radius_m: 12}}\n  - "
      "{at_s: 10, remove_obstacle: 9}\n",
      {.rate = 10.0});
  publish_plans();
  ASSERT_TRUE(run(0.45));
  EXPECT_TRUE(obstacles_.empty());
  ASSERT_TRUE(run(0.1));
  ASSERT_EQ(obstacles_.count(9), 1U);
  EXPECT_EQ(obstacles_[9].state_time_s, 5.0);
  ASSERT_TRUE(run(0.5));
  EXPECT_TRUE(obstacles_.empty());
}

TEST_F(SimParticipantTest, CountsWhatItMustNotActOn) {
  start();
  data::PathPlan stranger = first_sortie(5.0);
  stranger.vehicle_id = 8;
  ASSERT_TRUE(path_plans_->publish(stranger));
  data::PathPlan stale = first_sortie(5.0);
  stale.waypoints[0].position = {7, 7, 7};
  ASSERT_TRUE(path_plans_->publish(stale));
  data::CoveragePlan other = plan_of({strip({0, 5, 20}, {100, 5, 20})});
  other.task_id = 99;
  ASSERT_TRUE(coverage_plans_->publish(other));
  other.task_id = 1;
  other.vehicle_id = 8;
  ASSERT_TRUE(coverage_plans_->publish(other));
  auto chargers = other_bus_->publisher<data::ChargerState>().value();
  data::ChargerState charger;
  charger.charger_id = 77;
  ASSERT_TRUE(chargers->publish(charger));
  ASSERT_TRUE(run(0.1));
  std::map<std::string, std::uint64_t> counts;
  for (const auto& r : sim_bus_->statistics().rejected) counts[r.topic + ": " + r.reason] += r.count;
  EXPECT_EQ(counts["PathPlan: unknown vehicle"], 1U);
  EXPECT_EQ(counts["PathPlan: stale start"], 1U);
  EXPECT_EQ(counts["CoveragePlan: plan for another task"], 1U);
  EXPECT_EQ(counts["CoveragePlan: unknown vehicle"], 1U);
  EXPECT_EQ(counts["ChargerState: unknown charger"], 1U);
  EXPECT_EQ(mission_clock_->state, data::ClockState::kWaiting) << "a plan for another task starts nothing";
}

TEST_F(SimParticipantTest, GivesUpWaiting) {
  start({}, {.await = {1, 2}, .await_limit_s = 3.0});
  while (run(0.5)) ASSERT_LT(clock_.now_s(), 10.0);
  ASSERT_TRUE(sim_->simulation().outcome());
  EXPECT_EQ(sim_->simulation().outcome()->reason, "waited in vain for participant 1, 2");
  EXPECT_EQ(mission_clock_->state, data::ClockState::kEnded);
}

TEST_F(SimParticipantTest, EndsWhenInterrupted) {
  start();
  publish_plans();
  ASSERT_TRUE(run(1.0));
  sim_->interrupt();
  while (run(0.5)) ASSERT_LT(clock_.now_s(), 10.0);
  EXPECT_EQ(nlohmann::json::parse(sim_->summary())["status"], "interrupted");
}

TEST(SimOptions, RefusesSenselessOnes) {
  EXPECT_TRUE(validate(SimOptions{}));
  EXPECT_FALSE(validate(SimOptions{.rate = 0.0}));
  EXPECT_FALSE(validate(SimOptions{.await_limit_s = -1.0}));
  EXPECT_FALSE(validate(SimOptions{.max_time_s = 0.0}));
}

}  // namespace
}  // namespace swallowtail::sim
