#include "tools/cli/cover_check.hpp"

#include <algorithm>
#include <map>

#include <fmt/core.h>

namespace swallowtail::cli {
namespace {

constexpr double kTime_s = 1e-3;
constexpr double kEnergy = 1e-6;
constexpr double kPlace_m = 1e-3;

void check_sub_cells(const coverage::Plan& plan, std::vector<std::string>& faults) {
  std::map<std::uint32_t, int> flown;
  for (const coverage::Leg& leg : plan.legs) {
    if (leg.kind != coverage::LegKind::kCover) continue;
    ++flown[leg.sub_cell_id];
    const auto cell = std::ranges::find(plan.sub_cells, leg.sub_cell_id, &coverage::SubCell::id);
    if (cell == plan.sub_cells.end()) {
      faults.push_back(fmt::format("A leg covers sub-cell {}, which is not there.", leg.sub_cell_id));
      continue;
    }
    const double along = (leg.entry_m - cell->alpha_m).norm() + (leg.exit_m - cell->beta_m).norm();
    const double against = (leg.entry_m - cell->beta_m).norm() + (leg.exit_m - cell->alpha_m).norm();
    if (std::min(along, against) > kPlace_m)
      faults.push_back(
          fmt::format("The leg of sub-cell {} does not run between its sites.", leg.sub_cell_id));
  }
  for (const coverage::SubCell& cell : plan.sub_cells) {
    if (flown[cell.id] != 1)
      faults.push_back(
          fmt::format("Sub-cell {} is flown {} times; it must be once.", cell.id, flown[cell.id]));
  }
}

void check_legs(const coverage::Plan& plan, const coverage::Task& task, std::vector<std::string>& faults) {
  double before_s = 0.0;
  for (std::size_t i = 0; i < plan.legs.size(); ++i) {
    const coverage::Leg& leg = plan.legs[i];
    const double fastest_s = (leg.exit_m - leg.entry_m).norm() / task.vehicle.cruise_speed_mps;
    if (leg.start_s < before_s - kTime_s)
      faults.push_back(fmt::format("Leg {} starts at {} s, before the leg before it ends.", i, leg.start_s));
    if (leg.end_s - leg.start_s < fastest_s * (1.0 - 1e-6) - kTime_s)
      faults.push_back(fmt::format("Leg {} takes {} s; at cruise speed it takes {} s.", i,
                                   leg.end_s - leg.start_s, fastest_s));
    if (leg.energy_before > task.battery.capacity + kEnergy ||
        leg.energy_after < task.battery.reserve - kEnergy || leg.energy_after > leg.energy_before + kEnergy) {
      faults.push_back(
          fmt::format("Leg {} goes from {} to {} units of energy; capacity is {}, the reserve {}.", i,
                      leg.energy_before, leg.energy_after, task.battery.capacity, task.battery.reserve));
    }
    before_s = leg.end_s;
  }
  if (!plan.legs.empty() && plan.energy_min < task.battery.reserve - kEnergy) {
    faults.push_back(fmt::format("Energy falls to {} at a landing; the reserve is {}.", plan.energy_min,
                                 task.battery.reserve));
  }
}

/// From bend to bend at no more than its speed; along roads by a plan's own word.
double least_drive_s(const coverage::Task& task, Vec3 at, const std::vector<Vec3>& bends, const Vec3& to) {
  double length_m = 0.0;
  for (const Vec3& bend : bends) {
    length_m += (bend - at).head<2>().norm();
    at = bend;
  }
  return (length_m + (to - at).head<2>().norm()) / task.charger.speed_mps;
}

/// What charging from one energy to another takes at least, in steps of even rate.
double least_charge_s(const coverage::Battery& battery, double from, double to) {
  constexpr int kSteps = 1000;
  const double begin = battery.taper_from * battery.capacity;
  if (battery.taper_from >= 1.0 || to <= begin) return (to - from) * battery.charge_s_per_unit;
  double time_s = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    // The rate at the step's beginning is its greatest.
    const double past = std::max(0.0, from + (to - from) * i / kSteps - begin) / (battery.capacity - begin);
    const double rate = 1.0 - (1.0 - battery.taper_end_rate) * std::min(1.0, past);
    time_s += (to - from) / kSteps * battery.charge_s_per_unit / rate;
  }
  return time_s;
}

void check_robot(const coverage::Plan& plan, const coverage::Task& task, std::vector<std::string>& faults) {
  Vec3 at = task.charger.start_m;
  double free_s = 0.0;
  for (const coverage::Rendezvous& meeting : plan.rendezvous) {
    const double drive_s = least_drive_s(task, at, meeting.robot_bends_m, meeting.site_m);
    if (meeting.robot_arrives_s < free_s + drive_s - kTime_s) {
      faults.push_back(fmt::format("The robot is said to reach rendezvous {} at {} s; it cannot before {} s.",
                                   meeting.id, meeting.robot_arrives_s, free_s + drive_s));
    }
    const double carry_s =
        meeting.carry ? least_drive_s(task, meeting.site_m, meeting.carry_bends_m, meeting.carry_to_m) : 0.0;
    const double charge_s = least_charge_s(task.battery, meeting.energy_from, meeting.charge_to);
    const double together_s = meeting.depart_s - std::max(meeting.robot_arrives_s, meeting.land_s);
    if (together_s < std::max(carry_s, charge_s) - kTime_s) {
      faults.push_back(fmt::format("Rendezvous {} lasts {} s; charging and driving take {} s.", meeting.id,
                                   together_s, std::max(carry_s, charge_s)));
    }
    if (meeting.charge_to > task.battery.capacity + kEnergy)
      faults.push_back(
          fmt::format("Rendezvous {} charges to {}, above capacity.", meeting.id, meeting.charge_to));
    at = meeting.carry ? meeting.carry_to_m : meeting.site_m;
    free_s = meeting.depart_s;
  }
}

}  // namespace

std::vector<std::string> check_cover(const coverage::Plan& plan, const coverage::Task& task) {
  std::vector<std::string> faults;
  check_sub_cells(plan, faults);
  check_legs(plan, task, faults);
  check_robot(plan, task, faults);
  return faults;
}

}  // namespace swallowtail::cli
