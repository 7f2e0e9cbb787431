#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "coverage/gtsp/solver.hpp"
#include "coverage/schedule/stops.hpp"
#include "coverage/schedule/task.hpp"

namespace swallowtail::coverage {

/// A sub-cell and the way it is flown.
struct Visit {
  std::size_t sub_cell = 0;
  bool from_beta = false;  ///< entered at β, left at α
  bool operator==(const Visit&) const = default;
};

FlownLeg flown(const SubCell& sub_cell, bool from_beta);
RouteLeg route_leg(const SubCell& sub_cell, const Visit& visit);

struct GraphParams {
  StopParams stops;
  double height_band_m = 0.0;
  int neighbours = 5;
  int levels = 10;  ///< 1: battery left out, one vertex per site
};

struct GraphStatistics {
  int vertices = 0;
  std::size_t edges = 0;
  int neighbours = 0;  ///< X after widening
};

/// The layered GTSP instance [COV 4]: cluster 0 is the start; cluster i + 1 is sub-cell i with vertices
/// (entry site, energy level on entry). An edge exists between sub-cells within the height band or among each
/// other's X nearest; X is widened until all hang together. Its cost is the least of the five transfers plus
/// the time to cover the sub-cell it leads to. Departs from [COV]: of several levels that an uncharged flight
/// could be taken to arrive with only the highest gets an edge, since the others cannot be better.
class LayeredGraph {
 public:
  /// Errors (kInfeasible): no sub-cell can be flown with the battery. Preconditions: at least one sub-cell;
  /// ids of sub-cells unique.
  static Result<LayeredGraph> build(std::span<const SubCell> sub_cells, const ScheduleStart& start,
                                    const GraphParams& params, LinkCache& links);

  const gtsp::Instance& instance() const { return instance_; }
  const GraphStatistics& statistics() const { return statistics_; }
  int start_vertex() const { return 0; }
  /// The visits of a tour that begins at the start vertex.
  std::vector<Visit> decode(std::span<const int> tour) const;
  /// A tour for given visits at the highest levels, to start the solver from.
  std::vector<int> encode(std::span<const Visit> visits) const;

 private:
  LayeredGraph(gtsp::Instance instance, GraphStatistics statistics, int levels)
      : instance_(std::move(instance)), statistics_(statistics), levels_(levels) {}

  gtsp::Instance instance_;
  GraphStatistics statistics_;
  int levels_;
};

}  // namespace swallowtail::coverage
