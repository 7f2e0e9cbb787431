#include "tools/mission/run/summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

namespace swallowtail::mission {
namespace {

using Json = nlohmann::ordered_json;

double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, values.size()) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Json violation_json(const check::Finding& finding) {
  return {{"time_s", finding.time_s},
          {"kind", finding.kind},
          {"where_m", {finding.where_m.x, finding.where_m.y, finding.where_m.z}},
          {"by", finding.by},
          {"detail", finding.detail}};
}

}  // namespace

ReplanTimes replan_times(const check::FlightLog& log) {
  std::vector<double> times;
  for (const auto& plan : log.plans) times.push_back(plan.replan_ms);
  const double p50 = percentile(times, 0.5);
  const double p99 = percentile(times, 0.99);
  const double max = percentile(times, 1.0);
  return {p50, p99, max};
}

Summary summarize(const check::Rules& rules, const check::FlightLog& log, const std::string& status) {
  Summary summary;
  summary.status = status;
  summary.has_coverage = rules.has_coverage;
  summary.flight = check::check_flight(log, rules);
  std::set<std::uint32_t> paths;
  for (const auto& plan : log.plans) paths.insert(plan.revision);
  summary.replans = static_cast<int>(paths.size());
  std::set<std::uint32_t> revisions;
  for (const auto& plan : log.coverage_plans) {
    if (revisions.insert(plan.revision).second && revisions.size() > 1)
      summary.coverage_reasons.push_back(plan.reason);
  }
  summary.coverage_revisions = static_cast<int>(revisions.size());
  summary.replan = replan_times(log);
  return summary;
}

std::string summary_json(const Summary& s) {
  Json violations = Json::array();
  for (const auto& finding : s.flight.violations) violations.push_back(violation_json(finding));
  // What a flight to a goal does not have is null.
  const auto of_coverage = [&s](auto value) { return s.has_coverage ? Json(value) : Json(); };
  const Json json = {
      {"status", s.status},
      {"kind", s.has_coverage ? "coverage" : "goal"},
      {"covered_percent", of_coverage(s.flight.covered_percent)},
      {"flight_s", s.flight.flight_s},
      {"mission_s", s.flight.mission_s},
      {"replans", s.replans},
      {"replan_ms", {{"p50", s.replan.p50_ms}, {"p99", s.replan.p99_ms}, {"max", s.replan.max_ms}}},
      {"coverage_revisions", s.coverage_revisions},
      {"coverage_reasons", s.coverage_reasons},
      {"clearance_min_m", s.flight.clearance_min_m},
      {"contingencies", s.flight.contingencies},
      {"recharges", s.flight.recharges},
      {"energy_min", of_coverage(s.flight.energy_min)},
      {"violations", violations},
      {"recording", s.recording},
      {"report", s.report},
      {"rate", s.rate},
      {"wall_s", s.wall_s}};
  return json.dump(2);
}

std::string summary_text(const planner::Scenario& scenario, const Summary& s) {
  std::string all;
  char text[400];
  const auto line = [&](const char* format, auto... values) {
    std::snprintf(text, sizeof text, format, values...);
    all += text;
  };
  line("\nmission    %s: %s\n", scenario.name.c_str(), s.status.c_str());
  if (s.has_coverage) {
    line("covered    %.2f %% of the fields at the required height\n", s.flight.covered_percent);
  } else if (scenario.goal_m) {
    const Vec3& goal = *scenario.goal_m;
    line("goal       (%.1f, %.1f, %.1f) m\n", goal.x(), goal.y(), goal.z());
  }
  line("flight     %.0f s in the air of %.0f s mission time, flown in %.1f s\n", s.flight.flight_s,
       s.flight.mission_s, s.wall_s);
  line("replans    %d path plans, median %.1f ms, 99 %% %.1f ms, longest %.1f ms; ", s.replans,
       s.replan.p50_ms, s.replan.p99_ms, s.replan.max_ms);
  if (s.has_coverage) line("%d coverage plans; ", s.coverage_revisions);
  line("%d contingencies\n", s.flight.contingencies);
  line("clearance  %.2f m at least\n", s.flight.clearance_min_m);
  if (s.has_coverage)
    line("battery    never below %.1f; %d recharges\n", s.flight.energy_min, s.flight.recharges);
  line("checked    %zu recorded states: %zu violations\n", s.flight.states, s.flight.violations.size());
  for (const auto& v : s.flight.violations) {
    line("  %8.1f s  %s by %s: %s\n", v.time_s, v.kind.c_str(), v.by.c_str(), v.detail.c_str());
  }
  all += "recording  " + s.recording + "\n";
  if (!s.report.empty()) all += "report     " + s.report + "\n";
  return all;
}

}  // namespace swallowtail::mission
