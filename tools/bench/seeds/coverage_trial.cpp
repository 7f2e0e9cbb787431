#include "tools/bench/seeds/coverage_trial.hpp"

#include <cmath>
#include <limits>

#include "coverage/schedule/graph.hpp"
#include "planner/base/clock.hpp"

namespace swallowtail::bench {
namespace {

using namespace coverage;

constexpr double kChargeS_per_unit = 2.0;
constexpr double kLanding_s = 45.0;
constexpr double kTakeOff_s = 5.0;
constexpr double kRobotSpeed_mps = 0.2;
/// A flown arc's time comes from the same sums as the graph's.
constexpr double kSameTime_s = 1e-6;

planner::VehicleLimits unit_speed() {
  planner::VehicleLimits limits;
  limits.cruise_speed_mps = 1.0;
  limits.climb_speed_mps = 1.0;
  limits.descent_speed_mps = 1.0;
  return limits;
}

GraphParams graph_params(const CoverageSetting& setting) {
  GraphParams params;
  params.levels = setting.levels;
  params.neighbours = setting.neighbours;
  if (setting.layers == Layers::kNearestOnly) params.height_band_m = -1.0;
  params.stops.battery.capacity = setting.d_max;
  params.stops.battery.reserve = 0.0;
  params.stops.battery.charge_s_per_unit = kChargeS_per_unit;
  params.stops.battery.model.altitude_per_m = setting.altitude_per_m;
  params.stops.charger.speed_mps = kRobotSpeed_mps;
  params.stops.charger.landing_s = kLanding_s;
  params.stops.charger.take_off_s = kTakeOff_s;
  params.stops.energy_factor = 1.0;
  params.stops.lead_s = 0.0;
  return params;
}

bool is_flown_through(const SubCell& from, const Visit& visit_from, const SubCell& to, const Visit& visit_to,
                      double arc_cost, LinkCache& links) {
  const RouteLeg a = route_leg(from, visit_from);
  const RouteLeg b = route_leg(to, visit_to);
  const double flown_s =
      links.get(a.id, a.flown, b.id, b.flown).hop.time_s + links.model().level(to.alpha_m, to.beta_m).time_s;
  return std::abs(arc_cost - flown_s) < kSameTime_s;
}

}  // namespace

CoverageTrial run_coverage_trial(const std::vector<SubCell>& cells, const CoverageSetting& setting,
                                 std::uint64_t seed) {
  CoverageTrial trial;
  trial.cost = trial.scheduled_cost = std::numeric_limits<double>::infinity();
  const planner::Terrain terrain = planner::Terrain::flat(0.0);
  const GraphParams params = graph_params(setting);
  LinkCache links(FlightModel(unit_speed(), params.stops.battery.model, terrain), params.stops.charger);
  ScheduleStart start;
  start.energy = setting.d_max;
  const ThreadCpuClock clock;
  const double began_s = clock.now_s();
  const auto graph = LayeredGraph::build(cells, start, params, links);
  if (!graph) return trial;
  gtsp::Options options;
  options.mode = gtsp::Mode::kFast;
  options.seed = seed;
  options.kind = gtsp::TourKind::kOpen;
  options.start_vertex = graph->start_vertex();
  options.bound_effort = 0.0;
  if (setting.iterations_most > 0) options.stop.max_iterations = setting.iterations_most;
  const gtsp::Solution solution = gtsp::solve(graph->instance(), options);
  trial.cpu_ms = 1e3 * (clock.now_s() - began_s);
  trial.vertices = graph->statistics().vertices;
  trial.edges = graph->statistics().edges;
  if (solution.tour.empty()) return trial;
  trial.cost = solution.cost;
  const std::vector<Visit> visits = graph->decode(solution.tour);
  std::vector<RouteLeg> route;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const SubCell& to = cells[visits[i].sub_cell];
    route.push_back(route_leg(to, visits[i]));
    if (i == 0) continue;
    const SubCell& from = cells[visits[i - 1].sub_cell];
    const double arc_cost = graph->instance().cost(solution.tour[i], solution.tour[i + 1]);
    if (!is_flown_through(from, visits[i - 1], to, visits[i], arc_cost, links)) ++trial.recharges;
    if (from.height_m != to.height_m) ++trial.height_changes;
  }
  trial.scheduled_cost = StopPlanner(links, params.stops).end_of(route, start);
  return trial;
}

}  // namespace swallowtail::bench
