#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "tests/mission/flight.hpp"

// What a mission leaves behind when it is stopped: nothing but its recording. Domains 130 to 132.
namespace swallowtail {
namespace {

using ::testing::IsEmpty;
using testing::Limit;

struct Stop {
  const char* name;
  int signal;
  int domain;
  const char* transport;
};

class StoppedMission : public ::testing::TestWithParam<Stop> {};

TEST_P(StoppedMission, AnswersAndLeavesOnlyItsRecording) {
  const auto& [name, signal, domain, transport] = GetParam();
  const std::string recording =
      testing::clean_folder(std::string("mission_stopped_") + name) + "/flight.mcap";
  const auto mission =
      testing::start_flight({.domain = domain,
                             .rate = 5,
                             .recording = recording,
                             .environment = {std::string("SWALLOWTAIL_TRANSPORT=") + transport}});
  const auto participants = testing::wait_for_participants(*mission);
  const auto shared_memory = testing::shared_memory_of(participants);
  EXPECT_EQ(shared_memory.empty(), std::string(transport) == "udp");
  mission->send(signal);
  EXPECT_EQ(mission->finish(Limit(15)), 3) << mission->err();
  const auto answer = nlohmann::json::parse(mission->out(), nullptr, false);
  ASSERT_TRUE(answer.is_object()) << mission->out();
  EXPECT_EQ(answer["status"], "interrupted");
  EXPECT_THAT(mission->err(), ::testing::Not(::testing::HasSubstr("was killed")));
  testing::expect_clean_end(participants, recording, Limit(1));
  EXPECT_THAT(testing::existing(shared_memory), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Signals, StoppedMission,
                         ::testing::Values(Stop{"SIGINT", SIGINT, 130, "udp"},
                                           Stop{"SIGTERM", SIGTERM, 131, "shm"}),
                         [](const auto& run) { return std::string(run.param.name); });

TEST(KilledMission, TakesItsParticipantsAlong) {
  const std::string recording = testing::clean_folder("mission_killed") + "/flight.mcap";
  const auto mission = testing::start_flight(
      {.domain = 132, .rate = 5, .recording = recording, .environment = {"SWALLOWTAIL_TRANSPORT=shm"}});
  const auto participants = testing::wait_for_participants(*mission);
  const auto shared_memory = testing::shared_memory_of(participants);
  mission->send(SIGKILL);
  EXPECT_EQ(mission->finish(Limit(15)), 128 + SIGKILL);
  testing::expect_clean_end(participants, recording, Limit(5));
  EXPECT_THAT(testing::existing(shared_memory), IsEmpty());
}

}  // namespace
}  // namespace swallowtail
