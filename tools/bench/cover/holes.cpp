#include <algorithm>
#include <limits>

#include <fmt/core.h>

#include "coverage/field/sweep.hpp"
#include "tools/bench/core/statistics.hpp"
#include "tools/bench/cover/holed_field.hpp"
#include "tools/bench/cover/parts.hpp"
#include "tools/bench/cover/tasks.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

constexpr double kSensorWidth_m = 3.0;
/// One charge lasts: the costs compared are those of flying.
constexpr double kCapacity = 1e5;
constexpr std::size_t kDirections = 6;

struct Family {
  std::vector<double> cpu_ms;
  std::vector<double> below_percent;  ///< cost below the best single direction
};

coverage::Task holed_task(int holes, std::uint64_t seed) {
  HoledFieldParams params;
  params.holes = holes;
  params.hole_corners = holes * 64 / 15;
  coverage::Field field{1, fmt::format("holes {}", holes), holed_field(seed, params), 20.0};
  coverage::Task task = task_of(field);
  task.sensor_width_m = kSensorWidth_m;
  task.battery.capacity = kCapacity;
  return task;
}

/// The least cost of the directions that promise most.
double best_single_direction(coverage::Task task, std::uint64_t seed) {
  double best = std::numeric_limits<double>::infinity();
  const coverage::SweepParams params{kSensorWidth_m, kSensorWidth_m};
  for (const double sweep_rad : best_sweeps_rad(task.fields.front().polygon, params, kDirections)) {
    task.sweep_rad = sweep_rad;
    const Planned planned = plan_timed(task, seed);
    if (planned.plan) best = std::min(best, planned.plan->cost);
  }
  return best;
}

Status measure_one(CoverBench& bench, int holes, std::uint64_t seed, Family& family) {
  const coverage::Task task = holed_task(holes, seed);
  const Planned planned = plan_timed(task, seed);
  if (!planned.plan) return planned.plan.error();
  const double single = best_single_direction(task, seed);
  family.cpu_ms.push_back(planned.cpu_ms);
  family.below_percent.push_back(100.0 * (1.0 - planned.plan->cost / single));
  const std::string name = fmt::format("holes {}", holes);
  bench.add(name, seed, "cpu", planned.cpu_ms, "ms");
  bench.add(name, seed, "cost", planned.plan->cost, "s");
  bench.add(name, seed, "best_single_direction", single, "s");
  bench.add(name, seed, "covered", planned.plan->covered_percent, "%");
  return {};
}

}  // namespace

Status measure_holes(CoverBench& bench) {
  Table table{fmt::format("Random fields with holes, 100 m across, strips of {:g} m", kSensorWidth_m),
              {"holes", "fields", "CPU ms median", "worst", "cost below the best single direction % median",
               "least", "peers"},
              {}};
  const int seeds = runs_of(bench.options.base, 10, 1);
  const std::vector<int> sizes =
      bench.options.base.quick ? std::vector<int>{0, 5} : std::vector<int>{15, 10, 5, 0};
  const ThreadCpuClock clock;
  const double ends_s = clock.now_s() + bench.budget_s;
  for (const int holes : sizes) {
    Family family;
    for (int i = 0; i < seeds && !cli::interrupted() && clock.now_s() < ends_s; ++i) {
      bench.progress.update(fmt::format("{} holes, field {} of {}", holes, i + 1, seeds));
      const std::uint64_t seed = bench.options.base.common.seed + static_cast<std::uint64_t>(i);
      if (const Status status = measure_one(bench, holes, seed, family); !status) return status;
    }
    if (family.cpu_ms.empty()) {
      bench.report.notes.push_back(fmt::format("Fields with {} holes left out (--budget).", holes));
      continue;
    }
    const Quartiles cpu_ms = quartiles_of(family.cpu_ms);
    const Quartiles below = quartiles_of(family.below_percent);
    table.rows.push_back({std::to_string(holes), std::to_string(cpu_ms.count), significant(cpu_ms.median, 3),
                          significant(cpu_ms.max, 3), fmt::format("{:.1f}", below.median),
                          fmt::format("{:.1f}", below.min),
                          peers_cell(bench.peers, fmt::format("holes {}", holes))});
  }
  bench.report.tables.push_back(std::move(table));
  return {};
}

}  // namespace swallowtail::bench
