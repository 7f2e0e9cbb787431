#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "planner/base/clock.hpp"
#include "tools/bench/cover/parts.hpp"
#include "tools/bench/cover/tasks.hpp"
#include "tools/bench/plot/chart.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

/// A size is begun when it would end in time if the time grew with this power.
constexpr double kExpectedPower = 1.7;

}  // namespace

Status measure_growth(CoverBench& bench) {
  Table table{"Growth on generated tasks", {"sub-cells", "CPU s", "cost s", "recharges", "peak MiB"}, {}};
  Series measured{"whole plan", {}, {}, {}, false};
  const std::vector<int> sizes = bench.options.base.quick
                                     ? std::vector<int>{50, 100}
                                     : std::vector<int>{50, 100, 200, 500, 1000, 2000, 5000};
  const std::uint64_t seed = bench.options.base.common.seed;
  double left_s = bench.budget_s;
  for (const int size : sizes) {
    if (size > bench.options.max_sub_cells || cli::interrupted()) break;
    if (!measured.points.empty()) {
      const auto& [before, cpu_s] = measured.points.back();
      const double expected_s = cpu_s * std::pow(size / before, kExpectedPower);
      if (expected_s > left_s) {
        bench.report.notes.push_back(fmt::format(
            "Growth ends before {} sub-cells: they would take about {:.0f} s of CPU, and {:.0f} s "
            "are left (--budget).",
            size, expected_s, std::max(0.0, left_s)));
        break;
      }
    }
    bench.progress.update(fmt::format("growth, {} sub-cells", size));
    const Planned planned = plan_timed(banded_task(size * 2 / 3, seed), seed);
    if (!planned.plan) return planned.plan.error();
    const double cpu_s = planned.cpu_ms / 1e3;
    left_s -= cpu_s;
    const auto cells = static_cast<double>(planned.plan->sub_cells.size());
    const std::string name = fmt::format("growth {}", size);
    bench.add(name, seed, "sub_cells", cells, "");
    bench.add(name, seed, "cpu", planned.cpu_ms, "ms");
    bench.add(name, seed, "cost", planned.plan->cost, "s");
    bench.add(name, seed, "peak_memory", process_peak_rss_mb(), "MiB");
    table.rows.push_back({std::to_string(planned.plan->sub_cells.size()), significant(cpu_s, 3),
                          significant(planned.plan->cost, 6), std::to_string(planned.plan->recharges),
                          significant(process_peak_rss_mb(), 3)});
    measured.points.emplace_back(cells, cpu_s);
  }
  bench.report.tables.push_back(std::move(table));
  if (measured.points.size() < 2) return {};
  const Chart chart{"Growth", "sub-cells", "CPU s", Scale::kLog, Scale::kLog, {std::move(measured)}};
  bench.report.figures.push_back({"CPU time of a whole plan against the number of sub-cells.", draw(chart)});
  return {};
}

}  // namespace swallowtail::bench
