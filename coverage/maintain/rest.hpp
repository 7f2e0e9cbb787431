#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coverage/maintain/live_plan.hpp"
#include "coverage/schedule/improve.hpp"
#include "coverage/schedule/task.hpp"

namespace swallowtail::coverage {

/// What is still to be flown, in an order to begin with. Legs are given as they would be flown.
struct Rest {
  std::vector<Leg> legs;
  /// So many at the front stay where they are; aloft there is no landing before the last of them is flown.
  std::size_t fixed = 0;
};

struct RestParams {
  StopParams stops;
  StopCondition stop;  ///< of the local search
  std::uint64_t schedules = 400;
};

struct RestPlan {
  std::vector<Leg> legs;
  /// Where the way from the start to the first of them bends; aloft and not straight, from where it began on.
  std::vector<Vec3> approach_m;
  std::vector<Rendezvous> rendezvous;
  std::optional<Recharge> first;  ///< when it starts docked
  double end_s = 0.0;
};

/// Schedules the rest from a state in the middle of the mission, warm: the given order, improved; from the
/// ground begun farther on where it cannot be flown as it is. Nothing when even that cannot be flown with the
/// reserve kept.
std::optional<RestPlan> plan_rest(const Rest& rest, const ScheduleStart& start, std::size_t first_index,
                                  const FlightModel& model, const RestParams& params);

/// Of legs that cannot all be flown with the robot's help, what hinders it.
std::string why_no_rest(std::span<const Leg> legs, const FlightModel& model, const StopParams& stops);

}  // namespace swallowtail::coverage
