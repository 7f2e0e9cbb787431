#include <algorithm>

#include <fmt/core.h>

#include "coverage/maintain/rest.hpp"
#include "coverage/schedule/order.hpp"
#include "planner/base/rng.hpp"
#include "tools/bench/core/statistics.hpp"
#include "tools/bench/cover/parts.hpp"
#include "tools/bench/cover/tasks.hpp"
#include "tools/cli/common.hpp"

namespace swallowtail::bench {
namespace {

using namespace coverage;

constexpr int kBreaksPerTask = 6;
/// As PlanKeeper takes for a flight under way.
constexpr double kAirFactor = 1.06;
constexpr double kReaction_s = 1.0;

/// The moment at which the battery's sample comes.
struct Break {
  std::size_t leg = 0;
  ScheduleStart start;
  Rest rest;
};

/// Where the plan's robot is when nothing has gone wrong.
Vec3 robot_at(const Plan& plan, const Task& task, double time_s) {
  Vec3 at_m = task.charger.start_m;
  for (const Rendezvous& meeting : plan.rendezvous) {
    if (meeting.depart_s <= time_s) at_m = meeting.carry ? meeting.carry_to_m : meeting.site_m;
  }
  return at_m;
}

/// In the middle of a leg with about `left` more to fly, with so little energy that the landing planned next
/// would not keep the reserve; nothing when no landing lies ahead.
std::optional<Break> break_of(const Plan& plan, const Task& task, int left, Rng& rng) {
  const std::size_t ahead = static_cast<std::size_t>(left) + rng.below(10);
  if (plan.legs.size() <= ahead) return std::nullopt;
  Break out;
  out.leg = plan.legs.size() - ahead;
  const auto next = std::ranges::find_if(
      plan.rendezvous, [&](const Rendezvous& meeting) { return legs_before(meeting.id) > out.leg; });
  if (next == plan.rendezvous.end()) return std::nullopt;
  const Leg& leg = plan.legs[out.leg];
  const double flown = rng.uniform(0.1, 0.9);
  out.start.kind = StartKind::kAir;
  out.start.position_m = leg.entry_m + flown * (leg.exit_m - leg.entry_m);
  out.start.direction = leg.exit_m - leg.entry_m;
  out.start.time_s = leg.start_s + flown * (leg.end_s - leg.start_s);
  const double energy = leg.energy_before + flown * (leg.energy_after - leg.energy_before);
  const double to_spare = next->energy_from - task.battery.reserve;
  out.start.energy = energy - to_spare - rng.uniform(0.01, 0.08) * task.battery.capacity;
  out.start.robot_m = robot_at(plan, task, out.start.time_s);
  out.start.robot_free_s = out.start.time_s;
  out.rest.legs.assign(plan.legs.begin() + static_cast<std::ptrdiff_t>(out.leg), plan.legs.end());
  out.rest.legs.front().entry_m = out.start.position_m;
  out.rest.fixed = 1;
  return out;
}

struct Repairs {
  std::vector<double> warm_ms;
  std::vector<double> cold_ms;
  std::vector<double> gap_percent;
  int broken_off = 0;
  int landed_at_once = 0;
  int not_planned = 0;
};

/// What the schedule begins with.
enum class Ending : std::uint8_t { kFinishesLeg, kBreaksOff, kLandsAtOnce };

class TaskRepair {
 public:
  TaskRepair(const Task& task, const Plan& plan)
      : task_(task),
        terrain_(planner::Terrain::flat(0.0)),
        ways_(ways_of(task, plan.polygons)),
        model_(task.vehicle, task.battery.model, terrain_, &ways_) {
    params_.stops = stop_params(task, {});
    params_.stops.air_factor = kAirFactor;
  }

  /// As PlanKeeper does: the leg under way is finished; or it may end a little ahead, with a landing that
  /// keeps the reserve; or the aircraft lands there whatever that leaves, and waits for the robot.
  std::optional<RestPlan> warm(const Break& broken, Ending& ending) const {
    ending = Ending::kFinishesLeg;
    auto found = plan_rest(broken.rest, broken.start, broken.leg, model_, params_);
    if (found) return found;
    ending = Ending::kBreaksOff;
    const Rest split = split_ahead(broken);
    found = plan_rest(split, broken.start, broken.leg, model_, params_);
    if (found) return found;
    ending = Ending::kLandsAtOnce;
    return land_at_once(split, broken);
  }

  /// The legs after the one under way ordered from nothing, then scheduled as the warm ones are.
  std::optional<RestPlan> cold(const Break& broken) const {
    const std::vector<Leg>& legs = broken.rest.legs;
    std::vector<SubCell> cells;
    for (std::size_t i = 1; i < legs.size(); ++i)
      cells.push_back({static_cast<std::uint32_t>(i - 1), legs[i].field_id, legs[i].entry_m, legs[i].exit_m,
                       legs[i].height_m, legs[i].width_m});
    ScheduleStart start = broken.start;
    const FlightCost under_way = model_.level(start.position_m, legs.front().exit_m);
    start.position_m = legs.front().exit_m;
    start.energy -= under_way.energy;
    start.time_s += under_way.time_s;
    LinkCache links(model_, task_.charger);
    const auto order = find_order(cells, start, task_, {}, links);
    if (!order) return std::nullopt;
    Rest rest{{legs.front()}, 1};
    for (const Visit& visit : order->visits) {
      Leg leg = legs[visit.sub_cell + 1];
      if (visit.from_beta) std::swap(leg.entry_m, leg.exit_m);
      rest.legs.push_back(leg);
    }
    RestParams as_ordered = params_;
    as_ordered.schedules = 0;
    return plan_rest(rest, broken.start, broken.leg, model_, as_ordered);
  }

