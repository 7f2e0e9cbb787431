#include "coverage/gtsp/detail/trial.hpp"

#include <algorithm>
#include <cmath>

namespace swallowtail::gtsp::detail {
namespace {

constexpr std::uint64_t kIterationsPerSettling = 500;
constexpr double kReaction = 0.3;     ///< weight of the latest settling
constexpr double kLeastWeight = 0.1;  ///< no heuristic dies out
/// While arcs are missing, cost does not count for acceptance, and one more may be missing with this
/// probability.
constexpr double kExtraMissing = 0.02;

/// Rewards: for a best tour, a better one, one accepted.
constexpr double kBestReward = 10.0;
constexpr double kBetterReward = 3.0;
constexpr double kAcceptedReward = 1.0;

bool is_less(const Score& a, const Score& b) {
  if (a.missing != b.missing) return a.missing < b.missing;
  return a.cost < b.cost - 1e-9 * std::abs(b.cost);
}

}  // namespace

template <int kCount>
int Trial::Wheel<kCount>::spin(Rng& rng) const {
  double sum = 0.0;
  for (const double w : weight) sum += w;
  double left = rng.uniform() * sum;
  for (int i = 0; i + 1 < kCount; ++i) {
    left -= weight[static_cast<std::size_t>(i)];
    if (left < 0.0) return i;
  }
  return kCount - 1;
}

template <int kCount>
void Trial::Wheel<kCount>::reward(int i, double value) {
  gain[static_cast<std::size_t>(i)] += value;
  ++used[static_cast<std::size_t>(i)];
}

template <int kCount>
void Trial::Wheel<kCount>::settle() {
  for (std::size_t i = 0; i < weight.size(); ++i) {
    if (used[i] > 0)
      weight[i] = std::max(kLeastWeight, (1.0 - kReaction) * weight[i] + kReaction * gain[i] / used[i]);
    gain[i] = 0.0;
    used[i] = 0;
  }
}

Trial::Trial(const Reduced& reduced, const TrialParams& params, Rng rng)
    : reduced_(reduced),
      params_(params),
      rng_(rng),
      inserter_(reduced_, rng_),
      remover_(reduced_, rng_),
      cluster_path_(reduced_),
      two_opt_(reduced_) {
  inserter_.blink = params_.blink;
}

WorkTour Trial::construct() {
  WorkTour tour;
  const int any = static_cast<int>(rng_.below(static_cast<std::uint64_t>(reduced_.size())));
  tour.order = {reduced_.anchor() >= 0 ? reduced_.anchor() : any};
  tour.measure(reduced_);
  complete(tour);
  return tour;
}

void Trial::complete(WorkTour& tour) {
  std::vector<char> is_in(static_cast<std::size_t>(reduced_.cluster_count()), 0);
  for (const int v : tour.order) is_in[static_cast<std::size_t>(reduced_.cluster_of(v))] = 1;
  std::vector<int> out;
  for (int c = 0; c < reduced_.cluster_count(); ++c) {
    if (is_in[static_cast<std::size_t>(c)] == 0) out.push_back(c);
  }
  cluster_path_.improve(tour, ClusterPath::Start::kAny);
  inserter_.insert_all(tour, out, InsertionRule::kRandom);
  tour.measure(reduced_);
  polish(tour);
}

void Trial::polish(WorkTour& tour) {
  const double blink = std::exchange(inserter_.blink, 0.0);
  for (bool improved = true; improved;) {
    const Score before = tour.score;
    cluster_path_.improve(tour, ClusterPath::Start::kAny);
    two_opt_.improve(tour);
    move_clusters(reduced_, inserter_, tour);
    tour.measure(reduced_);
    improved = is_less(tour.score, before);
  }
  inserter_.blink = blink;
}

bool Trial::accepts(const Score& candidate, double temperature) {
  const int extra = candidate.missing - current_.score.missing;
  if (extra < 0) return true;
  if (extra > 0) return current_.score.missing > 0 && extra == 1 && rng_.uniform() < kExtraMissing;
  if (current_.score.missing > 0) return true;
  return candidate.cost < current_.score.cost - temperature * std::log(1.0 - rng_.uniform());
}

void Trial::take_as_best(const Report& report) {
  polish(current_);
  best_ = current_.score;
  report(current_, iteration_);
}

void Trial::step(double progress, const Report& report) {
  const int most = std::clamp(2 * reduced_.cluster_count() / 3, 2, params_.max_removed);
  const int count = 1 + static_cast<int>(rng_.below(static_cast<std::uint64_t>(most)));
  const int removal = removal_wheel_.spin(rng_);
  const int insertion = insertion_wheel_.spin(rng_);
  remover_.remove(current_, count, static_cast<RemovalRule>(removal), work_);
  inserter_.insert_all(work_, remover_.removed(), static_cast<InsertionRule>(insertion));
  for (int p = 0; p < work_.size(); ++p) inserter_.pick_vertex(work_, p);

  const double temperature = params_.hot * mean_arc_ * std::pow(params_.cold / params_.hot, progress);
  double reward = 0.0;
  if (accepts(work_.score, temperature)) {
    reward = is_less(work_.score, current_.score) ? kBetterReward : kAcceptedReward;
    std::swap(current_, work_);
    if (is_less(current_.score, best_)) {
      reward = kBestReward;
      take_as_best(report);
    }
  }
  removal_wheel_.reward(removal, reward);
  insertion_wheel_.reward(insertion, reward);
}

void Trial::run(WorkTour start, const Progress& progress, const Report& report) {
  current_ = std::move(start);
  best_ = current_.score;
  report(current_, iteration_);
  mean_arc_ = current_.score.cost / std::max(1, current_.size() - current_.score.missing);
  double done = progress(0);
  while (done < 1.0 && reduced_.cluster_count() > 2) {
    ++iteration_;
    step(done, report);
    done = progress(iteration_);
    if (iteration_ % kIterationsPerSettling == 0) {
      removal_wheel_.settle();
      insertion_wheel_.settle();
    }
  }
}

}  // namespace swallowtail::gtsp::detail
