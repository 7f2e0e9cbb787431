#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>

#include "planner/scenario/read.hpp"
#include "qos/fastdds/bus.hpp"
#include "tests/mission/flight.hpp"
#include "tests/mission/intruder.hpp"
#include "tools/mission/check/distance.hpp"
#include "tools/mission/check/refly.hpp"
#include "tools/mission/check/rules_of.hpp"
#include "tools/record/recording/recording.hpp"

// The demonstration, flown once over DDS with everything the issue asks of it, while two outside programs
// watch and a third writes what must be refused. Domain 135.
namespace swallowtail {
namespace {

using testing::Limit;

constexpr int kDomain = 135;
constexpr double kReserve = 25.0;

/// What the participants say of themselves, and whether the aircraft covers.
class Watcher {
 public:
  Watcher() : bus_(make_fast_bus({.domain = kDomain, .participant_name = "watcher"}).value()) {
    EXPECT_TRUE(
        bus_->subscribe<data::ParticipantStatus>({.on_sample = [this](const auto& s) { note(s); }}).ok());
    EXPECT_TRUE(bus_->subscribe<data::VehicleState>({.on_sample = [this](const auto& s) { note(s); }}).ok());
  }

  bool covers() const {
    const std::lock_guard lock(mutex_);
    return covers_;
  }
  std::vector<testing::Refusal> missing(const std::vector<testing::Refusal>& expected) const {
    const std::lock_guard lock(mutex_);
    std::vector<testing::Refusal> missing;
    std::copy_if(expected.begin(), expected.end(), std::back_inserter(missing),
                 [this](const auto& refusal) { return !counted_.contains(refusal); });
    return missing;
  }

 private:
  void note(const data::ParticipantStatus& status) {
    const std::lock_guard lock(mutex_);
    for (const auto& row : status.rejected) counted_.insert({status.participant_id, row.topic, row.reason});
  }
  void note(const data::VehicleState& state) {
    const std::lock_guard lock(mutex_);
    covers_ = covers_ || (state.vehicle_id == 1 && state.mode == data::VehicleMode::kCovering);
  }

  mutable std::mutex mutex_;
  std::set<testing::Refusal> counted_;
  bool covers_ = false;
  std::unique_ptr<Bus> bus_;  // last: no handler runs once it is gone
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// States are sent best effort: the recorder need not take the first that it hears.
constexpr int kHeard = 5;

class Demo : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = testing::clean_folder("mission_demo_flight");
    const auto mission = testing::start_flight({.domain = kDomain,
                                                .rate = 20,
                                                .recording = testing::demo_recording(),
                                                .more = {"-q", "--report", folder_ + "/report.html"}});
    watch_with_examples();
    intrude();
    exit_code_ = mission->finish(Limit(150));
    answer_ = nlohmann::json::parse(mission->out(), nullptr, false);
    if (!answer_.is_object()) ADD_FAILURE() << "no answer: " << mission->out() << mission->err();
  }

  static void watch_with_examples() {
    const std::string profiles = SWALLOWTAIL_SOURCE_DIR "/qos/profiles/";
    const std::string domain = std::to_string(kDomain);
    testing::Program cyclone({testing::program_file("cyclone_plan_watch"), domain, "60"},
                             {"CYCLONEDDS_URI=file://" + profiles + "cyclone.xml"});
    testing::Program fast({testing::program_file("fastdds_plan_watch"), domain, "60"},
                          {"FASTRTPS_DEFAULT_PROFILES_FILE=" + profiles + "fastdds.xml"});
    for (testing::Program* example : {&cyclone, &fast}) {
      for (const char* plan : {"PathPlan vehicle 1 revision ", "CoveragePlan task 1 revision "}) {
        if (!example->wait_for_out(plan, Limit(20))) unseen_by_examples_.push_back(plan);
      }
    }
  }

