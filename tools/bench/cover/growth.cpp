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

/// A size is begun when it would end in time if the time grew with the power it grew with last, within limits
/// and a little more.
constexpr double kLeastPower = 1.2;
constexpr double kMostPower = 2.0;
constexpr double kCautious = 0.2;

double expected_s(const std::vector<std::pair<double, double>>& points, double size) {
  const auto& [cells, cpu_s] = points.back();
  double power = kMostPower;
  if (points.size() > 1) {
    const auto& [before, before_s] = points[points.size() - 2];
    power = std::log(cpu_s / before_s) / std::log(cells / before) + kCautious;
  }
  return cpu_s * std::pow(size / cells, std::clamp(power, kLeastPower, kMostPower));
}

/// Strips that make about so many sub-cells: how many a strip makes depends on the seed's heights and
/// lengths.
constexpr int kTries = 4;
constexpr double kNearEnough = 0.03;
coverage::Task task_of_size(int sub_cells, std::uint64_t seed) {
  double strips = sub_cells * 2.0 / 3.0;
  coverage::Task out = banded_task(static_cast<int>(strips), seed);
  for (int i = 0; i < kTries; ++i) {
    const std::size_t made = cut_fields(out, planner::Terrain::flat(0.0), {}).sub_cells.size();
    const double ratio = static_cast<double>(sub_cells) / static_cast<double>(std::max<std::size_t>(made, 1));
    if (std::abs(ratio - 1.0) < kNearEnough) break;
    strips = std::max(5.0, strips * ratio);
    out = banded_task(static_cast<int>(strips), seed);
  }
  return out;
}

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
      const double next_s = expected_s(measured.points, size);
      if (next_s > left_s) {
        bench.report.notes.push_back(fmt::format(
            "Growth ends before {} sub-cells: they would take about {:.0f} s of CPU, and {:.0f} s "
            "are left (--budget).",
            size, next_s, std::max(0.0, left_s)));
        break;
      }
    }
    bench.progress.update(fmt::format("growth, {} sub-cells", size));
    const Planned planned = plan_timed(task_of_size(size, seed), seed);
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
