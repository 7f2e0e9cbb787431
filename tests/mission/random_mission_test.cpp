// Random fields with no-fly areas, batteries, winds, robots and aircraft, flown in the closed loop. Every
// mission keeps its reserve, and ends completed or says why it did not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <variant>

#include "tests/mission/random_mission.hpp"

namespace swallowtail::mission {
namespace {

constexpr double kCompletePercent = 99.5;
constexpr double kClaimTolerance = 0.5;  // percent

/// 20 in the quick suite; SWALLOWTAIL_MISSIONS says how many else, SWALLOWTAIL_FIRST_MISSION from which seed.
std::uint64_t number_of(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

bool says(const MissionEnd& end, const std::string& word) {
  return end.plan.reason.find(word) != std::string::npos || end.health.find(word) != std::string::npos;
}

/// The reserve is broken where a loss left no choice only, and the plan has said that the energy is short, or
/// there was none left to say it.
void check_reserve(const MissionEnd& end) {
  const std::string status = end.summary["status"];
  for (const Breach& breach : end.breaches) {
    EXPECT_TRUE(breach.unavoidable) << "below the reserve at " << breach.time_s << " s: " << breach.energy;
    const bool said = std::any_of(end.reasons.begin(), end.reasons.end(), [](const std::string& reason) {
      return reason.find("energy") != std::string::npos;
    });
    EXPECT_TRUE(said || status.find("ran out") != std::string::npos);
  }
}

/// Than what the first plan was made with, or one that lasts less long.
bool has_weak_battery(const RandomMission& mission) {
  const double planned = mission.scenario.coverage->battery.capacity;
  return mission.consumption > 1.0 || mission.capacity_share < 1.0 || mission.scenario.wind.speed_mps > 0.0 ||
         std::ranges::any_of(mission.scenario.events, [planned](const planner::Event& event) {
           const auto* other = std::get_if<planner::AircraftReplaced>(&event.what);
           return other != nullptr && other->capacity.value_or(planned) < planned;
         });
}

/// A mission that did not complete says what hindered it, and that did happen.
void check_reason(const RandomMission& mission, const MissionEnd& end) {
  const std::string status = end.summary["status"];
  const double ended_s = end.summary["time_s"];
  if (status.find("ran out") != std::string::npos) {
    EXPECT_TRUE(!end.breaches.empty() && end.breaches.back().unavoidable) << status;
    return;
  }
  if (says(end, "no way to where the aircraft landed")) {
    const auto& at = end.summary["position"];
    EXPECT_TRUE(mission.is_closed && mission.is_closed(Vec2(at[0], at[1]))) << status;
    return;
  }
  if (says(end, "energy of a full battery does not reach")) {
    EXPECT_TRUE(has_weak_battery(mission)) << "the first plan could be flown: " << status;
    return;
  }
  if (status.find("waited in vain") != std::string::npos && says(end, "robot's battery holds")) {
    EXPECT_TRUE(mission.scenario.coverage->charger.battery) << status;
    return;
  }
  if (says(end, "for a safe path") && mission.obstacle_stays) return;
  if (says(end, "robot")) {
    EXPECT_TRUE(mission.robot_dies_s && *mission.robot_dies_s < ended_s) << "the robot is well: " << status;
    return;
  }
  if (says(end, "covered in part")) {
    EXPECT_LT(claimed_percent(mission, end.plan, end.plan.legs.size()), 100.0) << status;
    return;
  }
  if (says(end, "given up")) {
    EXPECT_GT(mission.obstacles, 0) << "nothing stood in the way: " << status;
    return;
  }
  EXPECT_TRUE(says(end, "energy") || says(end, "battery")) << "no reason: " << status;
}

struct Tally {
  std::uint64_t completed = 0;
  std::uint64_t doomed = 0;
  int refills = 0;
};

void fly_and_judge(std::uint64_t seed, Tally& tally) {
  const RandomMission mission = random_mission(seed, testing::TempDir() + "swallowtail_random_missions");
  const MissionEnd end = fly(mission);
  SCOPED_TRACE("SWALLOWTAIL_FIRST_MISSION=" + std::to_string(seed) + " " + mission.faults +
               end.summary.dump() + " plan: " + end.plan.reason + "; coverage: " + end.health);
  check_reserve(end);
  tally.doomed += end.breaches.empty() ? 0 : 1;
  const double covered = end.summary["covered_percent"];
  const std::size_t legs_done = end.summary["legs_done"];
  EXPECT_GE(covered, claimed_percent(mission, end.plan, legs_done) - kClaimTolerance);
  EXPECT_EQ(end.summary["collisions"], 0);
  EXPECT_EQ(end.summary["violations"], 0);
  for (const std::string& fault : end.robot_faults) ADD_FAILURE() << fault;
  for (const std::string& failure : end.failures) ADD_FAILURE() << failure;
  tally.refills += end.refills;
  if (!end.summary["completed"].get<bool>()) return check_reason(mission, end);
  ++tally.completed;
  EXPECT_GE(covered, kCompletePercent);
  EXPECT_EQ(end.summary["legs_done"], end.summary["legs_total"]);
}

TEST(RandomMission, KeepsItsReserveAndEndsCompletedOrWithATrueReason) {
  const std::uint64_t first = number_of("SWALLOWTAIL_FIRST_MISSION", 1);
  const std::uint64_t missions = number_of("SWALLOWTAIL_MISSIONS", 20);
  Tally tally;
  for (std::uint64_t seed = first; seed < first + missions; ++seed) fly_and_judge(seed, tally);
  RecordProperty("completed", static_cast<int>(tally.completed));
  RecordProperty("below_reserve_unavoidably", static_cast<int>(tally.doomed));
  RecordProperty("refills", tally.refills);
  if (missions >= 20) {
    EXPECT_GT(tally.refills, 0);
    EXPECT_GT(tally.completed, missions / 2);
  }
}

/// What each of these found is mended: an obstacle that turned, robots that waited a metre away, ways over a
/// no-fly area, strips passed over, plans without end, a battery never charged, orders not tried, charges too
/// small to take off with.
TEST(RandomMission, StaysMendedWhereItOnceWentWrong) {
  Tally tally;
  for (const std::uint64_t seed : {61, 4151, 4611, 6052, 6399, 6547, 7004, 8843, 9813, 12808, 13261, 15186})
    fly_and_judge(seed, tally);
}

}  // namespace
}  // namespace swallowtail::mission
