#include "tools/mission/check/robot_energy.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::check {
namespace {

constexpr double kAtDepot_m = 1.0;
constexpr double kEnergy = 1e-3;
/// Rounding of times and of what was delivered, as a share.
constexpr double kShare = 1e-6;
/// A drive that begins or ends between two states is not seen whole.
constexpr double kMoved_m = 1e-6;

double lost_between(const RobotBattery& battery, double from_s, double to_s) {
  double out = 0.0;
  for (const RobotLoss& loss : battery.losses)
    if (loss.at_s > from_s && loss.at_s <= to_s) out += loss.energy;
  return out;
}

double from_depot_m(const RobotBattery& battery, const data::ChargerState& state) {
  return std::hypot(state.position.x_m - battery.depot.x, state.position.y_m - battery.depot.y);
}

void judge_step(const RobotBattery& battery, double speed_mps, const data::ChargerState& from,
                const data::ChargerState& to, Findings& findings) {
  const P3 at{to.position.x_m, to.position.y_m, to.position.z_m};
  const double fall = from.energy - to.energy;
  // Between two states it may have come and gone.
  const double away = from_depot_m(battery, from) + from_depot_m(battery, to);
  const bool may_refill = away <= speed_mps * (to.time_s - from.time_s) + kAtDepot_m;
  if (fall < -kEnergy) {
    if (!may_refill)
      findings.add(to.time_s, "robot_energy", at, "charger", -fall,
                   "the robot's energy rose by %.2f units %.2f m from its depot", -fall, away);
    return;
  }
  const double moved = std::hypot(to.position.x_m - from.position.x_m, to.position.y_m - from.position.y_m);
  const double span = to.time_s - from.time_s;
  const double given = battery.per_charged * std::max(0.0, to.energy_delivered - from.energy_delivered);
  const bool may_drive = moved > kMoved_m || from.speed_mps > 0.0 || to.speed_mps > 0.0;
  const double lost = lost_between(battery, from.time_s, to.time_s);
  const double most = given + (may_drive ? battery.drive_per_s * span : 0.0) + lost;
  const double least = given + battery.drive_per_s * moved / speed_mps;
  if (fall > most * (1.0 + kShare) + kEnergy)
    findings.add(to.time_s, "robot_energy", at, "charger", fall - most,
                 "the robot's energy fell by %.2f units, driving and charging take %.2f at most", fall, most);
  if (fall < least * (1.0 - kShare) - kEnergy && to.energy > 0.0 && !may_refill)
    findings.add(to.time_s, "robot_energy", at, "charger", least - fall,
                 "the robot's energy fell by %.2f units, driving and charging take %.2f at least", fall,
                 least);
}

}  // namespace

void judge_robot_energy(const FlightLog& log, const Rules& rules, Findings& findings) {
  if (!rules.robot_battery) return;
  const RobotBattery& battery = *rules.robot_battery;
  double owed = 0.0;  // what losses may have taken from the reserve since the last refill
  for (std::size_t i = 0; i < log.chargers.size(); ++i) {
    const auto& state = log.chargers[i];
    const P3 at{state.position.x_m, state.position.y_m, state.position.z_m};
    if (i > 0) {
      const auto& last = log.chargers[i - 1];
      owed = state.energy > last.energy ? 0.0 : owed + lost_between(battery, last.time_s, state.time_s);
      judge_step(battery, rules.charger_speed_mps, last, state, findings);
    } else {
      owed = lost_between(battery, -1.0, state.time_s);
    }
    const double least = std::max(0.0, battery.reserve - owed);
    if (state.energy < least - kEnergy || (least <= 0.0 && state.energy <= 0.0 && owed <= 0.0))
      findings.add(state.time_s, "robot_energy", at, "charger", least - state.energy,
                   "the robot has %.2f units left, at least %.2f are to be kept", state.energy, least);
    if (state.energy > battery.capacity + kEnergy)
      findings.add(state.time_s, "robot_energy", at, "charger", state.energy - battery.capacity,
                   "the robot has %.2f units, its capacity is %.2f", state.energy, battery.capacity);
  }
}

}  // namespace swallowtail::check