 private:
  Rest split_ahead(const Break& broken) const {
    Rest out = broken.rest;
    Leg& first = out.legs.front();
    const Vec3 along = first.exit_m - first.entry_m;
    const double step_m = kReaction_s * task_.vehicle.cruise_speed_mps;
    if (along.norm() < step_m + 1.0) return out;
    Leg after = first;
    after.entry_m = first.exit_m = first.entry_m + along.normalized() * step_m;
    out.legs.insert(out.legs.begin() + 1, after);
    return out;
  }

  std::optional<RestPlan> land_at_once(const Rest& split, const Break& broken) const {
    const Vec3 above = split.legs.front().exit_m;
    const FlightCost down = model_.level(broken.start.position_m, above) + model_.landing(above);
    ScheduleStart docked;
    docked.kind = StartKind::kDocked;
    docked.position_m = model_.ground(above);
    docked.energy = std::max(0.0, broken.start.energy - down.energy);
    docked.time_s =
        std::max(broken.start.time_s + down.time_s,
                 broken.start.robot_free_s + drive_s(task_.charger, broken.start.robot_m, above)) +
        task_.charger.landing_s;
    return plan_rest({{split.legs.begin() + 1, split.legs.end()}, 0}, docked, broken.leg + 1, model_,
                     params_);
  }

  const Task& task_;
  planner::Terrain terrain_;
  Ways ways_;
  FlightModel model_;
  RestParams params_;
};

/// Whether it was compared with a schedule made cold.
bool repair(CoverBench& bench, const TaskRepair& task, const Break& broken, std::uint64_t seed,
            bool with_cold, Repairs& repairs) {
  const ThreadCpuClock clock;
  const double began_s = clock.now_s();
  Ending ending = Ending::kFinishesLeg;
  const auto warm = task.warm(broken, ending);
  const double warm_ms = 1e3 * (clock.now_s() - began_s);
  if (!warm) {
    ++repairs.not_planned;
    return false;
  }
  repairs.broken_off += ending == Ending::kBreaksOff ? 1 : 0;
  repairs.landed_at_once += ending == Ending::kLandsAtOnce ? 1 : 0;
  repairs.warm_ms.push_back(warm_ms);
  bench.add("repair", seed, "warm_cpu", warm_ms, "ms");
  if (ending != Ending::kFinishesLeg || !with_cold) return false;
  const double cold_began_s = clock.now_s();
  const auto cold = task.cold(broken);
  if (!cold) return true;
  repairs.cold_ms.push_back(1e3 * (clock.now_s() - cold_began_s));
  const double now_s = broken.start.time_s;
  repairs.gap_percent.push_back(100.0 * ((warm->end_s - now_s) / (cold->end_s - now_s) - 1.0));
  bench.add("repair", seed, "cold_cpu", repairs.cold_ms.back(), "ms");
  bench.add("repair", seed, "warm_above_cold", repairs.gap_percent.back(), "%");
  return true;
}

std::string quantile_cell(std::vector<double> values, double share) {
  if (values.empty()) return "-";
  std::ranges::sort(values);
  return significant(quantile(values, share), 3);
}

}  // namespace

Status measure_repair(CoverBench& bench) {
  const int left = bench.options.base.quick ? 30 : 200;
  const int tasks = runs_of(bench.options.base, 20, 1);
  const ThreadCpuClock clock;
  const double ends_s = clock.now_s() + bench.budget_s;
  Repairs repairs;
  int done = 0;
  for (int i = 0; i < tasks && !cli::interrupted() && clock.now_s() < ends_s; ++i, ++done) {
    const std::uint64_t seed = bench.options.base.common.seed + static_cast<std::uint64_t>(i);
    bench.progress.update(fmt::format("repair, task {} of {}", i + 1, tasks));
    const Task task = banded_task(left, seed);
    const Planned planned = plan_timed(task, seed);
    if (!planned.plan) return planned.plan.error();
    const TaskRepair solver(task, *planned.plan);
    Rng rng(seed);
    bool compare = true;
    for (int sample = 0; sample < kBreaksPerTask; ++sample) {
      const auto broken = break_of(*planned.plan, task, left, rng);
      if (broken && repair(bench, solver, *broken, seed, compare, repairs)) compare = false;
    }
  }
  Table table{fmt::format("Battery sample that breaks the plan, about {} sub-cells left", left),
              {"samples", "leg broken off", "lands at once", "not planned", "warm CPU ms median", "p99",
               "cold CPU ms median", "warm above cold % median", "worst"},
              {}};
  table.rows.push_back({std::to_string(repairs.warm_ms.size()), std::to_string(repairs.broken_off),
                        std::to_string(repairs.landed_at_once), std::to_string(repairs.not_planned),
                        quantile_cell(repairs.warm_ms, 0.5), quantile_cell(repairs.warm_ms, 0.99),
                        quantile_cell(repairs.cold_ms, 0.5), quantile_cell(repairs.gap_percent, 0.5),
                        quantile_cell(repairs.gap_percent, 1.0)});
  bench.report.tables.push_back(std::move(table));
  if (done < tasks)
    bench.report.notes.push_back(fmt::format("Repair: {} of {} tasks (--budget).", done, tasks));
  return {};
}

}  // namespace swallowtail::bench
