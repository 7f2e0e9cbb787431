#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tools/mission/report/chart.hpp"
#include "tools/mission/report/html.hpp"
#include "tools/mission/report/map.hpp"
#include "tools/mission/run/summary.hpp"

namespace swallowtail::mission {
namespace {

using report::Points;

std::string with_unit(double value, int decimals, const char* unit) {
  return report::number(value, decimals) + unit;
}

Points thinned(Points points) {
  constexpr std::size_t kMost = 3000;
  if (points.size() <= kMost) return points;
  Points kept;
  const double step = static_cast<double>(points.size() - 1) / (kMost - 1);
  for (std::size_t i = 0; i < kMost; ++i)
    kept.push_back(points[static_cast<std::size_t>(static_cast<double>(i) * step)]);
  return kept;
}

std::string battery_chart(const check::FlightLog& log, const check::Rules& rules) {
  Points energy;
  for (const auto& b : log.batteries) energy.emplace_back(b.time_s, b.energy);
  return report::draw_chart(
      "Battery", "energy units", {{"energy", "#1f5fbf", thinned(std::move(energy)), false}},
      {{"capacity", rules.battery_capacity, "#5b6b7a"}, {"reserve", rules.battery_reserve, "#c0392b"}});
}

std::string replan_chart(const check::FlightLog& log) {
  Points certified;
  Points contingency;
  for (const auto& plan : log.plans) {
    (plan.verdict == data::PathVerdict::kCertified ? certified : contingency)
        .emplace_back(plan.basis.vehicle_time_s, plan.replan_ms);
  }
  return report::draw_chart(
      "Replan latency", "milliseconds",
      {{"certified", "#2e8b57", certified, true}, {"contingency", "#c0392b", contingency, true}});
}

std::string height_chart(const check::FlightLog& log, const check::Rules& rules) {
  Points flown;
  Points ground;
  for (const auto& s : log.states) {
    flown.emplace_back(s.time_s, s.position.z_m);
    ground.emplace_back(s.time_s, rules.ground.at(s.position.x_m, s.position.y_m));
  }
  return report::draw_chart("Height", "metres",
                            {{"flown", "#1f5fbf", thinned(std::move(flown)), false},
                             {"ground below", "#8a6d3b", thinned(std::move(ground)), false}});
}

report::Page page_of(const planner::Scenario& scenario, const Summary& s) {
  report::Page page;
  page.title = scenario.name;
  page.good = s.good();
  page.verdict = s.good() ? "Completed; the independent checker found no violation."
                          : "Status: " + s.status + "; " + std::to_string(s.flight.violations.size()) +
                                " violations found by the independent checker.";
  page.facts = {{"covered at the required height", with_unit(s.flight.covered_percent, 2, " %")},
                {"in the air", with_unit(s.flight.flight_s, 0, " s")},
                {"mission time", with_unit(s.flight.mission_s, 0, " s")},
                {"least clearance", with_unit(s.flight.clearance_min_m, 2, " m")},
                {"lowest battery", with_unit(s.flight.energy_min, 1, " units")},
                {"recharges", std::to_string(s.flight.recharges)},
                {"path plans", std::to_string(s.replans)},
                {"coverage plans", std::to_string(s.coverage_revisions)},
                {"replan median / 99 % / longest", report::number(s.replan.p50_ms, 1) + " / " +
                                                       report::number(s.replan.p99_ms, 1) + " / " +
                                                       report::number(s.replan.max_ms, 1) + " ms"},
                {"contingencies", std::to_string(s.flight.contingencies)}};
  for (const auto& v : s.flight.violations)
    page.violations.push_back({report::number(v.time_s, 1), v.kind, v.by, v.detail});
  page.footnote = "Drawn from the recording " + s.recording + " and the scenario " + scenario.file + ".";
  return page;
}

Status write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) return bad_input("Cannot write " + path.string() + ".");
  return {};
}

}  // namespace

Status write_report(const planner::Scenario& scenario, const check::Rules& rules, const check::FlightLog& log,
                    const Summary& summary) {
  report::Page page = page_of(scenario, summary);
  page.figures.push_back({"map.svg",
                          "From above, north up: fields, planned strips (dashed), flown path by phase, "
                          "ground robot, recharges, obstacles and the way they moved.",
                          report::draw_map(rules, log, scenario.name)});
  if (rules.has_coverage)
    page.figures.push_back({"battery.svg", "Battery over mission time.", battery_chart(log, rules)});
  page.figures.push_back(
      {"replans.svg", "Time from the sample that asked for it to the certified path, for every path plan.",
       replan_chart(log)});
  page.figures.push_back({"height.svg", "Height flown and ground below it.", height_chart(log, rules)});
  const std::filesystem::path target(summary.report);
  std::error_code ignored;
  if (target.has_parent_path()) std::filesystem::create_directories(target.parent_path(), ignored);
  for (const auto& figure : page.figures) {
    if (auto status = write_file(target.parent_path() / figure.file, figure.svg); !status) return status;
  }
  return write_file(target, report::draw_page(page));
}

}  // namespace swallowtail::mission