  /// In flight and before the first recharge, when energy decides nothing yet.
  static void intrude() {
    const Watcher watcher;
    ASSERT_TRUE(testing::wait_until([&] { return watcher.covers(); }, Limit(30)));
    testing::Intruder intruder(kDomain);
    const auto expected = testing::Intruder::expected();
    int heard = 0;
    testing::wait_until(
        [&] {
          if (intruder.is_heard_by_the_recorder()) ++heard;
          intruder.write_all();
          intruder.write_battery_above_the_task();
          return heard >= kHeard && watcher.missing(expected).empty();
        },
        Limit(10));
    uncounted_ = watcher.missing(expected);
  }

  static inline std::string folder_;
  static inline int exit_code_ = -1;
  static inline nlohmann::json answer_;
  static inline std::vector<std::string> unseen_by_examples_;
  static inline std::vector<testing::Refusal> uncounted_;
};

TEST_F(Demo, IsCompletedWithoutViolations) {
  EXPECT_EQ(exit_code_, 0);
  EXPECT_EQ(answer_["status"], "completed");
  EXPECT_GE(answer_["covered_percent"], 99.5);
  EXPECT_TRUE(answer_["violations"].empty()) << answer_["violations"].dump(2);
  EXPECT_GE(answer_["recharges"], 2);
  EXPECT_GE(answer_["energy_min"], kReserve);
}

TEST_F(Demo, RemakesTheCoveragePlanForTheBattery) {
  const auto& reasons = answer_["coverage_reasons"];
  EXPECT_TRUE(std::any_of(reasons.begin(), reasons.end(), [](const std::string& reason) {
    return reason.find("battery") != std::string::npos || reason.find("energy") != std::string::npos;
  })) << reasons.dump(2);
}

double needed_m(const check::Rules& rules, const check::Solid& solid) {
  constexpr double kClearlyLess_m = 0.1;
  return rules.vehicle.radius_m + rules.vehicle.margin_m + solid.margin_m - kClearlyLess_m;
}

/// Whether an aircraft that had kept to the path would have come too close to the solid.
bool leads_into(const data::PathPlan& plan, const check::Solid& solid, double needed) {
  if (plan.waypoints.empty()) return false;
  const double from_s = std::max(solid.appears_s, plan.waypoints.front().time_s);
  const double until_s = std::min(solid.vanishes_s, plan.waypoints.back().time_s);
  for (double t = from_s; t < until_s; t += 0.1) {
    if (check::distance_m(solid, check::plan_position(plan, t), t) < needed) return true;
  }
  return false;
}

/// Whether a strip leads through the solid about when it is to be flown: a strip is planned without
/// obstacles, and what stands on it when the aircraft takes off is in no path from the start.
bool leads_into(const data::Leg& leg, const check::Solid& solid, double needed) {
  constexpr double kAbout_s = 30.0;
  constexpr int kParts = 200;
  if (leg.kind != data::LegKind::kCover) return false;
  const auto mix = [](double a, double b, int i) { return a + (b - a) * i / kParts; };
  const double until_s = std::min(solid.vanishes_s, leg.end_s + kAbout_s);
  for (double t = std::max(solid.appears_s, leg.start_s - kAbout_s); t < until_s; t += 1.0) {
    for (int i = 0; i <= kParts; ++i) {
      const check::P3 p{mix(leg.entry.x_m, leg.exit.x_m, i), mix(leg.entry.y_m, leg.exit.y_m, i),
                        mix(leg.entry.z_m, leg.exit.z_m, i)};
      if (check::distance_m(solid, p, t) < needed) return true;
    }
  }
  return false;
}

/// A moving obstacle counts as it was announced, on its way until it is gone: nobody knew that it would turn.
bool is_in_the_way(const check::Rules& rules, check::Solid solid, const recording::Recording& recording) {
  for (const auto& stretch : rules.solids) {
    if (stretch.id == solid.id) solid.vanishes_s = std::max(solid.vanishes_s, stretch.vanishes_s);
  }
  const double needed = needed_m(rules, solid);
  for (const auto& path : recording.path_plans) {
    if (leads_into(path.value, solid, needed)) return true;
  }
  // Of a leg that is done the plans after keep what was flown.
  return std::ranges::any_of(recording.coverage_plans, [&](const auto& plan) {
    return std::ranges::any_of(plan.value.legs,
                               [&](const auto& leg) { return leads_into(leg, solid, needed); });
  });
}

TEST_F(Demo, AvoidsObstaclesThatCameIntoItsWay) {
  const auto scenario = planner::read_scenario(testing::two_heights());
  ASSERT_TRUE(scenario);
  const auto rules = check::rules_of(*scenario);
  const auto recording = recording::load_recording(testing::demo_recording());
  ASSERT_TRUE(rules.ok() && recording.ok());
  std::set<std::uint32_t> avoided;
  ASSERT_FALSE(recording->coverage_plans.empty());
  for (const auto& solid : rules->solids) {
    if (solid.appears_s > 0.0 && is_in_the_way(*rules, solid, *recording)) avoided.insert(solid.id);
  }
  for (const auto& violation : answer_["violations"]) {
    if (violation["kind"] != "clearance") continue;
    std::erase_if(avoided,
                  [&](std::uint32_t id) { return violation["by"] == "obstacle " + std::to_string(id); });
  }
  EXPECT_GE(avoided.size(), 3u) << "obstacles that a plan led into and the flight did not: "
                                << ::testing::PrintToString(avoided);
}

TEST_F(Demo, WritesAPageThatNeedsNothingElse) {
  std::string page = text_of(folder_ + "/report.html");
  ASSERT_FALSE(page.empty());
  EXPECT_THAT(page, ::testing::HasSubstr("<svg"));
  // A name, not a link.
  const std::string name = "xmlns=\"http://www.w3.org/2000/svg\"";
  for (auto at = page.find(name); at != std::string::npos; at = page.find(name)) page.erase(at, name.size());
  for (const char* link : {"src=", "<link", "<script", "@import"})
    EXPECT_THAT(page, ::testing::Not(::testing::HasSubstr(link)));
  EXPECT_THAT(page, ::testing::Not(::testing::ContainsRegex("https?://")));
}

TEST_F(Demo, WritesPicturesThatAreXml) {
  for (const char* name : {"map.svg", "battery.svg", "replans.svg", "height.svg"}) {
    const std::string file = folder_ + "/" + name;
    EXPECT_THAT(text_of(file), ::testing::HasSubstr("</svg>")) << name;
    if (!std::filesystem::exists("/usr/bin/xmllint")) continue;
    testing::Program lint({"/usr/bin/xmllint", "--noout", file});
    EXPECT_EQ(lint.finish(Limit(10)), 0) << lint.err();
  }
}

TEST_F(Demo, IsSeenByProgramsMadeFromTheIdlAlone) { EXPECT_THAT(unseen_by_examples_, ::testing::IsEmpty()); }

TEST_F(Demo, CountsWhatAnIntruderWritesByReason) {
  for (const auto& [participant, topic, reason] : uncounted_)
    ADD_FAILURE() << "participant " << participant << " counts no " << topic << ": " << reason;
}

TEST_F(Demo, RecordsWhatTheIntruderWrote) {
  const auto recording = recording::load_recording(testing::demo_recording());
  ASSERT_TRUE(recording.ok()) << recording.error().message;
  EXPECT_TRUE(recording->is_complete);
  EXPECT_TRUE(std::any_of(recording->vehicle_states.begin(), recording->vehicle_states.end(),
                          [](const auto& state) { return state.value.vehicle_id == 99; }));
  EXPECT_TRUE(std::any_of(
      recording->battery_states.begin(), recording->battery_states.end(),
      [](const auto& battery) { return battery.value.vehicle_id == 1 && battery.value.energy > 300.0; }));
  for (const auto& refusal : testing::Intruder::expected()) {
    const auto& [participant, topic, reason] = refusal;
    if (reason == "unknown vehicle" || reason == "energy above the task's capacity")
      continue;  // sound in itself
    EXPECT_TRUE(recording->refused.contains(topic + ": " + reason)) << topic << ": " << reason;
  }
}

}  // namespace
}  // namespace swallowtail
