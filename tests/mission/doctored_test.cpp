#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "tests/mission/doctor.hpp"
#include "tests/mission/flight.hpp"
#include "tools/record/recording/recording.hpp"

// The recording of mission_demo is sound; what is forged in it must be found out.
namespace swallowtail {
namespace {

using testing::check_recording;
using testing::copy_changed;

constexpr double kStretch_s = 5.0;
constexpr std::uint32_t kVehicle = 1;

bool in_flight(const data::VehicleState& state) {
  return state.mode == data::VehicleMode::kCovering || state.mode == data::VehicleMode::kTransfer;
}

class Doctored : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const auto read = recording::load_recording(testing::demo_recording());
    ASSERT_TRUE(read.ok()) << read.error().message;
    double since_s = -1.0;
    std::map<std::uint32_t, int> states_of_plan;
    for (const auto& timed : read->vehicle_states) {
      const auto& state = timed.value;
      if (state.vehicle_id != kVehicle) continue;
      if (!in_flight(state)) {
        since_s = -1.0;
        continue;
      }
      ++states_of_plan[state.path_revision];
      if (since_s < 0.0) since_s = state.time_s;
      if (start_s_ < 0.0 && state.time_s - since_s > kStretch_s + 4.0) start_s_ = since_s + 2.0;
    }
    ASSERT_GE(start_s_, 0.0) << "no stretch of flight in the recording";
    for (const auto& [revision, states] : states_of_plan)
      if (states > states_of_plan[plan_]) plan_ = revision;
    folder_ = testing::clean_folder("mission_doctored_flights");
  }

  /// Times of a stretch in the air.
  static bool in_stretch(const data::VehicleState& state, double length_s) {
    return state.vehicle_id == kVehicle && state.time_s >= start_s_ && state.time_s < start_s_ + length_s;
  }

  /// The verdict on the recording with changes.
  static testing::Verdict judge(const testing::Changes& changes) {
    const std::string file = folder_ + "/doctored.mcap";
    EXPECT_GT(copy_changed(testing::demo_recording(), file, changes), 0) << "nothing was changed";
    return check_recording(file);
  }

  static inline double start_s_ = -1.0;   ///< of a stretch of kStretch_s in flight
  static inline std::uint32_t plan_ = 0;  ///< revision that was flown the longest
  static inline std::string folder_;
};

TEST_F(Doctored, ACopyWithoutChangesIsCertified) {
  const std::string file = folder_ + "/copy.mcap";
  EXPECT_EQ(copy_changed(testing::demo_recording(), file, {.state = [](auto&) { return true; }}), 0);
  for (const std::string& recording : {testing::demo_recording(), file}) {
    const auto verdict = check_recording(recording);
    EXPECT_EQ(verdict.exit_code, 0) << verdict.answer.dump(2);
    EXPECT_EQ(verdict.answer["verdict"], "certified");
  }
}

TEST_F(Doctored, APositionOffThePlanIsFound) {
  const auto verdict = judge({.state = [](data::VehicleState& state) {
    if (in_stretch(state, 3.0)) state.position.y_m += 5.0;
    return true;
  }});
  EXPECT_EQ(verdict.exit_code, 1);
  EXPECT_THAT(verdict.kinds, ::testing::Contains("off_plan"));
}

TEST_F(Doctored, ABatteryBelowTheReserveIsFound) {
  const auto verdict = judge({.battery = [done = false](data::BatteryState& battery) mutable {
    if (!done && battery.vehicle_id == kVehicle && battery.time_s > start_s_) {
      battery.energy = 24.0;
      done = true;
    }
    return true;
  }});
  EXPECT_EQ(verdict.exit_code, 1);
  EXPECT_THAT(verdict.kinds, ::testing::Contains("reserve"));
}

TEST_F(Doctored, AFlownPlanThatWasNoSafePathIsFound) {
  const auto verdict = judge({.plan = [](data::PathPlan& plan) {
    if (plan.revision == plan_) plan.verdict = data::PathVerdict::kNoSafePath;
    return true;
  }});
  EXPECT_EQ(verdict.exit_code, 1);
  EXPECT_THAT(verdict.kinds, ::testing::ElementsAre("uncertified_plan"));
}

TEST_F(Doctored, AStretchWithoutStatesIsFound) {
  const auto verdict =
      judge({.state = [](data::VehicleState& state) { return !in_stretch(state, kStretch_s); }});
  EXPECT_EQ(verdict.exit_code, 1);
  EXPECT_THAT(verdict.kinds, ::testing::ElementsAre("gap"));
}

}  // namespace
}  // namespace swallowtail
