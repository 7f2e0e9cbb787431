#include "coverage/fleet/fleet.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include "coverage/fleet/apart.hpp"
#include "coverage/fleet/parts.hpp"
#include "coverage/fleet/starts.hpp"
#include "coverage/schedule/expand.hpp"
#include "coverage/schedule/robot_trips.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

/// Starts stand farther apart than the separation asks by this.
constexpr double kStartSlack_m = 1.0;

Status validate(const FleetOptions& fleet) {
  if (fleet.aircraft < 1 || fleet.aircraft > kMaxAircraft)
    return bad_input("The number of aircraft must be 1 to " + std::to_string(kMaxAircraft) + ", and is " +
                     std::to_string(fleet.aircraft) + ".");
  const Separation& apart = fleet.separation;
  if (!is_positive(apart.horizontal_m) || !is_positive(apart.vertical_m) || !is_positive(apart.landed_m))
    return bad_input("The distances that aircraft keep must be positive numbers of metres.");
  return {};
}

std::vector<Visit> visits_of(const Plan& plan) {
  std::vector<Visit> out;
  for (const Leg& leg : plan.legs) {
    const SubCell& cell = plan.sub_cells[leg.sub_cell_id];
    out.push_back(
        {leg.sub_cell_id, (leg.entry_m - cell.beta_m).norm() < (leg.entry_m - cell.alpha_m).norm()});
  }
  return out;
}

ScheduleStart start_of(const Task& task, const FlightModel& model) {
  ScheduleStart out;
  out.position_m = model.ground(task.start_m);
  out.energy = task.battery.capacity;
  out.robot_m = task.charger.start_m;
  return out;
}

/// The plan of some visits, with what the whole task's plan says of fields.
std::optional<Plan> plan_of(const Plan& whole, std::span<const Visit> visits, const ScheduleStart& start,
                            const StopParams& params, LinkCache& links) {
  std::vector<RouteLeg> route;
  for (const Visit& visit : visits) route.push_back(route_leg(whole.sub_cells[visit.sub_cell], visit));
  const std::optional<StopPlan> schedule = StopPlanner(links, params).plan(route, start);
  if (!schedule) return std::nullopt;
  Plan out;
  out.status = whole.status;
  out.fields = whole.fields;
  out.notes = whole.notes;
  out.polygons = whole.polygons;
  out.area_m2 = whole.area_m2;
  out.covered_percent = whole.covered_percent;
  out.statistics = whole.statistics;
  Expansion expansion = expand(whole.sub_cells, visits, start, *schedule, links, 0);
  out.approach_m = std::move(expansion.approach_m);
  out.legs = std::move(expansion.legs);
  out.rendezvous = std::move(expansion.rendezvous);
  for (const Visit& visit : visits) out.sub_cells.push_back(whole.sub_cells[visit.sub_cell]);
  std::ranges::sort(out.sub_cells, {}, &SubCell::id);
  add_totals(*schedule, start, out);
  return out;
}

using Visits = std::vector<Visit>;

/// Other ends for an aircraft whose last landing is in another's way.
constexpr int kWays = 3;
Visits way_of(const Visits& visits, int way) {
  if (way == 1) return turned(visits);
  Visits out = visits;
  if (way == 2) out.back().from_beta = !out.back().from_beta;
  return out;
}

/// Of so many ways that can be kept apart the best is taken; none is looked for any more when waiting costs
/// but a share of the makespan.
constexpr int kFoundWays = 20;
/// And none is looked for when so many cannot.
constexpr int kFailedWays = 30;
constexpr double kEnough = 1.01;

double last_landing_s(const std::vector<Member>& members) {
  double out = 0.0;
  for (const Member& member : members) out = std::max(out, member.plan.makespan_s);
  return out;
}

/// Which way each aircraft flies, the fewest changes first.
constexpr std::size_t kMostWays = 100;
std::vector<std::vector<int>> ways_of_fleet(std::size_t aircraft) {
  std::vector<std::vector<int>> out{std::vector<int>(aircraft, 0)};
  // Each changes one aircraft more than what it is made from, past those that are changed already.
  for (std::size_t from = 0; from < out.size() && out.size() < kMostWays; ++from) {
    std::size_t next = aircraft;
    while (next > 0 && out[from][next - 1] == 0) --next;
    for (std::size_t k = next; k < aircraft; ++k) {
      for (int way = 1; way < kWays; ++way) {
        out.push_back(out[from]);
        out.back()[k] = way;
      }
    }
  }
  return out;
}

using MembersOf = std::function<Result<std::vector<Member>>(const std::vector<int>&)>;

