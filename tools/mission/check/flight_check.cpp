#include "tools/mission/check/flight_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "tools/mission/check/distance.hpp"
#include "tools/mission/check/findings.hpp"
#include "tools/mission/check/places.hpp"
#include "tools/mission/check/refly.hpp"
#include "tools/mission/check/robot_energy.hpp"
#include "tools/mission/check/swath.hpp"

namespace swallowtail::check {
namespace {

constexpr double kStep_s = 0.02;
constexpr double kClearanceTolerance_m = 0.05;
constexpr double kPlanTolerance_m = 0.25;
constexpr double kLargestGap_s = 2.0;
constexpr double kDockReach_m = 1.5;
constexpr double kCell_m = 0.5;

bool grounded(const data::VehicleState& s) {
  return s.mode == data::VehicleMode::kLanded || s.mode == data::VehicleMode::kDocked;
}

double apart(const P3& a, const P3& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}
double level_apart(const P3& a, const P3& b) { return std::hypot(a.x - b.x, a.y - b.y); }
P3 between(const Piece& piece, double t) {
  const double span = piece.t1_s - piece.t0_s;
  const double s = span > 0.0 ? (t - piece.t0_s) / span : 0.0;
  return {piece.a.x + s * (piece.b.x - piece.a.x), piece.a.y + s * (piece.b.y - piece.a.y),
          piece.a.z + s * (piece.b.z - piece.a.z)};
}

void judge_solids(const Rules& rules, const P3& p, double t, FlightReport& report, Findings& findings) {
  const double hull = rules.vehicle.radius_m + rules.vehicle.margin_m;
  for (const Solid& solid : rules.solids) {
    if (t < solid.appears_s || t >= solid.vanishes_s) continue;
    const double d = distance_m(solid, p, t);
    report.clearance_min_m = std::min(report.clearance_min_m, d);
    const double needed = hull + solid.margin_m;
    if (d < needed - kClearanceTolerance_m) {
      findings.add(t, "clearance", p, "obstacle " + std::to_string(solid.id), needed - d,
                   "%.2f m away, at least %.2f m needed", d, needed);
    }
  }
}

void judge_ground(const Rules& rules, const Piece& piece, const P3& p, double t, FlightReport& report,
                  Findings& findings) {
  const double above = p.z - rules.ground.at(p.x, p.y);
  const bool touching_down =
      piece.phase == data::PathPhase::kTakeOff || piece.phase == data::PathPhase::kLanding;
  const double needed = touching_down ? 0.0 : rules.vehicle.radius_m + rules.vehicle.margin_m;
  if (!touching_down) report.clearance_min_m = std::min(report.clearance_min_m, above);
  if (above < needed - kClearanceTolerance_m - (touching_down ? 0.1 : 0.0)) {
    findings.add(t, "terrain", p, "ground", needed - above, "%.2f m above ground, at least %.2f m needed",
                 above, needed);
  }
}

void judge_bounds(const Rules& rules, const P3& p, double t, Findings& findings) {
  const auto& lo = rules.bounds_min;
  const auto& hi = rules.bounds_max;
  const double out = std::max({lo.x - p.x, lo.y - p.y, lo.z - p.z, p.x - hi.x, p.y - hi.y, p.z - hi.z});
  if (out > kClearanceTolerance_m)
    findings.add(t, "bounds", p, "bounds", out, "%.2f m outside the scenario's bounds, %.2f m allowed", out,
                 0.0);
}

void judge_speed(const Rules& rules, const Piece& piece, Findings& findings) {
  const double span = piece.t1_s - piece.t0_s;
  if (span < 1e-6) return;
  const double level = level_apart(piece.a, piece.b);
  const double rise = piece.b.z - piece.a.z;
  const double speed = apart(piece.a, piece.b) / span;
  const auto& limits = rules.vehicle;
  const bool vertical = level < 1e-3 * std::abs(rise);
  if (!vertical && speed > limits.cruise_speed_mps * 1.01) {
    findings.add(piece.t0_s, "speed", piece.a, "vehicle", speed, "%.2f m/s, at most %.2f m/s", speed,
                 limits.cruise_speed_mps);
  }
  const double rate_limit = rise > 0.0 ? limits.climb_speed_mps : limits.descent_speed_mps;
  if (std::abs(rise) / span > rate_limit * 1.01 + 1e-6) {
    findings.add(piece.t0_s, "climb", piece.a, "vehicle", std::abs(rise) / span,
                 "%.2f m/s up or down, at most %.2f m/s", std::abs(rise) / span, rate_limit);
  }
  const double angle = std::atan2(std::abs(rise), level);
  if (!vertical && angle > limits.climb_max_rad + 1e-3 && std::abs(rise) > 0.01) {
    findings.add(piece.t0_s, "climb", piece.a, "vehicle", angle,
                 "climbs or descends at %.3f rad, at most %.3f rad", angle, limits.climb_max_rad);
  }
}

/// Change of direction between consecutive moving pieces; a stop of a second in between frees it.
void judge_turns(const Rules& rules, const std::vector<Piece>& pieces, Findings& findings) {
  const Piece* last = nullptr;
  double stood_s = 0.0;
  for (const Piece& piece : pieces) {
    const double moved = apart(piece.a, piece.b);
    if (piece.on_ground) {
      last = nullptr;
      continue;
    }
    if (moved < 1e-6) {
      stood_s += piece.t1_s - piece.t0_s;
      continue;
    }
    if (last != nullptr && stood_s < 0.99) {
      const double before = apart(last->a, last->b);
      const double dot = ((last->b.x - last->a.x) * (piece.b.x - piece.a.x) +
                          (last->b.y - last->a.y) * (piece.b.y - piece.a.y) +
                          (last->b.z - last->a.z) * (piece.b.z - piece.a.z)) /
                         (before * moved);
      const double turn = std::acos(std::clamp(dot, -1.0, 1.0));
      if (turn > rules.vehicle.turn_max_rad + 0.02 && moved > 0.01 && before > 0.01) {
        findings.add(piece.t0_s, "turn", piece.a, "vehicle", turn,
                     "turns by %.3f rad in flight, at most %.3f rad", turn, rules.vehicle.turn_max_rad);
      }
    }
    last = &piece;
    stood_s = 0.0;
  }
}

void sweep(const Rules& rules, const Piece& piece, Swath& swath) {
  if (!rules.has_coverage || piece.phase != data::PathPhase::kCover) return;
  const double length = level_apart(piece.a, piece.b);
  const int parts = std::max(1, static_cast<int>(std::ceil(length / 2.0)));
  for (int i = 0; i < parts; ++i) {
    const double span = (piece.t1_s - piece.t0_s) / parts;
    const P3 a = between(piece, piece.t0_s + i * span);
    const P3 b = between(piece, piece.t0_s + (i + 1) * span);
    const P2 middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    const double above = (a.z + b.z) / 2 - rules.ground.at(middle.x, middle.y);
    for (std::size_t f = 0; f < rules.fields.size(); ++f) {
      if (std::abs(above - rules.fields[f].height_m) <= rules.height_tolerance_m + 0.5)
        swath.sweep({a.x, a.y}, {b.x, b.y}, rules.sensor_width_m, f);
    }
  }
}

void judge_pieces(const Rules& rules, const std::vector<Piece>& pieces, FlightReport& report,
                  Findings& findings) {
  Swath swath(rules, kCell_m);
  for (const Piece& piece : pieces) {
    if (piece.on_ground) continue;
    report.flight_s += piece.t1_s - piece.t0_s;
    const int steps = std::max(1, static_cast<int>(std::ceil((piece.t1_s - piece.t0_s) / kStep_s)));
    for (int i = 0; i <= steps; ++i) {
      const double t = piece.t0_s + (piece.t1_s - piece.t0_s) * i / steps;
      const P3 p = between(piece, t);
      judge_solids(rules, p, t, report, findings);
      judge_ground(rules, piece, p, t, report, findings);
      judge_bounds(rules, p, t, findings);
      judge_no_fly(rules, p, t, findings);
    }
    judge_speed(rules, piece, findings);
    sweep(rules, piece, swath);
  }
  judge_turns(rules, pieces, findings);
  report.covered_percent = swath.covered_percent();
}

void judge_states(const FlightLog& log, const PlansByRevision& plans, Findings& findings) {
  for (std::size_t i = 0; i < log.states.size(); ++i) {
    const auto& s = log.states[i];
    if (i > 0 && s.time_s - log.states[i - 1].time_s > kLargestGap_s &&
        !(grounded(s) && grounded(log.states[i - 1]))) {
      findings.add(s.time_s, "gap", point(s.position), "recording", s.time_s - log.states[i - 1].time_s,
                   "%.2f s in flight without a state, at most %.2f s can be judged",
                   s.time_s - log.states[i - 1].time_s, kLargestGap_s);
    }
    if (grounded(s)) continue;
    if (s.path_revision ==
        0) {  // a flight that begins in the air stands where it begins, until its first plan
      const double moved = apart(point(s.position), point(log.states.front().position));
      if (moved > kPlanTolerance_m) {
        findings.add(s.time_s, "uncertified_plan", point(s.position), "plan 0", moved,
                     "moved %.2f m without a plan, at most %.2f m", moved, kPlanTolerance_m);
      }
      continue;
    }
    const auto plan = plans.find(s.path_revision);
    if (plan == plans.end()) {
      findings.add(s.time_s, "uncertified_plan", point(s.position), "plan " + std::to_string(s.path_revision),
                   1.0, "flies a plan that was never published");
      continue;
    }
    if (plan->second->verdict == data::PathVerdict::kNoSafePath) {
      findings.add(s.time_s, "uncertified_plan", point(s.position), "plan " + std::to_string(s.path_revision),
                   1.0, "flies a plan whose verdict is no safe path");
    }
    const double off = apart(point(s.position), plan_position(*plan->second, s.time_s));
    if (off > kPlanTolerance_m) {
      findings.add(s.time_s, "off_plan", point(s.position), "plan " + std::to_string(s.path_revision), off,
                   "%.2f m from where the plan is, at most %.2f m", off, kPlanTolerance_m);
    }
  }
}

void judge_battery(const FlightLog& log, const Rules& rules, FlightReport& report, Findings& findings) {
  report.energy_min = log.batteries.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const auto& battery : log.batteries) {
    report.energy_min = std::min(report.energy_min, battery.energy);
    if (!rules.has_coverage) continue;
    if (battery.energy < rules.battery_reserve - 1e-6) {
      findings.add(battery.time_s, "reserve", {}, "battery", rules.battery_reserve - battery.energy,
                   "%.2f units left, reserve is %.2f", battery.energy, rules.battery_reserve);
    }
  }
}

/// The charger's state nearest in time, and how far from it the aircraft may be for want of newer news: the
/// robot's way over two of its sampling intervals, since the aircraft learns of its motion a sample late.
struct RobotAt {
  P3 position;
  double uncertain_m = 0.0;
};

std::optional<RobotAt> robot_at(const FlightLog& log, double time_s, double speed_mps) {
  if (log.chargers.empty()) return std::nullopt;
  const auto later = std::lower_bound(log.chargers.begin(), log.chargers.end(), time_s,
                                      [](const auto& c, double t) { return c.time_s < t; });
  const auto after = later == log.chargers.end() ? std::prev(later) : later;
  const auto before = after == log.chargers.begin() ? after : std::prev(after);
  const auto nearest = time_s - before->time_s < after->time_s - time_s ? before : after;
  const double late_s = std::abs(nearest->time_s - time_s) + 2.0 * (after->time_s - before->time_s);
  return RobotAt{point(nearest->position), speed_mps * late_s};
}

/// Whether another aircraft took over between two states of the battery: one that has flown less, on the
/// ground, when the scenario says so. Its battery holds what the scenario says.
bool is_replaced(const FlightLog& log, const Rules& rules, const data::BatteryState& from,
                 const data::BatteryState& to) {
  for (std::size_t i = 1; i < log.states.size(); ++i) {
    const auto& last = log.states[i - 1];
    const auto& next = log.states[i];
    if (next.legs_done >= last.legs_done || !grounded(last) || !grounded(next)) continue;
    if (next.time_s < from.time_s - 1.0 || last.time_s > to.time_s + 1.0) continue;
    for (const Replacement& other : rules.replacements)
      if (next.time_s >= other.from_s && to.energy <= other.energy + 1e-6) return true;
  }
  return false;
}

/// Energy may rise only on the robot, and the robot must be there.
void judge_charging(const FlightLog& log, const Rules& rules, FlightReport& report, Findings& findings) {
  bool was_docked = false;
  for (const auto& s : log.states) {
    const bool docked = s.mode == data::VehicleMode::kDocked;
    if (docked && !was_docked) ++report.recharges;
    was_docked = docked;
    if (!docked) continue;
    const auto robot = robot_at(log, s.time_s, rules.charger_speed_mps);
    if (!robot) continue;
    const double reach = kDockReach_m + robot->uncertain_m;
    const double d = level_apart(robot->position, point(s.position));
    if (d > reach)
      findings.add(s.time_s, "dock", point(s.position), "charger", d,
                   "docked %.2f m from the robot, at most %.2f m", d, reach);
  }
  for (std::size_t i = 1; i < log.batteries.size(); ++i) {
    const auto& from = log.batteries[i - 1];
    const auto& to = log.batteries[i];
    if (to.energy <= from.energy + 1e-6) continue;
    const bool on_robot = std::any_of(log.states.begin(), log.states.end(), [&](const auto& s) {
      return s.mode == data::VehicleMode::kDocked && s.time_s >= from.time_s - 1.0 &&
             s.time_s <= to.time_s + 1.0;
    });
    if (!on_robot && !is_replaced(log, rules, from, to))
      findings.add(to.time_s, "charge", {}, "battery", to.energy - from.energy,
                   "energy rose by %.2f units off the robot, %.2f allowed", to.energy - from.energy, 0.0);
  }
}

void judge_charger_speed(const FlightLog& log, const Rules& rules, Findings& findings) {
  if (rules.charger_speed_mps <= 0.0) return;
  for (std::size_t i = 1; i < log.chargers.size(); ++i) {
    const auto& from = log.chargers[i - 1];
    const auto& to = log.chargers[i];
    const double d = level_apart(point(from.position), point(to.position));
    const double span = to.time_s - from.time_s;
    if (d > rules.charger_speed_mps * 1.02 * span + 0.3) {
      findings.add(to.time_s, "charger_speed", point(to.position), "charger", d,
                   "robot moved %.2f m in %.2f s", d, span);
    }
  }
}

}  // namespace

FlightReport check_flight(const FlightLog& log, const Rules& rules) {
  FlightReport report;
  Findings findings;
  report.states = log.states.size();
  report.clearance_min_m = std::numeric_limits<double>::infinity();
  if (log.states.empty()) findings.add(0.0, "no_data", {}, "recording", 1.0, "no state of the vehicle");
  PlansByRevision plans;
  for (const auto& plan : log.plans) plans[plan.revision] = &plan;
  report.contingencies = static_cast<int>(std::count_if(plans.begin(), plans.end(), [](const auto& p) {
    return p.second->verdict == data::PathVerdict::kContingency;
  }));
  judge_pieces(rules, refly(log, plans), report, findings);
  judge_states(log, plans, findings);
  judge_battery(log, rules, report, findings);
  judge_charging(log, rules, report, findings);
  judge_charger_speed(log, rules, findings);
  judge_robot_ground(log, rules, findings);
  judge_robot_energy(log, rules, findings);
  if (!log.states.empty()) report.mission_s = log.states.back().time_s - log.states.front().time_s;
  if (!std::isfinite(report.clearance_min_m)) report.clearance_min_m = 0.0;
  report.violations = findings.take();
  return report;
}

}  // namespace swallowtail::check
