#include "coverage/gtsp/detail/run.hpp"

#include <algorithm>
#include <limits>

#include "coverage/gtsp/search/warm_tour.hpp"

namespace swallowtail::gtsp::detail {
namespace {

constexpr int kMostProvedFirst = 24;
/// A warm search has so much less work to do.
constexpr double kWarmShare = 8.0;
/// Where costs differ each way, more chains agree on what is not the best.
constexpr int kAsymmetricHits = 2;
/// Beyond it the bound's tables would take longer than the search and more memory.
constexpr int kMaxBoundVertices = 3'000;

}  // namespace

Effort effort_of(Mode mode) {
  switch (mode) {
    case Mode::kFast:
      return {.exact_work = 1e9, .kicks_per_cluster = 300.0, .enough_hits = 2};
    case Mode::kDefault:
      return {.exact_work = 5e9, .kicks_per_cluster = 1500.0, .enough_hits = 4};
    case Mode::kSlow:
      return {.exact_work = 4e10, .kicks_per_cluster = 12700.0, .enough_hits = 12};
  }
  return {};
}

Run::Run(const Instance& instance, const Options& options, const Effort& effort)
    : instance_(instance),
      options_(options),
      effort_(effort),
      anchor_(make_anchor(instance, options)),
      incumbents_(options),
      found_(search::kChains) {}

Solution Run::solve() {
  if (finish_trivial()) return std::move(solution_);
  if (is_proof_first() && (finish_unreachable() || finish_exact())) return std::move(solution_);
  search_by_chains();
  return std::move(solution_);
}

bool Run::is_proof_first() const {
  return instance_.is_sparse() || instance_.cluster_count() <= kMostProvedFirst;
}

void Run::search_by_chains() {
  if (!pruning_ && instance_.is_matrix_lacking() && finish_unreachable()) return;
  const search::Problem problem(instance_, anchor_, pruning_ ? *pruning_ : all_alive(instance_, anchor_));
  const search::ChainSetup setup = chain_setup(problem);
  const auto original = [&](int v) { return problem.original(v); };
  solution_.iterations = search::run_chains(
      problem, setup, [&](int chain, const std::vector<int>& tour, std::uint64_t iteration) {
        consider(found_from(instance_, anchor_, tour, original, options_.kind), iteration, chain);
      });
  const bool is_bounded = pruning_ || instance_.vertex_count() > kMaxBoundVertices;
  if (!is_bounded && !options_.stop.reached(0, 0)) finish_unreachable();
  conclude();
}

search::ChainSetup Run::chain_setup(const search::Problem& problem) {
  search::ChainSetup setup;
  setup.seed = options_.seed;
  setup.threads = options_.threads;
  setup.enough_hits = (problem.is_symmetric() ? 1 : kAsymmetricHits) * effort_.enough_hits;
  setup.stop = options_.stop;
  const double natural = effort_.kicks_per_cluster * problem.cluster_count();
  setup.kicks = static_cast<std::uint64_t>(options_.warm_tour ? natural / kWarmShare : natural);
  setup.kicks = std::min({setup.kicks, options_.stop.max_iterations, options_.stop.max_evaluations});
  setup.stop.max_iterations = std::numeric_limits<std::uint64_t>::max();
  setup.stop.max_evaluations = std::numeric_limits<std::uint64_t>::max();
  if (!options_.warm_tour) return setup;
  const search::WarmTour warm = search::usable_part(problem, *options_.warm_tour);
  const auto original = [&](int v) { return problem.original(v); };
  if (warm.is_whole) consider(found_from(instance_, anchor_, warm.tour, original, options_.kind), 0, 0);
  if (!warm.tour.empty()) setup.start = search::completed(problem, warm.tour);
  return setup;
}

void Run::consider(Found found, std::uint64_t iteration, int chain) {
  Found& best = found_[static_cast<std::size_t>(chain)];
  if (!(found.cost < best.cost)) return;
  incumbents_.offer(found, iteration);
  best = std::move(found);
}

void Run::finish(const Found& best, SolveStatus status, std::string reason) {
  incumbents_.offer(best, 0);
  solution_.status = status;
  solution_.tour = best.tour;
  solution_.cost = best.cost;
  solution_.proved_optimal = status == SolveStatus::kOptimal;
  if (solution_.proved_optimal) solution_.lower_bound = best.cost;
  solution_.history = incumbents_.history();
  solution_.reason = std::move(reason);
}

void Run::finish_infeasible(std::string reason) {
  solution_.status = SolveStatus::kInfeasible;
  solution_.lower_bound = kNoArc;
  solution_.reason = std::move(reason);
}

void Run::conclude() {
  const Found& best = *std::min_element(found_.begin(), found_.end(),
                                        [](const Found& a, const Found& b) { return a.cost < b.cost; });
  const bool is_interrupted = options_.stop.interrupted();
  if (best.tour.empty()) {
    finish(best, is_interrupted ? SolveStatus::kInterrupted : SolveStatus::kNoneFound,
           "The search met no tour without missing arcs; whether there is one is open.");
  } else if (is_proved(best.cost)) {
    finish(best, SolveStatus::kOptimal, "The tour costs no more than the lower bound.");
  } else if (is_interrupted) {
    finish(best, SolveStatus::kInterrupted, "Stop was requested.");
  } else {
    finish(best, SolveStatus::kFeasible, "The search ended at its limit of work or time.");
  }
}

}  // namespace swallowtail::gtsp::detail
