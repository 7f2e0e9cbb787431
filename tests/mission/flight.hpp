#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/program.hpp"

namespace swallowtail::testing {

/// The demonstration's scenario.
std::string two_heights();

/// The program of that name of this build.
std::string program_file(const std::string& name);

/// A fresh folder of that name in the build's tests; what was in it is removed.
std::string clean_folder(const std::string& name);

/// Where mission_demo leaves its recording for mission_doctored.
std::string demo_recording();

struct FlightOptions {
  int domain = 0;
  int rate = 20;
  std::string recording;
  std::string scenario = two_heights();
  std::vector<std::string> more{};         ///< further options of `swallowtail mission`
  std::vector<std::string> environment{};  ///< NAME=VALUE
};

/// Starts `swallowtail mission`.
std::unique_ptr<Program> start_flight(const FlightOptions& options);

/// Waits until the progress says that the aircraft covers, and returns the mission's five participants.
std::vector<Child> wait_for_participants(Program& mission);

/// Files in /dev/shm that any of them has mapped.
std::set<std::string> shared_memory_of(const std::vector<Child>& participants);

/// Those of the files that are still there.
std::set<std::string> existing(const std::set<std::string>& files);

struct Verdict {
  int exit_code = -1;
  nlohmann::json answer;
  std::set<std::string> kinds;  ///< of the violations
};

/// What `swallowtail check` says of a recording of the scenario.
Verdict check_recording(const std::string& recording, const std::string& scenario = two_heights());

/// Expects that none of them runs after `limit` and that a recording was left that can be read and checked
/// and holds states of the aircraft in flight.
void expect_clean_end(const std::vector<Child>& participants, const std::string& recording, Limit limit);

}  // namespace swallowtail::testing
