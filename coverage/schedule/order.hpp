#pragma once

#include <span>
#include <vector>

#include "coverage/schedule/improve.hpp"
#include "coverage/schedule/plan.hpp"

namespace swallowtail::coverage {

struct Order {
  std::vector<Visit> visits;
  PlanStatistics statistics;
};

/// In which order and which way round to fly the sub-cells: the layered graph's tour (where one battery does
/// not do, from the default mode on), the tour of the graph without levels (of large tasks: a search by
/// flight alone) and the strip order compete under the true objective; the best is improved. Errors
/// (kInfeasible): no order can be scheduled. (kInterrupted).
Result<Order> find_order(std::span<const SubCell> sub_cells, const ScheduleStart& start, const Task& task,
                         const PlanOptions& options, LinkCache& links);

}  // namespace swallowtail::coverage
