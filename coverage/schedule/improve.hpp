#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "coverage/schedule/graph.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::coverage {

/// What an order is judged by.
enum class Aim : std::uint8_t {
  kFlight,    ///< time flown from leg to leg, as if the battery lasted
  kSchedule,  ///< end of the schedule with its best stops
};

struct ImproveParams {
  StopParams stops;
  Aim aim = Aim::kSchedule;
  StopCondition stop;  ///< evaluations: schedules looked at (none with kFlight)
  /// Looked at by schedules, besides: those of short legs take long.
  std::uint64_t flights = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t kicks = 0;
  std::size_t first_free = 0;  ///< visits before it stay where they are
  std::uint64_t seed = 1;
};

struct ImproveReport {
  std::vector<Visit> visits;
  double end_s = 0.0;  ///< of the schedule, or time flown from leg to leg
  std::uint64_t evaluations = 0;
};

/// Local search on the order: turning a stretch round, moving a chain of up to three legs (either way round)
/// to where a site near one of its ends is, each leg looked at again only when
/// something near it has changed. At a local optimum two neighbouring stretches change places at random and
/// it goes on from there, back when that was no better. Under kSchedule, moves that lengthen the flight by
/// more than a rendezvous costs are not tried. Where charging is not linear the search takes its mean rate,
/// and the true schedules of what it began and ended with decide. Deterministic; stops when `stop` says so.
ImproveReport improve_order(std::span<const SubCell> sub_cells, std::vector<Visit> visits,
                            const ScheduleStart& start, LinkCache& links, const ImproveParams& params);

/// Strip by strip, to and fro, fields by nearness: the order to fall back on.
std::vector<Visit> boustrophedon_order(std::span<const SubCell> sub_cells, const Vec3& from_m);

}  // namespace swallowtail::coverage
