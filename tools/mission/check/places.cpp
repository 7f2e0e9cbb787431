#include "tools/mission/check/places.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "tools/mission/check/areas.hpp"

namespace swallowtail::check {
namespace {

/// Rounding of positions in files and on the way.
constexpr double kAircraft_m = 0.02;
/// The robot takes corners in steps; its start may stand at a border.
constexpr double kRobot_m = 1.0;

/// How deep inside the area; 0 outside.
double depth_m(const Rings& area, const P2& p) { return holds(area, p) ? border_distance_m(area, p) : 0.0; }

}  // namespace

void judge_no_fly(const Rules& rules, const P3& p, double time_s, Findings& findings) {
  for (std::size_t i = 0; i < rules.no_fly.size(); ++i) {
    const double depth = depth_m(rules.no_fly[i], {p.x, p.y});
    if (depth > kAircraft_m)
      findings.add(time_s, "no_fly", p, "no-fly area " + std::to_string(i), depth,
                   "%.2f m inside, at most %.2f m", depth, kAircraft_m);
  }
}

void judge_robot_ground(const FlightLog& log, const Rules& rules, Findings& findings) {
  for (const auto& state : log.chargers) {
    const P3 at{state.position.x_m, state.position.y_m, state.position.z_m};
    for (std::size_t i = 0; i < rules.no_drive.size(); ++i) {
      const double depth = depth_m(rules.no_drive[i], {at.x, at.y});
      if (depth > kRobot_m)
        findings.add(state.time_s, "closed_ground", at, "closed area " + std::to_string(i), depth,
                     "%.2f m inside, at most %.2f m", depth, kRobot_m);
    }
    if (rules.roads.empty()) continue;
    double away = std::numeric_limits<double>::infinity();
    for (const auto& road : rules.roads) away = std::min(away, line_distance_m(road, {at.x, at.y}));
    if (away > rules.off_road_m + kRobot_m)
      findings.add(state.time_s, "off_road", at, "roads", away, "%.2f m from any road, at most %.2f m", away,
                   rules.off_road_m);
  }
}

}  // namespace swallowtail::check
