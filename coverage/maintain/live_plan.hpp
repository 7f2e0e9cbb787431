#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coverage/schedule/plan.hpp"

namespace swallowtail::coverage {

/// The plan in force. Legs before legs_done are flown and never change, but that of one that was left out in
/// part what was flown is left when it is done; indexes are stable.
struct LivePlan {
  std::uint32_t revision = 1;
  std::string reason = "first plan";
  std::vector<Leg> legs;
  std::vector<Vec3> approach_m{};      ///< where the flight from the start to the first leg bends, in order
  std::vector<Rendezvous> rendezvous;  ///< those ahead, the one under way included
  std::size_t legs_done = 0;
  double end_s = 0.0;  ///< predicted last landing
  double area_m2 = 0.0;
  std::string lacks{};          ///< of the task, in words: empty where everything is flown or ahead
  double battery_time_s = 0.0;  ///< basis
  double battery_energy = 0.0;
  double vehicle_time_s = 0.0;
};

LivePlan live_plan(const Plan& plan);

/// The first field that is not planned whole, and why; empty where all are.
std::string lacking_field(const std::vector<FieldReport>& fields);

/// Where the way to the next leg bends, now that it begins elsewhere than at the exit of the leg before.
void set_approach(LivePlan& plan, std::vector<Vec3> bends_m);

/// Whether both ask for the same flight from a leg to the next landing.
bool same_sortie(const std::vector<Leg>& a, const std::vector<Leg>& b, std::size_t leg);

/// Takes the aircraft's legs and meetings that are not over by `delay_s` later (or earlier).
void shift_times(LivePlan& plan, std::size_t first_leg, double delay_s);

}  // namespace swallowtail::coverage
