#include "coverage/gtsp/detail/run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

namespace swallowtail::gtsp::detail {
namespace {

constexpr std::uint64_t kIterationsBetweenClocks = 16;
constexpr int kFewClusters = 60;
constexpr int kMostProvedFirst = 24;
constexpr int kExtraTrials = 2;

}  // namespace

Effort effort_of(Mode mode) {
  switch (mode) {
    case Mode::kFast:
      return {.trials = 1,
              .warm_trials = 1,
              .iterations_per_cluster = 300.0,
              .exact_work = 1e9,
              .kicks_per_cluster = 300.0,
              .enough_hits = 2};
    case Mode::kDefault:
      return {.trials = 3,
              .warm_trials = 2,
              .iterations_per_cluster = 2000.0,
              .exact_work = 5e9,
              .kicks_per_cluster = 1500.0,
              .enough_hits = 4};
    case Mode::kSlow:
      return {.trials = 8,
              .warm_trials = 4,
              .iterations_per_cluster = 10000.0,
              .exact_work = 4e10,
              .kicks_per_cluster = 12700.0,
              .enough_hits = 12};
  }
  return {};
}

Run::Run(const Instance& instance, const Options& options, const Effort& effort)
    : instance_(instance),
      options_(options),
      effort_(effort),
      anchor_(make_anchor(instance, options)),
      incumbents_(options),
      is_warm_(options.warm_tour.has_value()),
      proved_trial_(std::numeric_limits<int>::max()) {}

Solution Run::solve() {
  if (finish_trivial()) return std::move(solution_);
  if (is_proof_first() && (finish_unreachable() || finish_exact())) return std::move(solution_);
  if (!search_by_chains() && (reduced_ || !finish_unreachable())) search_by_trials();
  return std::move(solution_);
}

bool Run::is_proof_first() const {
  return instance_.is_sparse() || instance_.cluster_count() <= kMostProvedFirst;
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

/// Annealing of few clusters ends in the basin where it began more often; it is cheap to begin elsewhere.
int Run::trial_count() const {
  if (is_warm_) return effort_.warm_trials;
  return effort_.trials + (reduced_->cluster_count() < kFewClusters ? kExtraTrials : 0);
}

TrialParams Run::params_of(int index) const {
  TrialParams params;
  const auto trials = static_cast<std::uint64_t>(trial_count());
  const std::uint64_t allowed = std::min(options_.stop.max_iterations, options_.stop.max_evaluations);
  const std::uint64_t share =
      allowed / trials + (static_cast<std::uint64_t>(index) < allowed % trials ? 1 : 0);
  const auto natural = static_cast<std::uint64_t>(effort_.iterations_per_cluster * reduced_->cluster_count());
  params.iterations = std::min(natural, share);
  if (is_warm_) params.hot *= 0.2;
  return params;
}

/// The warm tour's usable vertices in order; a vertex that no tour can use lends its place to another of its
/// cluster.
std::optional<WorkTour> Run::warm_start() const {
  WorkTour tour;
  std::vector<char> is_in(static_cast<std::size_t>(reduced_->cluster_count()), 0);
  if (reduced_->anchor() >= 0) tour.order.push_back(reduced_->anchor());
  for (const int original : *options_.warm_tour) {
    if (original < 0 || original >= instance_.vertex_count()) continue;
    int v = reduced_->reduced(original);
    for (const int other : instance_.cluster(instance_.cluster_of(original))) {
      if (v < 0) v = reduced_->reduced(other);
    }
    if (v < 0 || is_in[static_cast<std::size_t>(reduced_->cluster_of(v))] != 0) continue;
    is_in[static_cast<std::size_t>(reduced_->cluster_of(v))] = 1;
    tour.order.push_back(v);
  }
  if (tour.order.empty()) return std::nullopt;
  tour.measure(*reduced_);
  return tour;
}

WorkTour Run::start_of(Trial& trial, int /*index*/, const Trial::Report& report) const {
  std::optional<WorkTour> warm = is_warm_ ? warm_start() : std::nullopt;
  if (!warm) return trial.construct();
  if (warm->size() == reduced_->cluster_count()) report(*warm, 0);
  trial.complete(*warm);
  return std::move(*warm);
}

void Run::consider(Found found, std::uint64_t iteration, int index) {
  Outcome& outcome = outcomes_[static_cast<std::size_t>(index)];
  if (!(found.cost < outcome.best.cost)) return;
  incumbents_.offer(found, iteration);
  outcome.best = std::move(found);
  if (!is_proved(outcome.best.cost)) return;
  int lowest = proved_trial_.load();
  while (index < lowest && !proved_trial_.compare_exchange_weak(lowest, index)) {
  }
}

/// Under a deadline each trial has an equal share of the time left; the annealing follows whichever is used
/// up faster.
double Run::progress(int index, std::uint64_t iteration, std::uint64_t most, double begin_s) const {
  if (iteration >= most || proved_trial_.load(std::memory_order_relaxed) <= index) return 1.0;
  if (options_.stop.reached(0, 0)) return 1.0;
  const double by_work = static_cast<double>(iteration) / static_cast<double>(most);
  if (options_.stop.clock == nullptr || std::isinf(options_.stop.deadline_s)) return by_work;
  const int rounds_left = (trial_count() - 1 - index) / options_.threads + 1;
  const double now_s = options_.stop.clock->now_s();
  const double share_s = (options_.stop.deadline_s - begin_s) / rounds_left;
  return std::max(by_work, share_s > 0.0 ? (now_s - begin_s) / share_s : 1.0);
}

void Run::run_trial(int index, Outcome& outcome) {
  const TrialParams params = params_of(index);
  const double begin_s = options_.stop.clock != nullptr ? options_.stop.clock->now_s() : 0.0;
  const Trial::Report report = [&](const WorkTour& tour, std::uint64_t iteration) {
    if (tour.score.missing > 0) return;
    const auto original = [this](int v) { return reduced_->original(v); };
    consider(found_from(instance_, anchor_, tour.order, original, options_.kind), iteration, index);
  };
  double last = 0.0;
  const Trial::Progress progress_at = [&](std::uint64_t iteration) {
    if (iteration % kIterationsBetweenClocks == 0 || iteration >= params.iterations) {
      last = progress(index, iteration, params.iterations, begin_s);
    }
    return last;
  };
  Trial trial(*reduced_, params, Rng(options_.seed).split(static_cast<std::uint64_t>(index)));
  trial.run(start_of(trial, index, report), progress_at, report);
  outcome.iterations = trial.iterations();
}

void Run::search_by_trials() {
  outcomes_.resize(static_cast<std::size_t>(trial_count()));
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int index = next++; index < trial_count(); index = next++) {
      const bool is_needed = index == 0 || (proved_trial_.load() > index && !options_.stop.reached(0, 0));
      if (is_needed) run_trial(index, outcomes_[static_cast<std::size_t>(index)]);
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < std::min(options_.threads, trial_count()); ++i) helpers.emplace_back(work);
    work();
  }
  conclude();
}

void Run::conclude() {
  const Found* best = &outcomes_.front().best;
  for (const Outcome& outcome : outcomes_) {
    solution_.iterations += outcome.iterations;
    if (outcome.best.cost < best->cost) best = &outcome.best;
  }
  const bool is_interrupted = options_.stop.interrupted();
  if (best->tour.empty()) {
    finish(*best, is_interrupted ? SolveStatus::kInterrupted : SolveStatus::kNoneFound,
           "The search met no tour without missing arcs; whether there is one is open.");
  } else if (is_proved(best->cost)) {
    finish(*best, SolveStatus::kOptimal, "The tour costs no more than the lower bound.");
  } else if (is_interrupted) {
    finish(*best, SolveStatus::kInterrupted, "Stop was requested.");
  } else {
    finish(*best, SolveStatus::kFeasible, "The search ended at its limit of work or time.");
  }
}

}  // namespace swallowtail::gtsp::detail
