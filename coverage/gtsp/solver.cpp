#include "coverage/gtsp/solver.hpp"

#include <algorithm>
#include <cmath>

#include "coverage/gtsp/detail/precedence_search.hpp"
#include "coverage/gtsp/detail/run.hpp"
#include "coverage/gtsp/proof/settle.hpp"

namespace swallowtail::gtsp {
namespace {

Status check_vertex(const char* name, int v, const Instance& instance) {
  if (v >= 0 && v < instance.vertex_count()) return {};
  return bad_input(std::string(name) + " names vertex " + std::to_string(v) + "; it must be from 0 to " +
                   std::to_string(instance.vertex_count() - 1) + ".");
}

Status check_prefix(const std::vector<int>& prefix, const Instance& instance) {
  std::vector<char> is_visited(static_cast<std::size_t>(instance.cluster_count()), 0);
  for (const int v : prefix) {
    if (Status s = check_vertex("fixed_prefix", v, instance); !s) return s;
    char& visited = is_visited[static_cast<std::size_t>(instance.cluster_of(v))];
    if (visited != 0) {
      return bad_input("fixed_prefix visits cluster " + std::to_string(instance.cluster_of(v)) +
                       " again with vertex " + std::to_string(v) + "; each cluster may be visited once.");
    }
    visited = 1;
  }
  return {};
}

Status check_ends(const Options& options, const Instance& instance) {
  if (options.start_vertex) {
    if (Status s = check_vertex("start_vertex", *options.start_vertex, instance); !s) return s;
    if (!options.fixed_prefix.empty() && options.fixed_prefix.front() != *options.start_vertex) {
      return bad_input("start_vertex is " + std::to_string(*options.start_vertex) +
                       " but fixed_prefix starts with " + std::to_string(options.fixed_prefix.front()) +
                       "; they must agree.");
    }
  }
  if (!options.end_vertex) return {};
  if (Status s = check_vertex("end_vertex", *options.end_vertex, instance); !s) return s;
  std::vector<int> lead = options.fixed_prefix;
  if (lead.empty() && options.start_vertex) lead.push_back(*options.start_vertex);
  const bool is_whole_tour = static_cast<int>(lead.size()) == instance.cluster_count();
  for (const int v : lead) {
    if (instance.cluster_of(v) != instance.cluster_of(*options.end_vertex)) continue;
    if (is_whole_tour && lead.back() == *options.end_vertex) return {};
    return bad_input("end_vertex " + std::to_string(*options.end_vertex) + " is in cluster " +
                     std::to_string(instance.cluster_of(v)) +
                     ", which start or prefix visits before the end; each cluster may be visited once.");
  }
  return {};
}

/// Clusters that can be put in order, from the first; fewer than there are when precedence is circular.
std::size_t orderable_clusters(const Options& options, const Instance& instance) {
  std::vector<std::vector<int>> after(static_cast<std::size_t>(instance.cluster_count()));
  std::vector<int> waits_for(after.size(), 0);
  for (const auto& [first, second] : options.precedence) {
    after[static_cast<std::size_t>(first)].push_back(second);
    ++waits_for[static_cast<std::size_t>(second)];
  }
  std::vector<int> ready;
  for (std::size_t c = 0; c < after.size(); ++c) {
    if (waits_for[c] == 0) ready.push_back(static_cast<int>(c));
  }
  for (std::size_t i = 0; i < ready.size(); ++i) {
    for (const int next : after[static_cast<std::size_t>(ready[i])]) {
      if (--waits_for[static_cast<std::size_t>(next)] == 0) ready.push_back(next);
    }
  }
  return ready.size();
}

Status check_precedence(const Options& options, const Instance& instance) {
  const int m = instance.cluster_count();
  if (!options.precedence.empty() && m > kMaxPrecedenceClusters) {
    return bad_input("precedence is given for " + std::to_string(m) + " clusters; it may be for at most " +
                     std::to_string(kMaxPrecedenceClusters) + ".");
  }
  std::vector<int> lead = options.fixed_prefix;
  if (lead.empty() && options.start_vertex) lead.push_back(*options.start_vertex);
  const auto place_in_lead = [&](int c) {
    return std::find_if(lead.begin(), lead.end(), [&](int v) { return instance.cluster_of(v) == c; });
  };
  for (const auto& [first, second] : options.precedence) {
    const std::string pair = "precedence of " + std::to_string(first) + " before " + std::to_string(second);
    if (first < 0 || first >= m || second < 0 || second >= m)
      return bad_input(pair + " names a cluster outside 0 to " + std::to_string(m - 1) + ".");
    const auto second_place = place_in_lead(second);
    const bool breaks_lead = second_place != lead.end() && place_in_lead(first) >= second_place;
    const bool is_last = options.end_vertex && instance.cluster_of(*options.end_vertex) == first;
    if (breaks_lead || is_last) return bad_input(pair + " cannot be kept with the fixed vertices.");
  }
  if (orderable_clusters(options, instance) < static_cast<std::size_t>(m))
    return bad_input("precedence goes in a circle; no order of the clusters keeps it.");
  return {};
}

constexpr double kBoundShare = 0.1;  ///< of the time to a deadline

/// Grows with the search's time, which is about n³ of steps at equal quality.
double bound_work_of(const Instance& instance, const Options& options) {
  if (options.warm_tour && options.bound_effort <= 1.0) return 0.0;
  const double n = instance.vertex_count();
  const double usual = std::clamp(1.2 * n * n * n, 2e7, 4e9);
  const double of_mode = options.mode == Mode::kFast ? 0.125 : options.mode == Mode::kSlow ? 8.0 : 1.0;
  return options.bound_effort * of_mode * usual;
}

}  // namespace

Status validate(const Options& options, const Instance& instance) {
  const bool is_fixed = options.kind == TourKind::kOpen || options.start_vertex || options.end_vertex ||
                        !options.fixed_prefix.empty();
  if (instance.vertex_count() > kMaxSolverVertices && is_fixed && instance.is_complete()) {
    return bad_input("The instance has " + std::to_string(instance.vertex_count()) +
                     " vertices; the search takes at most " + std::to_string(kMaxSolverVertices) + ".");
  }
  if (options.threads < 1 || options.threads > 256) {
    return bad_input("threads is " + std::to_string(options.threads) + "; it must be from 1 to 256.");
  }
  if (!(options.bound_effort >= 0.0 && options.bound_effort <= 1000.0)) {
    return bad_input("bound_effort is " + std::to_string(options.bound_effort) +
                     "; it must be from 0 to 1000.");
  }
  if (std::isnan(options.stop.deadline_s)) return bad_input("stop.deadline_s is not a number.");
  if (options.stop.clock == nullptr && std::isfinite(options.stop.deadline_s)) {
    return bad_input("stop.deadline_s is set without stop.clock; a deadline needs a clock.");
  }
  if (Status s = check_prefix(options.fixed_prefix, instance); !s) return s;
  if (Status s = check_ends(options, instance); !s) return s;
  return check_precedence(options, instance);
}

const char* name_of(SolveStatus status) {
  switch (status) {
    case SolveStatus::kOptimal:
      return "optimal";
    case SolveStatus::kFeasible:
      return "feasible";
    case SolveStatus::kInfeasible:
      return "infeasible";
    case SolveStatus::kNoneFound:
      return "none_found";
    case SolveStatus::kInterrupted:
      return "interrupted";
  }
  return "unknown";
}

Solution solve(const Instance& instance, const Options& options) {
  if (Status s = validate(options, instance); !s) {
    Solution refused;
    refused.reason = s.error().message;
    return refused;
  }
  const double bound_work = bound_work_of(instance, options);
  Options searching = options;
  if (bound_work > 0.0 && std::isfinite(options.stop.deadline_s)) {
    const double now_s = options.stop.clock->now_s();
    searching.stop.deadline_s -= kBoundShare * std::max(0.0, options.stop.deadline_s - now_s);
  }
  Solution solution = options.precedence.empty()
                          ? detail::Run(instance, searching, detail::effort_of(options.mode)).solve()
                          : detail::PrecedenceSearch(instance, searching).solve();
  proof::settle(instance, options, bound_work, solution);
  return solution;
}

}  // namespace swallowtail::gtsp
