#include <algorithm>
#include <limits>
#include <numeric>

#include <fmt/core.h>

#include "coverage/field/sweep.hpp"
#include "tools/bench/core/statistics.hpp"
#include "tools/bench/cover/holed_field.hpp"
#include "tools/bench/cover/parts.hpp"
#include "tools/bench/cover/tasks.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

constexpr double kWidth_m = 10.0;
/// One charge lasts: the costs compared are those of flying.
constexpr double kCapacity = 1e5;
constexpr std::size_t kDirections = 6;

/// Fields of so many holes, seen by a sensor of a width.
struct Size {
  int holes = 0;
  double width_m = 10.0;
};

std::string name_of(const Size& size) {
  return size.width_m == kWidth_m ? fmt::format("holes {}", size.holes)
                                  : fmt::format("holes {}, {:g} m", size.holes, size.width_m);
}

struct Family {
  std::vector<double> cpu_ms;
  std::vector<double> below_percent;  ///< cost below the best single direction
};

coverage::Task holed_task(const Size& size, std::uint64_t seed) {
  HoledFieldParams params;
  params.holes = size.holes;
  params.hole_corners = size.holes * 64 / 15;
  coverage::Field field{1, name_of(size), holed_field(seed, params), 20.0};
  coverage::Task task = task_of(field);
  task.sensor_width_m = size.width_m;
  task.battery.capacity = kCapacity;
  return task;
}

/// The least cost of the directions that promise most.
double best_single_direction(coverage::Task task, std::uint64_t seed) {
  double best = std::numeric_limits<double>::infinity();
  const coverage::SweepParams params{task.sensor_width_m, task.sensor_width_m};
  for (const double sweep_rad : best_sweeps_rad(task.fields.front().polygon, params, kDirections)) {
    task.sweep_rad = sweep_rad;
    const Planned planned = plan_timed(task, seed);
    if (planned.plan) best = std::min(best, planned.plan->cost);
  }
  return best;
}

Status measure_one(CoverBench& bench, const Size& size, std::uint64_t seed, Family& family) {
  const coverage::Task task = holed_task(size, seed);
  const Planned planned = plan_timed(task, seed);
  if (!planned.plan) return planned.plan.error();
  const double single = best_single_direction(task, seed);
  family.cpu_ms.push_back(planned.cpu_ms);
  family.below_percent.push_back(100.0 * (1.0 - planned.plan->cost / single));
  const std::string name = name_of(size);
  bench.add(name, seed, "cpu", planned.cpu_ms, "ms");
  bench.add(name, seed, "cost", planned.plan->cost, "s");
  bench.add(name, seed, "best_single_direction", single, "s");
  bench.add(name, seed, "covered", planned.plan->covered_percent, "%");
  return {};
}

}  // namespace

Status measure_holes(CoverBench& bench) {
  Table table{"Random fields with holes, 100 m across",
              {"holes", "sensor m", "fields", "CPU ms median", "worst",
               "cost below the best single direction % median", "mean", "least", "peers"},
              {}};
  const int seeds = runs_of(bench.options.base, 10, 1);
  const std::vector<Size> sizes =
      bench.options.base.quick
          ? std::vector<Size>{{0, kWidth_m}, {5, kWidth_m}}
          : std::vector<Size>{{15, kWidth_m}, {15, 3.0}, {10, kWidth_m}, {5, kWidth_m}, {0, kWidth_m}};
  const ThreadCpuClock clock;
  const double ends_s = clock.now_s() + bench.budget_s;
  for (std::size_t at = 0; at < sizes.size(); ++at) {
    // Of the time that is left each size has its share.
    const double left_s = std::max(0.0, ends_s - clock.now_s());
    const double until_s = clock.now_s() + left_s / static_cast<double>(sizes.size() - at);
    const std::string name = name_of(sizes[at]);
    Family family;
    for (int i = 0; i < seeds && !cli::interrupted() && clock.now_s() < until_s; ++i) {
      bench.progress.update(fmt::format("{}, field {} of {}", name, i + 1, seeds));
      const std::uint64_t seed = bench.options.base.common.seed + static_cast<std::uint64_t>(i);
      if (const Status status = measure_one(bench, sizes[at], seed, family); !status) return status;
    }
    const auto done = static_cast<int>(family.cpu_ms.size());
    if (done < seeds)
      bench.report.notes.push_back(fmt::format("{}: {} of {} fields (--budget).", name, done, seeds));
    if (done == 0) continue;
    const Quartiles cpu_ms = quartiles_of(family.cpu_ms);
    const Quartiles below = quartiles_of(family.below_percent);
    const double mean = std::accumulate(family.below_percent.begin(), family.below_percent.end(), 0.0) / done;
    table.rows.push_back({std::to_string(sizes[at].holes), fmt::format("{:g}", sizes[at].width_m),
                          std::to_string(done), significant(cpu_ms.median, 3), significant(cpu_ms.max, 3),
                          fmt::format("{:.1f}", below.median), fmt::format("{:.1f}", mean),
                          fmt::format("{:.1f}", below.min),
                          peers_cell(bench.peers, fmt::format("holes {}", sizes[at].holes))});
  }
  bench.report.tables.push_back(std::move(table));
  return {};
}

}  // namespace swallowtail::bench
