#include "coverage/gtsp/detail/precedence_search.hpp"

#include <algorithm>
#include <cmath>

#include "coverage/gtsp/detail/exact.hpp"

namespace swallowtail::gtsp::detail {
namespace {

// Ours, by measurement on random instances.
constexpr double kHot = 0.3;    ///< first temperature, of the mean arc
constexpr double kCold = 0.01;  ///< last
constexpr int kMostRemoved = 12;

double iterations_per_cluster(Mode mode) {
  return mode == Mode::kFast ? 200.0 : mode == Mode::kSlow ? 8000.0 : 1200.0;
}

/// See ExactParams::work.
double exact_work(Mode mode) { return mode == Mode::kFast ? 1e9 : mode == Mode::kSlow ? 4e10 : 5e9; }

}  // namespace

PrecedenceSearch::PrecedenceSearch(const Instance& instance, const Options& options)
    : instance_(instance),
      options_(options),
      incumbents_(options),
      rng_(options.seed),
      is_closed_(options.kind == TourKind::kClosed),
      lead_(options.fixed_prefix) {
  if (lead_.empty() && options.start_vertex) lead_.push_back(*options.start_vertex);
  const bool ends_in_lead = options.end_vertex && !lead_.empty() && lead_.back() == *options.end_vertex;
  if (!ends_in_lead) end_ = options.end_vertex;
  std::vector<char> is_fixed(at(cluster_count()), 0);
  for (const int v : lead_) is_fixed[at(instance.cluster_of(v))] = 1;
  if (end_) is_fixed[at(instance.cluster_of(*end_))] = 1;
  for (int c = 0; c < cluster_count(); ++c) {
    if (is_fixed[at(c)] == 0) free_.push_back(c);
  }
  close_precedence();
}

void PrecedenceSearch::close_precedence() {
  const std::size_t m = at(cluster_count());
  precedes_.assign(m * m, 0);
  for (const auto& [before, after] : options_.precedence) precedes_[at(before) * m + at(after)] = 1;
  for (std::size_t via = 0; via < m; ++via) {
    for (std::size_t a = 0; a < m; ++a) {
      if (precedes_[a * m + via] == 0) continue;
      for (std::size_t b = 0; b < m; ++b) precedes_[a * m + b] |= precedes_[via * m + b];
    }
  }
}

Solution PrecedenceSearch::solve() {
  solution_.reason = "The search ended at its limit of work or time.";
  if (!solve_over_subsets()) {
    begin();
    anneal();
    judge();
  }
  solution_.tour = best_.tour;
  solution_.cost = best_.cost;
  solution_.history = incumbents_.history();
  return std::move(solution_);
}

/// Whether that was possible: then all is known.
bool PrecedenceSearch::solve_over_subsets() {
  const Anchor anchor = make_anchor(instance_, options_);
  if (free_.empty() || anchor.inner_cost == kNoArc) return false;
  const Pruning pruning = prune(instance_, anchor);
  ExactAnswer answer{ExactAnswer::Kind::kNoTour, {}, kNoArc};
  if (!pruning.has_no_tour()) {
    const ExactParams params{.work = exact_work(options_.mode), .precedence = options_.precedence};
    answer = solve_exactly(instance_, anchor, pruning, params, options_.stop);
  }
  if (answer.kind == ExactAnswer::Kind::kNoTour) {
    solution_.status = SolveStatus::kInfeasible;
    solution_.lower_bound = kNoArc;
    solution_.reason = "All orders of the clusters were considered: each needs a missing arc.";
    return true;
  }
  if (answer.kind != ExactAnswer::Kind::kSolved) return false;
  const auto same = [](int v) { return v; };
  best_ = found_from(instance_, anchor, answer.order, same, options_.kind);
  incumbents_.offer(best_, 0);
  solution_.status = SolveStatus::kOptimal;
  solution_.proved_optimal = true;
  solution_.lower_bound = best_.cost;
  solution_.reason = "Dynamic programming over all subsets of clusters.";
  return true;
}

void PrecedenceSearch::judge() {
  if (free_.empty() && !best_.tour.empty()) {
    solution_.status = SolveStatus::kOptimal;
    solution_.proved_optimal = true;
    solution_.lower_bound = best_.cost;
    solution_.reason = "There is only one tour to consider.";
  } else if (free_.empty()) {
    solution_.status = SolveStatus::kInfeasible;
    solution_.lower_bound = kNoArc;
    solution_.reason = "Between the fixed vertices of the tour an arc is missing.";
  } else if (options_.stop.interrupted()) {
    solution_.status = SolveStatus::kInterrupted;
    solution_.reason = "Stop was requested.";
  } else if (!best_.tour.empty()) {
    solution_.status = SolveStatus::kFeasible;
  } else {
    solution_.reason = "The search met no tour without missing arcs; whether there is one is open.";
  }
}

/// The warm tour's usable part in order, or clusters in random order, each at its cheapest place.
void PrecedenceSearch::begin() {
  tour_ = lead_;
  if (end_) tour_.push_back(*end_);
  std::vector<int> left = free_;
  for (std::size_t i = left.size(); i > 1; --i) std::swap(left[i - 1], left[rng_.below(i)]);
  if (options_.warm_tour) {
    std::vector<int> warm;
    for (const int v : *options_.warm_tour) {
      if (v < 0 || v >= instance_.vertex_count()) continue;
      const auto found = std::find(left.begin(), left.end(), instance_.cluster_of(v));
      if (found == left.end()) continue;
      const bool comes_too_late = std::any_of(warm.begin(), warm.end(), [&](int u) {
        return precedes(instance_.cluster_of(v), instance_.cluster_of(u));
      });
      if (comes_too_late) continue;
      left.erase(found);
      warm.push_back(v);
    }
    tour_.insert(tour_.begin() + static_cast<std::ptrdiff_t>(lead_.size()), warm.begin(), warm.end());
  }
  for (const int c : left) put_in(c);
  offer(0);
}

/// Vertex at the place, around the tour's ends if it is closed; −1 = none.
int PrecedenceSearch::neighbour(int place) const {
  const int size = static_cast<int>(tour_.size());
  if (size == 0) return -1;
  if (place >= 0 && place < size) return tour_[at(place)];
  return is_closed_ ? tour_[at(place < 0 ? size - 1 : 0)] : -1;
}

/// What putting v before what is at `place` changes.
Score PrecedenceSearch::insertion(int place, int v) const {
  Score change;
  const int before = neighbour(place - 1);
  const int after = neighbour(place);
  if (before >= 0) change.add(instance_.cost(before, v));
  if (after >= 0) change.add(instance_.cost(v, after));
  if (before >= 0 && after >= 0 && before != after) change.subtract(instance_.cost(before, after));
  return change;
}

void PrecedenceSearch::put_in(int cluster) {
  int first = static_cast<int>(lead_.size());
  int last = last_place();
  for (int i = 0; i < static_cast<int>(tour_.size()); ++i) {
    const int other = instance_.cluster_of(tour_[at(i)]);
    if (precedes(other, cluster)) first = std::max(first, i + 1);
    if (precedes(cluster, other)) last = std::min(last, i);
  }
  Score least{1 << 20, 0.0};
  int best_place = first;
  int best_vertex = instance_.cluster(cluster).front();
  for (int place = first; place <= last; ++place) {
    for (const int v : instance_.cluster(cluster)) {
      const Score change = insertion(place, v);
      if (!(change < least)) continue;
      least = change;
      best_place = place;
      best_vertex = v;
    }
  }
  tour_.insert(tour_.begin() + best_place, best_vertex);
}

/// A stretch of the tour, or clusters here and there.
void PrecedenceSearch::take_out(int count, std::vector<int>& removed) {
  removed.clear();
  const int first = static_cast<int>(lead_.size());
  const bool is_stretch = rng_.below(2) == 0;
  int place = first + static_cast<int>(rng_.below(at(last_place() - first)));
  for (; count > 0 && last_place() > first; --count) {
    if (!is_stretch) place = first + static_cast<int>(rng_.below(at(last_place() - first)));
    place = std::min(place, last_place() - 1);
    removed.push_back(instance_.cluster_of(tour_[at(place)]));
    tour_.erase(tour_.begin() + place);
  }
  for (std::size_t i = removed.size(); i > 1; --i) std::swap(removed[i - 1], removed[rng_.below(i)]);
}

Score PrecedenceSearch::score_of(const std::vector<int>& tour) const {
  Score score;
  for (std::size_t i = 1; i < tour.size(); ++i) score.add(instance_.cost(tour[i - 1], tour[i]));
  if (is_closed_ && tour.size() > 1) score.add(instance_.cost(tour.back(), tour.front()));
  return score;
}

/// The cheapest vertices for the tour's order, with its first vertex kept.
void PrecedenceSearch::choose_vertices() {
  const std::size_t m = tour_.size();
  std::vector<std::vector<int>> choice(m);
  for (std::size_t i = 0; i < m; ++i) {
    const bool is_fixed = i < std::max<std::size_t>(lead_.size(), 1) || (end_ && i + 1 == m);
    if (is_fixed) {
      choice[i] = {tour_[i]};
    } else {
      const auto members = instance_.cluster(instance_.cluster_of(tour_[i]));
      choice[i].assign(members.begin(), members.end());
    }
  }
  std::vector<std::vector<int>> from(m);
  std::vector<double> sum = {0.0};
  for (std::size_t i = 1; i < m; ++i) {
    std::vector<double> next(choice[i].size(), kNoArc);
    from[i].assign(choice[i].size(), 0);
    for (std::size_t b = 0; b < choice[i].size(); ++b) {
      for (std::size_t a = 0; a < choice[i - 1].size(); ++a) {
        const double reached = sum[a] + instance_.cost(choice[i - 1][a], choice[i][b]);
        if (!(reached < next[b])) continue;
        next[b] = reached;
        from[i][b] = static_cast<int>(a);
      }
    }
    sum = std::move(next);
  }
  for (std::size_t a = 0; is_closed_ && m > 1 && a < sum.size(); ++a)
    sum[a] += instance_.cost(choice.back()[a], tour_.front());
  const auto least = std::min_element(sum.begin(), sum.end());
  if (*least == kNoArc) return;
  auto pick = static_cast<std::size_t>(least - sum.begin());
  for (std::size_t i = m; i-- > 0;) {
    tour_[i] = choice[i][pick];
    if (i > 0) pick = at(from[i][pick]);
  }
}

void PrecedenceSearch::offer(std::uint64_t iteration) {
  choose_vertices();
  const Score score = score_of(tour_);
  if (score.missing > 0 || !(score.cost < best_.cost)) return;
  best_ = {tour_, score.cost};
  incumbents_.offer(best_, iteration);
}

bool PrecedenceSearch::accepts(const Score& candidate, const Score& current, double temperature) {
  if (!(current < candidate)) return true;
  if (candidate.missing != current.missing) return false;
  return rng_.uniform() < std::exp((current.cost - candidate.cost) / std::max(temperature, 1e-12));
}

void PrecedenceSearch::anneal() {
  const auto natural = static_cast<std::uint64_t>(iterations_per_cluster(options_.mode) * cluster_count());
  const std::uint64_t most = std::min({natural, options_.stop.max_iterations, options_.stop.max_evaluations});
  if (free_.empty()) return;
  Score current = score_of(tour_);
  const double mean_arc = std::max(current.cost, 1e-9) / static_cast<double>(tour_.size());
  std::vector<int> old;
  std::vector<int> removed;
  for (std::uint64_t i = 0; i < most && !options_.stop.reached(0, 0); ++i) {
    const double progress = static_cast<double>(i) / static_cast<double>(most);
    const double temperature = mean_arc * kHot * std::pow(kCold / kHot, progress);
    old = tour_;
    const int most_removed = std::min(kMostRemoved, std::max(1, static_cast<int>(free_.size()) / 2));
    take_out(1 + static_cast<int>(rng_.below(at(most_removed))), removed);
    for (const int c : removed) put_in(c);
    Score candidate = score_of(tour_);
    if (candidate.missing == 0 && candidate.cost < best_.cost) {
      offer(i);
      candidate = score_of(tour_);
    }
    if (accepts(candidate, current, temperature)) {
      current = candidate;
    } else {
      tour_.swap(old);
    }
    ++solution_.iterations;
  }
}

}  // namespace swallowtail::gtsp::detail
