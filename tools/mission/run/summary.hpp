#pragma once

#include <string>
#include <vector>

#include "planner/base/result.hpp"
#include "planner/scenario/scenario.hpp"
#include "tools/mission/check/flight_check.hpp"

namespace swallowtail::mission {

struct ReplanTimes {
  double p50_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};

/// How a mission went, as read from its recording.
struct Summary {
  std::string status;        ///< "completed", or why not
  bool has_coverage = true;  ///< else the mission was one flight to a goal, without battery and fields
  check::FlightReport flight;
  int replans = 0;  ///< path plans published
  int coverage_revisions = 0;
  std::vector<std::string> coverage_reasons;  ///< of every revision after the first
  ReplanTimes replan;
  std::string recording;
  std::string report;
  double wall_s = 0.0;
  double rate = 0.0;

  bool good() const { return status == "completed" && flight.ok(); }
};

/// Times of all path plans of a log.
ReplanTimes replan_times(const check::FlightLog& log);

/// Judges a log and counts its plans.
Summary summarize(const check::Rules& rules, const check::FlightLog& log, const std::string& status);

std::string summary_json(const Summary& summary);
std::string summary_text(const planner::Scenario& scenario, const Summary& summary);

/// Writes the page and its pictures (map.svg, battery.svg, replans.svg, height.svg) beside it. Errors: a file
/// that cannot be written.
Status write_report(const planner::Scenario& scenario, const check::Rules& rules, const check::FlightLog& log,
                    const Summary& summary);

}  // namespace swallowtail::mission
