#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "tests/mission/flight.hpp"

// The planner dies in flight. Domain 140.
namespace swallowtail {
namespace {

TEST(PlannerFault, AMissionWithoutItsPlannerEndsAndSaysWhy) {
  const std::string recording = testing::clean_folder("mission_fault_planner_flight") + "/flight.mcap";
  const auto mission = testing::start_flight({.domain = 140, .rate = 5, .recording = recording});
  const auto participants = testing::wait_for_participants(*mission);
  const auto planner = std::find_if(participants.begin(), participants.end(),
                                    [](const auto& child) { return child.name == "swallowtail-planner"; });
  ASSERT_NE(planner, participants.end());
  const auto shared_memory = testing::shared_memory_of(participants);
  kill(planner->pid, SIGKILL);
  EXPECT_EQ(mission->finish(testing::Limit(15)), 4);
  EXPECT_NE(mission->err().find("swallowtail-planner ended"), std::string::npos) << mission->err();
  testing::expect_clean_end(participants, recording, testing::Limit(1));
  EXPECT_THAT(testing::existing(shared_memory), ::testing::IsEmpty());
}

}  // namespace
}  // namespace swallowtail
