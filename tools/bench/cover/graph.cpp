#include <fmt/core.h>

#include "coverage/schedule/graph.hpp"
#include "planner/base/clock.hpp"
#include "tools/bench/core/statistics.hpp"
#include "tools/bench/cover/parts.hpp"

namespace swallowtail::bench {
namespace {

constexpr int kLevels = 20;
constexpr int kStripsOfAHeight = 20;
/// No two heights are further apart: every pair is linked.
constexpr double kOneLayer_m = 1000.0;

std::vector<coverage::SubCell> strips(int count) {
  std::vector<coverage::SubCell> cells;
  for (int i = 0; i < count; ++i) {
    const double height_m = 20.0 + 5.0 * (i / kStripsOfAHeight);
    cells.push_back({static_cast<std::uint32_t>(i), 1, Vec3(0.0, 10.0 * i, height_m),
                     Vec3(150.0 + i % 7, 10.0 * i, height_m), height_m, 10.0});
  }
  return cells;
}

}  // namespace

Status measure_graph(CoverBench& bench) {
  Table table{"Building the layered graph", {"strips x levels", "vertices", "arcs", "CPU ms", "peers"}, {}};
  const planner::Terrain terrain = planner::Terrain::flat(0.0);
  const ThreadCpuClock clock;
  for (const int count : {10, 80}) {
    for (const double band_m : {0.0, kOneLayer_m}) {
      std::vector<double> cpu_ms;
      coverage::GraphStatistics statistics;
      const std::string name = fmt::format("graph {} x {}", count, kLevels);
      for (int run = 0; run < runs_of(bench.options.base, 5, 1); ++run) {
        bench.progress.update(name);
        coverage::GraphParams params;
        params.levels = kLevels;
        params.height_band_m = band_m;
        coverage::ScheduleStart start;
        start.energy = params.stops.battery.capacity;
        const double began_s = clock.now_s();
        coverage::LinkCache links(coverage::FlightModel({}, {}, terrain), params.stops.charger);
        const auto graph = coverage::LayeredGraph::build(strips(count), start, params, links);
        cpu_ms.push_back(1e3 * (clock.now_s() - began_s));
        if (!graph) return graph.error();
        statistics = graph->statistics();
        bench.add(name + (band_m > 0.0 ? ", full" : ", layers"), bench.options.base.common.seed, "cpu",
                  cpu_ms.back(), "ms");
      }
      table.rows.push_back({fmt::format("{} x {}, {}", count, kLevels, band_m > 0.0 ? "full" : "layers"),
                            std::to_string(statistics.vertices), std::to_string(statistics.edges),
                            significant(median_of(cpu_ms), 3), peers_cell(bench.peers, name)});
    }
  }
  bench.report.tables.push_back(std::move(table));
  return {};
}

}  // namespace swallowtail::bench
