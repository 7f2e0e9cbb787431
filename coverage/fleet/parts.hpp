#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "coverage/schedule/graph.hpp"
#include "coverage/schedule/plan.hpp"

namespace swallowtail::coverage {

/// The same visits from the last to the first, each the other way round.
std::vector<Visit> turned(std::span<const Visit> visits);

/// Which sub-cells each aircraft flies, in which order and which way round.
struct Parts {
  std::vector<std::vector<Visit>> visits;  ///< by aircraft; none empty
  std::vector<double> end_s;               ///< of their schedules; infinite: none
  double longest_s() const;
};

/// Shares sub-cells out among aircraft so that the longest schedule is short [BEASLEY-1983: route first,
/// cluster second]: `order`, one aircraft's, is cut into stretches of about equal schedules; each is improved
/// by itself; then chains of sub-cells go from the busiest to the others as long as the longest of the two
/// falls. Where the stretches cannot all be reached from the starts, the order is dealt out in turn.
/// Deterministic unless a deadline strikes. `starts` are by aircraft; at most as many as sub-cells.
/// Errors: (kInfeasible) no such shares can be scheduled.
Result<Parts> share_out(std::span<const SubCell> sub_cells, std::span<const Visit> order,
                        std::span<const ScheduleStart> starts, const Task& task, const PlanOptions& options,
                        LinkCache& links);

}  // namespace swallowtail::coverage
