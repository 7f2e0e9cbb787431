#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <sstream>

#include <fmt/core.h>

#include "coverage/gtsp/check_tour.hpp"
#include "coverage/gtsp/gtsplib.hpp"
#include "coverage/gtsp/solver.hpp"
#include "coverage/gtsp/tour_file.hpp"
#include "planner/base/clock.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/output.hpp"
#include "tools/cli/progress.hpp"

namespace swallowtail::cli {
namespace {

struct GtspOptions {
  Common common;
  std::string file;
  gtsp::Mode mode = gtsp::Mode::kDefault;
  std::optional<double> time_limit_s;
  std::string start;
  double bound_effort = 1.0;
  bool is_open = false;
  std::vector<int> prefix;  ///< vertices count from 1, as in the file
  std::optional<int> start_vertex;
  std::optional<int> end_vertex;
  std::vector<std::string> precedence;  ///< "A:B", sets count from 1
};

/// In the instance vertices count from 0.
std::optional<int> from_zero(const std::optional<int>& vertex) {
  return vertex ? std::optional(*vertex - 1) : std::nullopt;
}

gtsp::TourRule rule_of(const gtsp::Options& options) {
  return {options.kind == gtsp::TourKind::kClosed, options.fixed_prefix, options.start_vertex,
          options.end_vertex, options.precedence};
}

Result<std::pair<int, int>> precedence_of(const std::string& text) {
  int before = 0;
  int after = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%9d:%9d%c", &before, &after, &rest) == 2)
    return std::pair(before - 1, after - 1);
  return bad_input("--before is \"" + text + "\"; it must be two set numbers with a colon, as in 3:7.");
}

Result<gtsp::Options> solver_options(const GtspOptions& options, const Clock& clock) {
  gtsp::Options out;
  out.mode = options.mode;
  out.seed = options.common.seed;
  out.threads = options.common.threads;
  out.stop.clock = &clock;
  out.stop.stop_requested = &interrupted();
  if (options.time_limit_s) out.stop.deadline_s = clock.now_s() + *options.time_limit_s;
  out.bound_effort = options.bound_effort;
  out.kind = options.is_open ? gtsp::TourKind::kOpen : gtsp::TourKind::kClosed;
  out.start_vertex = from_zero(options.start_vertex);
  out.end_vertex = from_zero(options.end_vertex);
  for (const int vertex : options.prefix) out.fixed_prefix.push_back(vertex - 1);
  for (const std::string& text : options.precedence) {
    const auto pair = precedence_of(text);
    if (!pair) return pair.error();
    out.precedence.push_back(*pair);
  }
  if (!options.start.empty()) {
    auto tour = gtsp::read_tour(std::filesystem::path(options.start));
    if (!tour) return tour.error();
    out.warm_tour = std::move(*tour);
  }
  return out;
}

struct Solved {
  gtsp::Solution solution;
  double wall_s = 0.0;
  double cpu_s = 0.0;
};

Answer answer_of(const GtspOptions& options, const gtsp::Instance& instance, const Solved& solved) {
  const gtsp::Solution& solution = solved.solution;
  const bool has_tour = !solution.tour.empty();
  Answer answer;
  auto& json = answer.json;
  json["instance"] = std::filesystem::path(options.file).stem().string();
  json["status"] = gtsp::name_of(solution.status);
  json["reason"] = solution.reason;
  json["vertices"] = instance.vertex_count();
  json["clusters"] = instance.cluster_count();
  json["cost"] = has_tour ? nlohmann::ordered_json(solution.cost) : nlohmann::ordered_json(nullptr);
  const double gap_percent = 100.0 * (solution.cost / std::max(solution.lower_bound, 1e-300) - 1.0);
  const bool has_gap = has_tour && solution.lower_bound > 0.0;
  json["lower_bound"] = std::isfinite(solution.lower_bound) ? nlohmann::ordered_json(solution.lower_bound)
                                                            : nlohmann::ordered_json(nullptr);
  json["gap_percent"] = has_gap ? nlohmann::ordered_json(gap_percent) : nlohmann::ordered_json(nullptr);
  json["proved_optimal"] = solution.proved_optimal;
  json["tour"] = nlohmann::ordered_json::array();
  for (const int vertex : solution.tour) json["tour"].push_back(vertex + 1);
  json["seed"] = options.common.seed;
  json["iterations"] = solution.iterations;
  json["wall_s"] = solved.wall_s;
  json["cpu_s"] = solved.cpu_s;
  json["peak_rss_mb"] = process_peak_rss_mb();
  json["history"] = nlohmann::ordered_json::array();
  for (const auto& entry : solution.history)
    json["history"].push_back({{"wall_s", entry.wall_s}, {"cost", entry.cost}});

  answer.table = fmt::format("{}: {} vertices in {} clusters\n", json["instance"].get<std::string>(),
                             instance.vertex_count(), instance.cluster_count());
  answer.table += fmt::format("  status       {}\n", gtsp::name_of(solution.status));
  if (has_tour)
    answer.table +=
        fmt::format("  cost         {}\n  lower bound  {}{}\n", solution.cost, solution.lower_bound,
                    has_gap ? fmt::format(" (gap {:.2f} %)", gap_percent) : std::string());
  if (!has_tour) answer.table += fmt::format("  reason       {}\n", solution.reason);
  answer.table += fmt::format("  iterations   {}\n  time         {:.2f} s wall, {:.2f} s processor\n",
                              solution.iterations, solved.wall_s, solved.cpu_s);

  const std::string name = json["instance"].get<std::string>();
  answer.files[".tour"] = [name, tour = solution.tour, cost = solution.cost] {
    std::ostringstream out;
    const Status status = gtsp::write_tour(out, name, tour, cost);
    return status.ok() ? out.str() : std::string();
  };
  answer.files[".csv"] = [tour = solution.tour] {
    std::string text = "position,vertex\n";
    for (std::size_t i = 0; i < tour.size(); ++i) text += fmt::format("{},{}\n", i + 1, tour[i] + 1);
    return text;
  };
  return answer;
}

Exit exit_of(const gtsp::Solution& solution) {
  if (solution.status == gtsp::SolveStatus::kInterrupted || interrupted()) return Exit::kInterrupted;
  return solution.tour.empty() ? Exit::kNone : Exit::kDone;
}

Exit run_gtsp(const GtspOptions& options) {
  if (const Status status = check_output(options.common, {".json", ".csv", ".tour"}); !status.ok())
    return fail(status.error());
  auto instance = gtsp::read_gtsplib(std::filesystem::path(options.file));
  if (!instance) return fail(instance.error());
  const SteadyClock clock;
  const double begin_s = clock.now_s();
  const double cpu_begin_s = process_cpu_s();
  auto solver = solver_options(options, clock);
  if (!solver) return fail(solver.error());
  if (const Status status = gtsp::validate(*solver, *instance); !status.ok()) return fail(status.error());

  Solved solved;
  {
    Progress progress("gtsp", options.common.quiet ? Progress::Show::kNo : Progress::Show::kYes);
    solver->on_incumbent = [&progress](const gtsp::Incumbent& best) {
      progress.update(fmt::format("cost {} at iteration {}", best.cost, best.iteration));
    };
    solved.solution = gtsp::solve(*instance, *solver);
  }
  solved.wall_s = clock.now_s() - begin_s;
  solved.cpu_s = process_cpu_s() - cpu_begin_s;
  if (!solved.solution.tour.empty()) {
    const auto cost = gtsp::check_tour(*instance, solved.solution.tour, rule_of(*solver));
    if (!cost)
      return fail(internal_error("The solver's tour was refused by the checker: " + cost.error().message));
  }
  return deliver(options.common, answer_of(options, *instance, solved), exit_of(solved.solution));
}

}  // namespace

void add_gtsp(CLI::App& app, Exit& exit) {
  CLI::App* command = app.add_subcommand("gtsp", "Solve a generalised travelling salesman problem");
  const auto options = std::make_shared<GtspOptions>();
  const std::map<std::string, gtsp::Mode> modes = {
      {"fast", gtsp::Mode::kFast}, {"default", gtsp::Mode::kDefault}, {"slow", gtsp::Mode::kSlow}};
  command->add_option("FILE", options->file, "Instance in GTSPLIB format (.gtsp)")->required();
  command->add_option("--mode", options->mode, "fast, default or slow")
      ->transform(CLI::CheckedTransformer(modes))
      ->option_text("fast|default|slow");
  command
      ->add_option("--time-limit", options->time_limit_s,
                   "Stop after so many seconds with the best tour so far")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--start", options->start, "TSPLIB tour file to begin from");
  command
      ->add_option("--bound-effort", options->bound_effort,
                   "Work on the lower bound, times the usual for the mode; 0 = none")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_flag("--open", options->is_open, "The tour need not return to where it starts");
  command->add_option("--prefix", options->prefix, "Vertices that open the tour, in this order")
      ->delimiter(',');
  command->add_option("--start-vertex", options->start_vertex, "First vertex of the tour");
  command->add_option("--before", options->precedence, "A:B, set A comes before set B; may be repeated")
      ->delimiter(',');
  command->add_option("--end-vertex", options->end_vertex, "Last vertex of the tour");
  add_common(*command, options->common,
             "  swallowtail gtsp 40kroa200.gtsp\n"
             "  swallowtail gtsp 212u1060.gtsp --mode slow --time-limit 60 --threads 2 --json\n"
             "  swallowtail gtsp 40kroa200.gtsp --start old.tour -o new.tour\n"
             "  swallowtail gtsp 40kroa200.gtsp --open --prefix 3,17 --end-vertex 88 --bound-effort 10");
  command->callback([options, &exit] { exit = run_gtsp(*options); });
}

}  // namespace swallowtail::cli
