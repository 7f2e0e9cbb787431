#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "coverage/schedule/plan.hpp"
#include "coverage/schedule/stops.hpp"

namespace swallowtail::coverage {

struct Expansion {
  std::vector<Vec3> approach_m;
  std::vector<Leg> legs;
  std::vector<Rendezvous> rendezvous;
};

/// Writes a schedule out as legs and rendezvous. `first_index` is the plan index of the first visit. A
/// recharge before the first sortie is not among the rendezvous: it belongs to what came before.
Expansion expand(std::span<const SubCell> sub_cells, std::span<const Visit> visits,
                 const ScheduleStart& start, const StopPlan& stops, LinkCache& links,
                 std::size_t first_index);

/// Sums of a schedule, added to the plan: flight, waiting, recharges, least energy, cost and makespan.
void add_totals(const StopPlan& stops, const ScheduleStart& start, Plan& plan);

}  // namespace swallowtail::coverage
