#pragma once

#include <string>
#include <vector>

#include "tools/bench/core/options.hpp"
#include "tools/bench/core/report.hpp"
#include "tools/bench/cover/peers.hpp"
#include "tools/cli/progress.hpp"

/// What `bench cover` is made of. Each part adds its rows, tables and figures to the report, and a note where
/// its CPU time ran out before it was through.
namespace swallowtail::bench {

struct CoverOptions {
  Options base;
  std::string fields;  ///< folder of field files; empty: the real ones where they are there, else the shipped
  std::vector<std::string> parts;  ///< empty: all
  int max_sub_cells = 5'000;       ///< of the growth
  double budget_s = 180.0;         ///< CPU seconds of all parts together
};

struct CoverBench {
  const CoverOptions& options;
  const std::vector<CoverPeer>& peers;
  cli::Progress& progress;
  Report& report;
  double budget_s = 0.0;  ///< of this part

  void add(const std::string& case_name, std::uint64_t seed, const std::string& metric, double value,
           const std::string& unit);
};

/// Every field of a folder: planned or refused, covered, time and cost.
Status measure_parcels(CoverBench& bench);
/// Random fields of 0 to 15 holes: time, and cost against the best single direction.
Status measure_holes(CoverBench& bench);
/// Building the layered graph.
Status measure_graph(CoverBench& bench);
/// Time, memory and cost of whole plans from 50 sub-cells on.
Status measure_growth(CoverBench& bench);
/// A battery that has lost so much in flight that the plan's next landing is out of reach: the rest solved
/// warm, against the same rest solved cold.
Status measure_repair(CoverBench& bench);

}  // namespace swallowtail::bench
