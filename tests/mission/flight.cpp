#include "tests/mission/flight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tools/record/recording/recording.hpp"

namespace swallowtail::testing {
namespace {

constexpr Limit kStart{40};
constexpr Limit kCheck{40};

}  // namespace

std::string two_heights() { return SWALLOWTAIL_SOURCE_DIR "/tests/data/missions/two_heights.yaml"; }

std::string program_file(const std::string& name) { return SWALLOWTAIL_BINARY_DIR "/bin/" + name; }

std::string clean_folder(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(SWALLOWTAIL_BINARY_DIR) / "tests" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder.string();
}

std::string demo_recording() { return SWALLOWTAIL_BINARY_DIR "/tests/mission_demo_flight/flight.mcap"; }

std::unique_ptr<Program> start_flight(const FlightOptions& options) {
  std::vector<std::string> command{program_file("swallowtail"),
                                   "mission",
                                   options.scenario,
                                   "--domain",
                                   std::to_string(options.domain),
                                   "--rate",
                                   std::to_string(options.rate),
                                   "--record",
                                   options.recording,
                                   "--json"};
  command.insert(command.end(), options.more.begin(), options.more.end());
  return std::make_unique<Program>(command, options.environment);
}

std::vector<Child> wait_for_participants(Program& mission) {
  EXPECT_TRUE(mission.wait_for_err(" covering\n", kStart)) << "no progress:\n" << mission.err();
  const auto participants = children_of(mission.pid());
  EXPECT_EQ(participants.size(), 5u);
  return participants;
}

std::set<std::string> shared_memory_of(const std::vector<Child>& participants) {
  std::set<std::string> all;
  for (const Child& participant : participants) all.merge(shared_memory_of(participant.pid));
  return all;
}

std::set<std::string> existing(const std::set<std::string>& files) {
  std::set<std::string> left;
  std::copy_if(files.begin(), files.end(), std::inserter(left, left.end()),
               [](const std::string& file) { return std::filesystem::exists(file); });
  return left;
}

Verdict check_recording(const std::string& recording, const std::string& scenario) {
  Program check({program_file("swallowtail"), "check", scenario, "--recording", recording, "--json", "-q"});
  Verdict verdict{.exit_code = check.finish(kCheck), .answer = {}, .kinds = {}};
  verdict.answer = nlohmann::json::parse(check.out(), nullptr, false);
  if (!verdict.answer.is_object()) {
    ADD_FAILURE() << "swallowtail check says no JSON: " << check.out() << check.err();
    return verdict;
  }
  for (const auto& violation : verdict.answer["violations"]) verdict.kinds.insert(violation["kind"]);
  return verdict;
}

void expect_clean_end(const std::vector<Child>& participants, const std::string& recording, Limit limit) {
  for (const Child& participant : participants) {
    EXPECT_TRUE(wait_until([&] { return !is_running(participant); }, limit))
        << participant.name << " (" << participant.pid << ") still runs";
  }
  const auto read = recording::load_recording(recording);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_TRUE(read->refused.empty());
  EXPECT_TRUE(std::any_of(read->vehicle_states.begin(), read->vehicle_states.end(), [](const auto& state) {
    return state.value.mode == data::VehicleMode::kCovering;
  })) << "the flight is not in the recording";
  const Verdict verdict = check_recording(recording);
  EXPECT_EQ(verdict.exit_code, 0) << verdict.answer.dump(2);
}

}  // namespace swallowtail::testing