/// The best of some ways that can be kept apart. `members_of` is infeasible where a way cannot be flown.
Status keep_apart(const MembersOf& members_of, std::size_t aircraft, double undelayed_s,
                  const PlanOptions& options, const FlightModel& model, FleetPlan& out) {
  Status separated;
  out.makespan_s = std::numeric_limits<double>::infinity();
  int found = 0;
  int failed = 0;
  for (const std::vector<int>& way : ways_of_fleet(aircraft)) {
    if (options.stop.interrupted())
      return Error{Error::Code::kInterrupted, "Interrupted before the aircraft were kept apart."};
    Result<std::vector<Member>> made = members_of(way);
    if (!made) {
      if (found == 0 && separated) separated = made.error();
      continue;
    }
    std::vector<Member>& members = *made;
    Status status = separate(members, out.separation, model);
    if (!status) {
      // Robots that are done leave the way to others.
      for (Member& member : members) send_home(member, model);
      status = separate(members, out.separation, model);
    }
    if (status || found == 0) separated = status;
    if (!status && ++failed == kFailedWays && found == 0) break;
    if (!status) continue;
    ++found;
    if (last_landing_s(members) < out.makespan_s) {
      out.makespan_s = last_landing_s(members);
      out.members = std::move(members);
    }
    if (found == kFoundWays || out.makespan_s <= kEnough * undelayed_s) break;
  }
  return separated;
}

}  // namespace

Result<FleetPlan> plan_fleet(const Task& task, const planner::Terrain& terrain, const PlanOptions& options,
                             const FleetOptions& fleet) {
  if (const Status status = validate(fleet); !status) return status.error();
  Plan whole;
  if (fleet.alone != nullptr) {
    whole = *fleet.alone;
  } else {
    Result<Plan> alone = plan_coverage(task, terrain, options);
    if (!alone) return alone.error();
    whole = std::move(*alone);
  }
  if (static_cast<std::size_t>(fleet.aircraft) > whole.sub_cells.size())
    return bad_input("There are " + std::to_string(fleet.aircraft) + " aircraft and only " +
                     std::to_string(whole.sub_cells.size()) + " sub-cells to fly.");
  const double landed_m = fleet.separation.landed_m;
  const StartsApart apart{std::max(fleet.separation.horizontal_m, landed_m) + kStartSlack_m,
                          landed_m + kStartSlack_m};
  Result<std::vector<Task>> tasks = fleet.starts_m.empty()
                                        ? tasks_of_fleet(task, fleet.aircraft, apart)
                                        : tasks_from_starts(task, fleet.aircraft, apart, fleet.starts_m);
  if (!tasks) return tasks.error();
  const Ways ways = ways_of(task, whole.polygons);
  const FlightModel model(task.vehicle, task.battery.model, terrain, &ways);
  LinkCache links(model, task.charger);
  std::vector<ScheduleStart> starts;
  for (const Task& one : *tasks) starts.push_back(start_of(one, model));
  const std::vector<Visit> order = visits_of(whole);
  Result<Parts> parts = share_out(whole.sub_cells, order, starts, task, options, links);
  if (!parts) return parts.error();
  FleetPlan out;
  out.separation = fleet.separation;
  out.alone_s = whole.makespan_s;
  const auto members_of = [&](const std::vector<int>& way) -> Result<std::vector<Member>> {
    std::vector<Member> members;
    for (std::size_t k = 0; k < starts.size(); ++k) {
      std::optional<Plan> plan =
          plan_of(whole, way_of(parts->visits[k], way[k]), starts[k], stop_params(task, options), links);
      if (!plan) return infeasible("The share of an aircraft cannot be scheduled.");
      if (const Status limited = limit_robot((*tasks)[k], model, *plan); !limited) return limited.error();
      members.push_back({(*tasks)[k], std::move(*plan), 0.0});
    }
    return members;
  };
  const Status separated = keep_apart(members_of, starts.size(), parts->longest_s(), options, model, out);
  if (!separated) return separated.error();
  if (!are_apart(out.members, fleet.separation, model))
    return internal_error("Two aircraft of the schedule found come too close.");
  return out;
}

Result<FleetPlan> plan_useful_fleet(const Task& task, const planner::Terrain& terrain,
                                    const PlanOptions& options, const FleetOptions& fleet) {
  if (const Status status = validate(fleet); !status) return status.error();
  FleetOptions asked = fleet;
  std::optional<Plan> made;
  if (asked.alone == nullptr) {
    Result<Plan> alone = plan_coverage(task, terrain, options);
    if (!alone) return alone.error();
    asked.alone = &made.emplace(std::move(*alone));
  }
  const std::string fleet_text = std::to_string(fleet.aircraft) + " aircraft";
  std::string why = "there are no more sub-cells to fly";
  asked.aircraft = static_cast<int>(std::min(asked.alone->sub_cells.size(), std::size_t(fleet.aircraft)));
  for (; asked.aircraft > 1; --asked.aircraft) {
    Result<FleetPlan> planned = plan_fleet(task, terrain, options, asked);
    if (!planned && planned.error().code != Error::Code::kInfeasible) return planned.error();
    if (planned && planned->makespan_s <= planned->alone_s) {
      if (asked.aircraft < fleet.aircraft)
        planned->note = "Of " + fleet_text + " " + std::to_string(asked.aircraft) + " are used: " + why + ".";
      return planned;
    }
    why = planned ? "more would take longer than one alone" : "no plan for more was found";
  }
  FleetPlan out;
  out.members.push_back({task, *asked.alone, 0.0});
  out.makespan_s = out.alone_s = asked.alone->makespan_s;
  out.separation = fleet.separation;
  if (fleet.aircraft > 1) out.note = "Of " + fleet_text + " one is used: " + why + ".";
  return out;
}

}  // namespace swallowtail::coverage
