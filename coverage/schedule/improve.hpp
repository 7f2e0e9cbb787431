#pragma once

#include <cstdint>
#include <vector>

#include "coverage/schedule/graph.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::coverage {

struct ImproveReport {
  std::vector<Visit> visits;
  double end_s = 0.0;
  std::uint64_t evaluations = 0;
};

/// Local search on the order under the true objective, the end of the schedule with its best stops: turning a
/// leg round, moving a chain of up to three legs (either way round), reversing a stretch. Moves that lengthen
/// the flight by more than a rendezvous costs are not tried. Deterministic; stops at a local optimum or when
/// `stop` (evaluations = schedules computed) says so. `first_free`: visits before it stay where they are.
ImproveReport improve_order(std::span<const SubCell> sub_cells, std::vector<Visit> visits,
                            const ScheduleStart& start, StopPlanner& stops, LinkCache& links,
                            const StopCondition& stop, std::size_t first_free = 0);

/// Strip by strip, to and fro, fields by nearness: the order to fall back on.
std::vector<Visit> boustrophedon_order(std::span<const SubCell> sub_cells, const Vec3& from_m);

}  // namespace swallowtail::coverage
