#include "coverage/fleet/fleet.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include "coverage/fleet/parts.hpp"
#include "coverage/fleet/starts.hpp"
#include "coverage/schedule/expand.hpp"
#include "coverage/schedule/robot_trips.hpp"
#include "planner/base/checks.hpp"

namespace swallowtail::coverage {
namespace {

/// Starts stand farther apart than the separation asks by this.
constexpr double kStartSlack_m = 1.0;

std::string number(double value) {
  std::string out = std::to_string(value);
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

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

/// Delays by rank: who comes first keeps its times. Nothing when one of them finds no time; its place in the
/// ranks is then in `stuck`.
std::optional<std::vector<Delays>> delays_in(const std::vector<std::size_t>& ranks,
                                             const std::vector<Member>& members,
                                             const std::vector<Trace>& traces, const Separation& separation,
                                             const FlightModel& model, std::size_t& stuck) {
  const double most_s = std::accumulate(traces.begin(), traces.end(), 0.0,
                                        [](double sum, const Trace& trace) { return sum + trace.end_s; });
  std::vector<Trace> placed;
  std::vector<Delays> out(members.size());
  for (std::size_t rank = 0; rank < ranks.size(); ++rank) {
    const std::size_t k = ranks[rank];
    const auto delays = delays_of(traces[k], placed, separation, most_s);
    if (!delays) {
      stuck = rank;
      return std::nullopt;
    }
    Plan plan = members[k].plan;
    delay(plan, traces[k], *delays);
    placed.push_back(trace_of(plan, members[k].task, model));
    out[k] = *delays;
  }
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

/// The longest first; one that finds no time is heard before all others.
Status separate(std::vector<Member>& members, const Separation& separation, const FlightModel& model) {
  std::vector<Trace> traces;
  for (const Member& member : members) traces.push_back(trace_of(member.plan, member.task, model));
  std::vector<std::size_t> ranks(members.size());
  std::iota(ranks.begin(), ranks.end(), std::size_t{0});
  std::ranges::stable_sort(ranks, std::ranges::greater{}, [&](std::size_t k) { return traces[k].end_s; });
  std::size_t stuck = 0;
  for (std::size_t attempt = 0; attempt <= members.size() * members.size(); ++attempt) {
    const auto delays = delays_in(ranks, members, traces, separation, model, stuck);
    if (!delays) {
      const auto at = ranks.begin() + static_cast<std::ptrdiff_t>(stuck);
      std::rotate(ranks.begin(), at, at + 1);
      continue;
    }
    for (std::size_t k = 0; k < members.size(); ++k) {
      delay(members[k].plan, traces[k], (*delays)[k]);
      members[k].delay_s = (*delays)[k].stretch_s.back();
    }
    return {};
  }
  return infeasible("No waiting on the ground keeps " + std::to_string(members.size()) + " aircraft " +
                    number(separation.horizontal_m) + " m apart horizontally or " +
                    number(separation.vertical_m) + " m vertically: aircraft " +
                    std::to_string(ranks.front() + 1) +
                    " finds no time. Fewer aircraft or smaller distances may do.");
}

/// The best of some ways that can be kept apart. `members_of` gives fewer members where a way cannot be
/// flown.
Status keep_apart(const std::function<std::vector<Member>(const std::vector<int>&)>& members_of,
                  std::size_t aircraft, double undelayed_s, const PlanOptions& options,
                  const FlightModel& model, FleetPlan& out) {
  Status separated = internal_error("The share of an aircraft cannot be scheduled.");
  out.makespan_s = std::numeric_limits<double>::infinity();
  int found = 0;
  for (const std::vector<int>& way : ways_of_fleet(aircraft)) {
    if (options.stop.interrupted())
      return Error{Error::Code::kInterrupted, "Interrupted before the aircraft were kept apart."};
    std::vector<Member> members = members_of(way);
    if (members.size() < aircraft) continue;
    const Status status = separate(members, out.separation, model);
    if (status || found == 0) separated = status;
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

/// Once more, on what is handed out.
bool keeps(const std::vector<Member>& members, const Separation& separation, const FlightModel& model) {
  std::vector<Trace> traces;
  for (const Member& member : members) traces.push_back(trace_of(member.plan, member.task, model));
  for (std::size_t i = 0; i < traces.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (conflict(traces[i], traces[j], separation)) return false;
    }
  }
  return true;
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
  const double starts_apart_m =
      std::max(fleet.separation.horizontal_m, fleet.separation.landed_m) + kStartSlack_m;
  Result<std::vector<Task>> tasks =
      fleet.starts_m.empty() ? tasks_of_fleet(task, fleet.aircraft, starts_apart_m)
                             : tasks_from_starts(task, fleet.aircraft, starts_apart_m, fleet.starts_m);
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
  const auto members_of = [&](const std::vector<int>& way) {
    std::vector<Member> members;
    for (std::size_t k = 0; k < starts.size(); ++k) {
      std::optional<Plan> plan =
          plan_of(whole, way_of(parts->visits[k], way[k]), starts[k], stop_params(task, options), links);
      if (plan && limit_robot((*tasks)[k], model, *plan))
        members.push_back({(*tasks)[k], std::move(*plan), 0.0});
    }
    return members;
  };
  const Status separated = keep_apart(members_of, starts.size(), parts->longest_s(), options, model, out);
  if (!separated) return separated.error();
  if (!keeps(out.members, fleet.separation, model))
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
