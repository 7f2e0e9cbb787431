#include "coverage/schedule/order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace swallowtail::coverage {
namespace {

/// What each mode may spend; a deadline can cut it short.
struct Budget {
  int layered_vertices;        ///< largest layered graph that is searched
  int plain_vertices;          ///< largest graph without levels
  std::uint64_t iterations;    ///< of the layered search
  std::uint64_t schedules;     ///< looked at by the local search
  std::uint64_t flights;       ///< in these
  std::uint64_t kicks;         ///< of the local search, per sub-cell
  std::uint64_t flight_kicks;  ///< of the search by flight alone, per sub-cell
};

/// Largest layered graph that is compared with the full one in any mode.
constexpr int kComparedVertices = 1700;
/// Kicks per sub-cell of the search by flight alone that begins with the cut's own tour.
constexpr std::uint64_t kKicksOfTour = 1;
/// Fewer sub-cells are ordered exactly as quickly.
constexpr std::size_t kLeastInTour = 16;

Budget budget_of(gtsp::Mode mode) {
  switch (mode) {
    case gtsp::Mode::kFast:
      return {0, 500, 4'000, 20'000, 100'000'000, 1, 5};
    case gtsp::Mode::kDefault:
      return {3000, 2000, 20'000, 200'000, 1'000'000'000, 10, 50};
    case gtsp::Mode::kSlow:
      return {6000,
              4000,
              std::numeric_limits<std::uint64_t>::max(),
              10'000'000,
              std::numeric_limits<std::uint64_t>::max(),
              200,
              500};
  }
  return {0, 500, 4'000, 20'000, 100'000'000, 1, 5};
}

class OrderSearch {
 public:
  OrderSearch(std::span<const SubCell> cells, const ScheduleStart& start, const Task& task,
              const PlanOptions& options, LinkCache& links)
      : cells_(cells),
        start_(start),
        task_(task),
        options_(options),
        links_(links),
        budget_(budget_of(options.mode)),
        stops_(links, stop_params(task, options)) {}

  Result<Order> run();

 private:
  double now() const { return options_.clock != nullptr ? options_.clock->now_s() : 0.0; }
  std::vector<RouteLeg> route_of(const std::vector<Visit>& visits) const;
  void offer(const char* from, std::vector<Visit> visits);
  bool needs_recharge();
  std::string why_none() const;
  void solve_graph(int levels, const char* from);
  gtsp::Solution solve(const LayeredGraph& graph, bool warm) const;
  /// Whether the sub-cells come in the order of a tour, as lines of mixed direction do.
  bool offer_cut();
  void search_flight(std::uint64_t kicks_per_cell);
  void compare_with_full_graph(const GraphParams& params);
  StopCondition part_of_deadline(double share) const;

  std::span<const SubCell> cells_;
  const ScheduleStart& start_;
  const Task& task_;
  const PlanOptions& options_;
  LinkCache& links_;
  Budget budget_;
  StopPlanner stops_;
  PlanStatistics statistics_;
  std::vector<Visit> best_;
  double best_end_s_ = std::numeric_limits<double>::infinity();
};

std::vector<RouteLeg> OrderSearch::route_of(const std::vector<Visit>& visits) const {
  std::vector<RouteLeg> route;
  for (const Visit& visit : visits) route.push_back(route_leg(cells_[visit.sub_cell], visit));
  return route;
}

void OrderSearch::offer(const char* from, std::vector<Visit> visits) {
  const double end = stops_.end_of(route_of(visits), start_);
  ++statistics_.schedules_computed;
  if (end < best_end_s_) {
    best_end_s_ = end;
    best_ = std::move(visits);
    statistics_.order_from = from;
  }
}

/// Where one battery does for the best order so far, levels say nothing that the graph without them does not.
bool OrderSearch::needs_recharge() {
  if (best_.empty()) return true;
  const std::optional<StopPlan> plan = stops_.plan(route_of(best_), start_);
  return !plan || !plan->recharges.empty();
}

StopCondition OrderSearch::part_of_deadline(double share) const {
  StopCondition stop = options_.stop;
  if (stop.clock != nullptr && std::isfinite(stop.deadline_s)) {
    const double now_s = stop.clock->now_s();
    stop.deadline_s = now_s + std::max(0.0, stop.deadline_s - now_s) * share;
  }
  return stop;
}

gtsp::Solution OrderSearch::solve(const LayeredGraph& graph, bool warm) const {
  gtsp::Options options;
  options.mode = options_.mode;
  options.seed = options_.seed;
  options.kind = gtsp::TourKind::kOpen;
  options.start_vertex = graph.start_vertex();
  options.stop = part_of_deadline(0.5);
  options.stop.max_iterations = std::min(options.stop.max_iterations, budget_.iterations);
  options.threads = options_.threads;
  options.bound_effort = 0.0;
  if (warm && !best_.empty()) options.warm_tour = graph.encode(best_);
  return gtsp::solve(graph.instance(), options);
}

void OrderSearch::solve_graph(int levels, const char* from) {
  GraphParams params{stop_params(task_, options_), task_.height_band_m, task_.neighbours, levels};
  const double began = now();
  const int most = static_cast<int>(cells_.size()) - 1;
  for (int attempt = 0; attempt < 3 && !options_.stop.interrupted(); ++attempt) {
    const Result<LayeredGraph> graph = LayeredGraph::build(cells_, start_, params, links_);
    if (!graph) break;
    const gtsp::Solution solution = solve(*graph, levels > 1);
    statistics_.vertices = graph->statistics().vertices;
    statistics_.edges = graph->statistics().edges;
    statistics_.neighbours = graph->statistics().neighbours;
    if (!solution.tour.empty()) {
      if (levels > 1) statistics_.gtsp_cost = solution.cost;
      offer(from, graph->decode(solution.tour));
      break;
    }
    if (graph->statistics().neighbours >= most) break;
    params.neighbours = std::min(most, graph->statistics().neighbours * 2 + 1);
  }
  statistics_.gtsp_wall_s += now() - began;
}

bool OrderSearch::offer_cut() {
  std::vector<Visit> as_cut;
  for (std::size_t i = 0; i < cells_.size(); ++i) as_cut.push_back({i, false});
  offer("tour of the cut", as_cut);
  offer("strip order", boustrophedon_order(cells_, start_.position_m));
  return cells_.size() >= kLeastInTour && best_ == as_cut;
}

/// The graph without levels where it would be too large to be made, or the order is good already: its arcs
/// only as they are asked for.
void OrderSearch::search_flight(std::uint64_t kicks_per_cell) {
  const double began = now();
  ImproveParams params;
  params.aim = Aim::kFlight;
  params.stop = part_of_deadline(0.5);
  params.kicks = kicks_per_cell * cells_.size();
  params.seed = options_.seed;
  std::vector<Visit> visits = best_.empty() ? boustrophedon_order(cells_, start_.position_m) : best_;
  offer("flight search", improve_order(cells_, std::move(visits), start_, links_, params).visits);
  statistics_.gtsp_wall_s += now() - began;
}

void OrderSearch::compare_with_full_graph(const GraphParams& params) {
  GraphParams full = params;
  full.neighbours = static_cast<int>(cells_.size());
  const Result<LayeredGraph> graph = LayeredGraph::build(cells_, start_, full, links_);
  if (!graph || statistics_.gtsp_cost <= 0.0) return;
  const gtsp::Solution solution = solve(*graph, true);
  if (!solution.tour.empty())
    statistics_.full_graph_gap_percent = 100.0 * (statistics_.gtsp_cost / solution.cost - 1.0);
}

/// What is barred from the start, else the robot where it reaches too little, else the battery.
std::string OrderSearch::why_none() const {
  for (const SubCell& cell : cells_) {
    const FlightModel& model = links_.model();
    if (!model.is_barred(start_.position_m, cell.alpha_m) || !model.is_barred(start_.position_m, cell.beta_m))
      continue;
    const auto field =
        std::ranges::find_if(task_.fields, [&](const Field& f) { return f.id == cell.field_id; });
    return "there is no way in the air from " + place_text(start_.position_m.head<2>()) + " to " +
           place_text(cell.alpha_m.head<2>()) + " in field '" +
           (field == task_.fields.end() ? std::string() : field->name) + "' past holes and no-fly areas.";
  }
  const auto is_reached = [&](const Vec3& site) {
    return std::isfinite(drive_s(task_.charger, task_.charger.start_m, site));
  };
  const SubCell* missed = nullptr;
  std::size_t reached = 0;
  for (const SubCell& cell : cells_) {
    const bool is_met = is_reached(cell.alpha_m) || is_reached(cell.beta_m);
    reached += is_met ? 1 : 0;
    if (!is_met && missed == nullptr) missed = &cell;
  }
  const std::string battery = "one battery of " + std::to_string(task_.battery.capacity) + " units";
  if (missed != nullptr) {
    return "from " + place_text(task_.charger.start_m.head<2>()) + " the ground robot reaches " +
           (reached > 0 ? std::to_string(reached) + " of " : std::string("none of ")) +
           std::to_string(cells_.size()) + " sub-cells, not the one at " +
           place_text(missed->alpha_m.head<2>()) + ", and " + battery +
           " does not do for what lies between its meetings.";
  }
  return battery + " does not reach the first sub-cell from " + place_text(start_.position_m.head<2>()) +
         " and a landing with the reserve.";
}

Result<Order> OrderSearch::run() {
  const int n = static_cast<int>(cells_.size());
  const bool is_quick = offer_cut() && options_.mode == gtsp::Mode::kFast;
  if (is_quick) {
    search_flight(kKicksOfTour);
  } else if (1 + 2 * n <= budget_.plain_vertices) {
    solve_graph(1, "graph without levels");
  } else {
    search_flight(budget_.flight_kicks);
  }
  const bool compares = options_.full_graph == FullGraph::kCompare;
  const bool recharges = needs_recharge();
  const int layered = std::max(budget_.layered_vertices, compares ? kComparedVertices : 0);
  if (1 + 2 * n * task_.battery.levels <= layered && task_.battery.levels > 1 && (compares || recharges)) {
    solve_graph(task_.battery.levels, "layered graph");
    if (compares) {
      compare_with_full_graph(
          {stop_params(task_, options_), task_.height_band_m, task_.neighbours, task_.battery.levels});
    }
  }
  if (best_.empty()) {
    return infeasible("No order of the sub-cells can be flown: " + why_none());
  }
  // By flight alone it cannot be better, and nothing else counts.
  if (is_quick && !recharges) return Order{std::move(best_), statistics_};
  ImproveParams params;
  params.stops = stop_params(task_, options_);
  params.stop = options_.stop;
  params.stop.max_evaluations = std::min(params.stop.max_evaluations, budget_.schedules);
  params.flights = budget_.flights;
  params.kicks = recharges ? budget_.kicks * cells_.size() : 0;
  params.seed = options_.seed;
  ImproveReport improved = improve_order(cells_, best_, start_, links_, params);
  statistics_.schedules_computed += improved.evaluations;
  if (improved.end_s < best_end_s_ - 1e-6) {
    best_end_s_ = improved.end_s;
    best_ = std::move(improved.visits);
    statistics_.order_from += " + local search";
  }
  return Order{std::move(best_), statistics_};
}

}  // namespace

Result<Order> find_order(std::span<const SubCell> sub_cells, const ScheduleStart& start, const Task& task,
                         const PlanOptions& options, LinkCache& links) {
  return OrderSearch(sub_cells, start, task, options, links).run();
}

}  // namespace swallowtail::coverage
