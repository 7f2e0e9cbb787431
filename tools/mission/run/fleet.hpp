#pragma once

#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "tools/mission/run/process.hpp"

namespace swallowtail::mission {

struct FleetOptions {
  std::string scenario_file;
  std::string recording_file;
  double rate = 20.0;
  int domain = 0;
  std::uint64_t seed = 1;
  double max_time_s = 0.0;  ///< mission seconds; 0: the simulator's own limit
};

/// The participants of one mission as processes: recorder, charger and coverage (where there is a field),
/// planner, simulator. Destroying it stops them all.
class Fleet {
 public:
  static Result<Fleet> start(const planner::Scenario& scenario, const FleetOptions& options);

  Process& simulator() { return members_.back(); }

  /// Name and last words of the first member, the simulator aside, that has ended by itself; empty while all
  /// run.
  std::string fallen();

  /// Simulator first, recorder last, so that the recording holds the end. Returns the names of those that had
  /// to be killed.
  std::vector<std::string> stop();

 private:
  std::vector<Process> members_;
};

}  // namespace swallowtail::mission
