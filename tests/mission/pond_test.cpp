#include <gtest/gtest.h>

#include <string>

#include "tests/mission/flight.hpp"
#include "tools/record/recording/recording.hpp"

// A meadow with areas that must not be flown over, a multirotor in wind and a robot on roads, over DDS.
// Domain 145.
namespace swallowtail {
namespace {

using testing::Limit;

const std::string kScenario = SWALLOWTAIL_SOURCE_DIR "/tests/data/missions/pond.yaml";

TEST(PondMission, IsFlownRoundItsNoFlyAreasByTheSameModelAsOffline) {
  const std::string recording = testing::clean_folder("mission_pond_flight") + "/flight.mcap";
  const auto mission = testing::start_flight(
      {.domain = 145, .rate = 25, .recording = recording, .scenario = kScenario, .more = {"-q"}});
  EXPECT_EQ(mission->finish(Limit(60)), 0) << mission->err();
  const auto answer = nlohmann::json::parse(mission->out(), nullptr, false);
  ASSERT_TRUE(answer.is_object()) << mission->out() << mission->err();
  EXPECT_EQ(answer["status"], "completed");
  EXPECT_GE(answer["covered_percent"], 99.5);
  EXPECT_GE(answer["recharges"], 1);
  EXPECT_GE(answer["energy_min"], 1.0);
  EXPECT_TRUE(answer["violations"].empty()) << answer["violations"].dump(2);

  const auto verdict = testing::check_recording(recording, kScenario);
  EXPECT_EQ(verdict.exit_code, 0);
  EXPECT_TRUE(verdict.kinds.empty()) << verdict.answer.dump(2);

  testing::Program cover({testing::program_file("swallowtail"), "cover", kScenario, "--json", "-q"});
  ASSERT_EQ(cover.finish(Limit(30)), 0) << cover.err();
  const auto offline = nlohmann::json::parse(cover.out(), nullptr, false);
  ASSERT_TRUE(offline.is_object());
  const auto recorded = recording::load_recording(recording);
  ASSERT_TRUE(recorded) << recorded.error().message;
  ASSERT_FALSE(recorded->coverage_plans.empty());
  EXPECT_TRUE(recorded->refused.empty());
  const data::CoveragePlan& first = recorded->coverage_plans.front().value;
  const double makespan_s = offline["makespan_s"].get<double>();
  // Strips that keep off the no-fly areas by centimetres may be cut otherwise.
  EXPECT_NEAR(first.makespan_s, makespan_s, 0.1 * makespan_s);
  ASSERT_FALSE(recorded->coverage_tasks.empty());
  ASSERT_FALSE(recorded->charger_plans.empty());
  EXPECT_TRUE(recorded->coverage_tasks.front().value.battery.model.is_multirotor);
  EXPECT_FALSE(recorded->charger_plans.front().value.bends.empty()) << "the robot keeps to its roads";
}

}  // namespace
}  // namespace swallowtail
