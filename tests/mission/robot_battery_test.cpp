#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/mission/flight.hpp"
#include "tools/record/recording/recording.hpp"

// A ground robot whose own battery runs low, over DDS: the two vendors agree on what it holds. Domain 148.
namespace swallowtail {
namespace {

using testing::Limit;

const std::string kScenario = SWALLOWTAIL_SOURCE_DIR "/tests/data/missions/robot_battery.yaml";

TEST(RobotBatteryMission, TheRobotFetchesNewEnergyAndNeverRunsOut) {
  const std::string recording = testing::clean_folder("mission_robot_battery_flight") + "/flight.mcap";
  const auto mission = testing::start_flight(
      {.domain = 148, .rate = 25, .recording = recording, .scenario = kScenario, .more = {"-q"}});
  EXPECT_EQ(mission->finish(Limit(60)), 0) << mission->err();
  const auto answer = nlohmann::json::parse(mission->out(), nullptr, false);
  ASSERT_TRUE(answer.is_object()) << mission->out() << mission->err();
  EXPECT_EQ(answer["status"], "completed");
  EXPECT_GE(answer["covered_percent"], 99.5);
  EXPECT_TRUE(answer["violations"].empty()) << answer["violations"].dump(2);

  const auto verdict = testing::check_recording(recording, kScenario);
  EXPECT_EQ(verdict.exit_code, 0);
  EXPECT_TRUE(verdict.kinds.empty()) << verdict.answer.dump(2);

  const auto recorded = recording::load_recording(recording);
  ASSERT_TRUE(recorded) << recorded.error().message;
  EXPECT_TRUE(recorded->refused.empty());
  ASSERT_FALSE(recorded->charger_plans.empty());
  EXPECT_TRUE(recorded->charger_plans.front().value.has_battery);
  const auto& states = recorded->charger_states;
  ASSERT_FALSE(states.empty());
  EXPECT_TRUE(std::any_of(states.begin(), states.end(), [](const auto& state) {
    return state.value.activity == data::ChargerActivity::kRefilling;
  }));
  const auto least = std::min_element(states.begin(), states.end(), [](const auto& a, const auto& b) {
    return a.value.energy < b.value.energy;
  });
  EXPECT_GE(least->value.energy, recorded->charger_plans.front().value.battery.reserve);
}

}  // namespace
}  // namespace swallowtail
