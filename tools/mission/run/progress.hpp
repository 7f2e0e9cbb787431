#pragma once

#include <optional>
#include <string>

namespace swallowtail::mission {

/// One line of the simulator's --progress output.
struct Progress {
  double time_s = 0.0;
  double covered_percent = 0.0;
  double energy = 0.0;
  double capacity = 0.0;
  int replans = 0;
  int legs_done = 0;
  int legs_total = 0;
  double clearance_m = 0.0;
  int recharges = 0;
  int violations = 0;
  std::string mode;
  std::string charger_activity;
  std::string verdict;
  std::string state;   ///< waiting, running, ended
  std::string status;  ///< of the last line: completed, or why not
};

/// Nothing for a line that is not a JSON object; fields that are missing keep their defaults.
std::optional<Progress> parse_progress(const std::string& line);

/// One line for people, at most 120 characters.
std::string progress_line(const Progress& progress);

}  // namespace swallowtail::mission
