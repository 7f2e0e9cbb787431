#include "coverage/gtsp/proof/ascent.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace swallowtail::gtsp::proof {
namespace {

// Ours, by measurement on random instances and the files of [GTSPLIB].
constexpr int kFirstMemory = 4;
constexpr int kWindow = 6;            ///< arcs
constexpr double kWindowShare = 0.5;  ///< of the first climb's work, where whole walks may prove a tour best
constexpr int kFewClusters = 60;      ///< up to so many they may
constexpr double kBelowAll = -1e300;
constexpr double kNear = 0.985;    ///< bound to upper bound: from there on whole walks are better
constexpr double kLearning = 0.3;  ///< of potentials, from each look through the windows
constexpr int kWalksBetweenListings = 4;
constexpr std::size_t kGrowth = 1;  ///< of each memory at once, by windows
constexpr int kFirstArcs = 14;
constexpr double kFewArcs = 6'000.0;  ///< up to so many are all listed
constexpr double kMaxBytes = 192e6;   ///< of one direction's values
constexpr double kStepScale = 0.2;    ///< of Polyak's step
constexpr double kMomentum = 0.5;
constexpr int kPatience = 6;  ///< walks without a better bound before the step is cut
constexpr double kStepCut = 0.6;
constexpr double kLeastStep = 0.2;  ///< below, memory grows
constexpr double kStepAfterWidening = 0.6;
constexpr double kLeastWindowStep = 0.1;
constexpr double kWindowStepAfterWidening = 0.25;
constexpr std::size_t kRecentWalks = 12;
constexpr double kRounding = 1e-10;  ///< relative, of sums of doubles

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

WalkAscent::WalkAscent(WalkGraph& graph, double upper_bound)
    : graph_(graph), walks_(graph), upper_bound_(upper_bound) {
  graph_.leave_out_above(upper_bound);
  set_first_prices();
  remember_nearest();
}

WalkAscent::WalkAscent(WalkGraph& copy, const WalkAscent& original)
    : graph_(copy),
      walks_(copy),
      upper_bound_(original.upper_bound_),
      bound_(original.bound_),
      price_(original.best_price_),
      best_price_(original.best_price_),
      direction_(original.direction_.size(), 0.0) {
  walks_.rememorise(original.walks_.memory(), kNoArc);
}

WalkAscent WalkAscent::on(WalkGraph& copy) const { return {copy, *this}; }

/// Half of the cheapest way into and out of one vertex of the cluster; a bound by itself.
void WalkAscent::set_first_prices() {
  const int m = graph_.cluster_count();
  price_.assign(at(m), 0.0);
  graph_.list_cheapest(price_, std::max(kFirstArcs, static_cast<int>(kFewArcs / graph_.size())));
  std::vector<double> in(at(graph_.size()), kNoArc);
  std::vector<double> out(at(graph_.size()), kNoArc);
  for (int u = 0; u < graph_.size(); ++u) {
    for (const WalkGraph::Arc& arc : graph_.out(u)) {
      out[at(u)] = std::min(out[at(u)], arc.cost);
      in[at(arc.to)] = std::min(in[at(arc.to)], arc.cost);
    }
  }
  for (int c = 0; c < m; ++c) {
    double least = kNoArc;
    for (int v = graph_.first(c); v < graph_.last(c); ++v) {
      const double into = in[at(v)] == kNoArc ? out[at(v)] : in[at(v)];
      least = std::min(least, (into + out[at(v)]) / 2.0);
    }
    price_[at(c)] = least == kNoArc ? 0.0 : least;
  }
  best_price_ = price_;
  direction_.assign(at(m), 0.0);
}

/// From time to time, lists the arcs that walks used without being listed.
void WalkAscent::list_leaps() {
  if (++walks_since_listing_ < kWalksBetweenListings || leaps_.empty()) return;
  walks_since_listing_ = 0;
  graph_.list_also(std::move(leaps_));
  leaps_.clear();
  walks_.rememorise(walks_.memory(), kNoArc);
  work_ += 4.0 * walks_.layer_work();
}

void WalkAscent::remember_nearest() {
  const int m = graph_.cluster_count();
  const std::vector<double> least = graph_.least_listed();
  std::vector<std::vector<int>> memory;
  for (int c = 0; c < m; ++c) {
    std::vector<std::pair<double, int>> near;
    for (int other = 0; other < m; ++other) {
      const double cost = std::min(least[at(c) * at(m) + at(other)], least[at(other) * at(m) + at(c)]);
      if (other != c && cost != kNoArc) near.emplace_back(cost, other);
    }
    const std::size_t count = std::min<std::size_t>(near.size(), kFirstMemory - 1);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
    memory.push_back({c});
    for (std::size_t i = 0; i < count; ++i) memory.back().push_back(near[i].second);
  }
  walks_.rememorise(std::move(memory), kNoArc);
}

double WalkAscent::rounded(double value) const {
  return graph_.is_integer() ? std::ceil(value - 1e-6) : value;
}

double WalkAscent::target() const {
  const double reach = upper_bound_ != kNoArc ? upper_bound_ : 1.05 * bound_;
  return std::max(reach, 1.002 * bound_ + 1e-9);
}

WalkAscent::End WalkAscent::climb(double work, const StopCondition& stop) {
  const double end = work_ + work;
  if (!is_warm_) {
    is_warm_ = true;
    const bool is_provable = upper_bound_ == kNoArc || graph_.cluster_count() <= kFewClusters;
    const double share = is_provable ? kWindowShare : 1.0;
    const End warm = climb_by_windows(share * work, stop);
    if (warm != End::kWork) return warm;
    step_back();
    step_ = 1.0;
    level_ = kBelowAll;
  }
  while (work_ + walks_.pass_work() <= end) {
    if (stop.reached(0, 0)) return End::kStopped;
    const double least = walks_.forward(price_);
    work_ += walks_.pass_work();
    if (least == kNoArc) return End::kNoWalk;
    const double value = least + sum_of(price_);
    const NgWalks::Walk walk = walks_.least_walk();
    const bool is_tour = note_walk(walk);
    note_value(value);
    if (rounded(bound_) >= upper_bound_) return End::kProved;
    if (is_tour) return End::kTour;
    std::vector<double> missing(price_.size(), 1.0);
    for (std::size_t i = 1; i < walk.vertices.size(); ++i)
      missing[at(graph_.cluster_of(walk.vertices[i]))] -= 1.0;
    move_prices(value, missing);
    list_leaps();
    if (step_ < kLeastStep && !widen(end - work_)) return End::kStalled;
  }
  return End::kWork;
}

WalkAscent::End WalkAscent::climb_by_windows(double work, const StopCondition& stop) {
  const int arcs = std::min(kWindow, graph_.cluster_count() - 1);
  const double end = work_ + work;
  best_potential_ = walks_.potentials();
  while (work_ + window_work(arcs) <= end) {
    if (stop.reached(0, 0)) return End::kStopped;
    std::vector<double> missing(price_.size(), 1.0);
    const double value = look_through_windows(arcs, missing);
    if (value == kNoArc) return End::kNoWalk;
    note_value(value);
    if (rounded(bound_) >= upper_bound_) return End::kProved;
    if (upper_bound_ != kNoArc && bound_ > kNear * upper_bound_) break;
    if (walks_.forgets_all()) walks_.learn_potentials(kLearning);
    move_prices(value, missing);
    list_leaps();
    if (step_ < kLeastWindowStep && !widen_windows(arcs, end - work_)) break;
  }
  step_back();
  return End::kWork;
}

double WalkAscent::window_work(int arcs) const { return 1.2 * walks_.layer_work() * arcs; }

/// The bound of the windows from all clusters; takes from `missing` how often they visit each cluster.
double WalkAscent::look_through_windows(int arcs, std::vector<double>& missing) {
  const std::vector<double> least = walks_.windows(price_, arcs);
  work_ += window_work(arcs);
  double sum = 0.0;
  for (int c = 0; c < graph_.cluster_count(); ++c) {
    if (least[at(c)] == kNoArc) return kNoArc;
    sum += least[at(c)];
    const NgWalks::Walk window = walks_.window(c);
    leaps_.insert(leaps_.end(), window.leaps.begin(), window.leaps.end());
    recent_.emplace_back();
    for (std::size_t i = 0; i < window.vertices.size(); ++i) {
      recent_.back().push_back(graph_.cluster_of(window.vertices[i]));
      if (i > 0) missing[at(recent_.back().back())] -= 1.0 / arcs;
    }
  }
  while (recent_.size() > 3 * at(graph_.cluster_count())) recent_.pop_front();
  return sum / arcs + sum_of(price_);
}

/// False when it is not worth going on by windows.
bool WalkAscent::widen_windows(int arcs, double work_left) {
  constexpr double kWindowsToUse = 20.0;
  step_ = kWindowStepAfterWidening;
  step_back();
  const auto old = walks_.memory();
  auto memory = widened(arcs, kGrowth);
  if (memory == old || !walks_.rememorise(std::move(memory), kMaxBytes)) return false;
  if (!walks_.forgets_all() || kWindowsToUse * window_work(arcs) > work_left) {
    walks_.rememorise(old, kNoArc);
    return false;
  }
  best_potential_ = walks_.potentials();
  return true;
}

/// Whether the walk is a tour.
bool WalkAscent::note_walk(const NgWalks::Walk& walk) {
  std::vector<int> clusters;
  for (const int v : walk.vertices) clusters.push_back(graph_.cluster_of(v));
  std::vector<int> sorted(clusters.begin() + 1, clusters.end());
  std::sort(sorted.begin(), sorted.end());
  const bool is_elementary = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
  const bool is_tour = is_elementary && walk.leaps.empty() && walk.vertices.front() == walk.vertices.back();
  if (is_tour) tour_.assign(walk.vertices.begin(), walk.vertices.end() - 1);
  leaps_.insert(leaps_.end(), walk.leaps.begin(), walk.leaps.end());
  clusters.pop_back();
  recent_.push_back(std::move(clusters));
  if (recent_.size() > kRecentWalks) recent_.pop_front();
  return is_tour;
}

void WalkAscent::note_value(double value) {
  double size = 1.0;
  for (const double price : price_) size += std::abs(price);
  value -= kRounding * size;
  stall_ = value > level_ + 1e-5 * std::abs(level_) ? 0 : stall_ + 1;
  bound_ = std::max(bound_, value);
  if (value <= level_) return;
  level_ = value;
  best_price_ = price_;
  best_potential_ = walks_.potentials();
}

void WalkAscent::step_back() {
  stall_ = 0;
  price_ = best_price_;
  if (best_potential_.size() == walks_.potentials().size()) walks_.set_potentials(best_potential_);
  std::fill(direction_.begin(), direction_.end(), 0.0);
}

void WalkAscent::move_prices(double value, const std::vector<double>& missing) {
  if (stall_ > kPatience) {
    step_ *= kStepCut;
    step_back();
    return;
  }
  double norm = 0.0;
  for (std::size_t c = 0; c < direction_.size(); ++c) {
    direction_[c] = kMomentum * direction_[c] + (1.0 - kMomentum) * missing[c];
    norm += direction_[c] * direction_[c];
  }
  const double length = step_ * kStepScale * (target() - value) / std::max(norm, 1e-9);
  for (std::size_t c = 0; c < direction_.size(); ++c) price_[c] += length * direction_[c];
}

/// Memory of each cluster with those that recent walks came back to around it most often, over at most
/// `longest` arcs; at most `most` more for each.
std::vector<std::vector<int>> WalkAscent::widened(int longest, std::size_t most) const {
  const int m = graph_.cluster_count();
  std::vector<int> returns(at(m) * at(m), 0);  // to a cluster, by cluster in between
  for (const std::vector<int>& walk : recent_) {
    std::vector<int> seen(at(m), -1);
    for (int j = 0; j < static_cast<int>(walk.size()); ++j) {
      const int c = walk[at(j)];
      const int i = std::exchange(seen[at(c)], j);
      if (i < 0 || j - i > longest) continue;
      for (int k = i + 1; k < j; ++k) ++returns[at(walk[at(k)]) * at(m) + at(c)];
    }
  }
  auto memory = walks_.memory();
  for (int between = 0; between < m; ++between) {
    auto& known = memory[at(between)];
    int* const count = returns.data() + at(between) * at(m);
    for (const int c : known) count[c] = 0;
    for (std::size_t i = 0; i < most && known.size() < NgWalks::kMaxMemory; ++i) {
      int* const often = std::max_element(count, count + m);
      if (*often == 0) break;
      *often = 0;
      known.push_back(static_cast<int>(often - count));
    }
  }
  return memory;
}

bool WalkAscent::widen(double work_left) {
  constexpr double kPassesToUse = 12.0;
  step_ = kStepAfterWidening;
  step_back();
  if (upper_bound_ != kNoArc && bound_ > 0.85 * upper_bound_) {
    const double cut = graph_.is_integer() ? upper_bound_ - 1.0 + 1e-6 : upper_bound_;
    drop_arcs(cut, 40 * at(graph_.size()) + at(static_cast<int>(kFewArcs)));
  }
  auto memory = widened(4, NgWalks::kMaxMemory);
  if (memory == walks_.memory()) memory = widened(graph_.cluster_count(), NgWalks::kMaxMemory);
  if (memory == walks_.memory()) return true;
  const auto old = walks_.memory();
  const bool fits = walks_.rememorise(std::move(memory), kMaxBytes);
  if (fits && kPassesToUse * walks_.pass_work() <= work_left) return true;
  if (fits) walks_.rememorise(old, kNoArc);
  return false;
}

bool WalkAscent::drop_arcs(double cut, std::size_t limit) {
  const int m = graph_.cluster_count();
  walks_.forward(best_price_);
  walks_.backward(best_price_, {});
  work_ += 2.0 * walks_.pass_work();
  const std::size_t n = at(graph_.size());
  std::vector<double> to(n * at(m));
  std::vector<double> from(n * at(m));
  for (int v = 0; v < graph_.size(); ++v) {
    for (int k = 0; k < m; ++k) {
      to[at(v) * at(m) + at(k)] = walks_.least_to(k, v);
      from[at(v) * at(m) + at(k)] = walks_.least_from(k + 1, v);
    }
  }
  const double open = cut - sum_of(best_price_) + kRounding * (std::abs(cut) + sum_of(best_price_));
  const auto keep = [&](int u, int v, double cost) {
    const double room = open - (cost - best_price_[at(graph_.cluster_of(v))]);
    const double* const before = to.data() + at(u) * at(m);
    const double* const after = from.data() + at(v) * at(m);
    double least = kNoArc;
    for (int k = 0; k < m; ++k) least = std::min(least, before[k] + after[k]);
    return least <= room;
  };
  work_ += static_cast<double>(graph_.has_beyond() ? n * n : graph_.listed()) * m / 4.0;
  if (!graph_.list_only(keep, limit)) return false;
  walks_.rememorise(walks_.memory(), kNoArc);
  return true;
}

}  // namespace swallowtail::gtsp::proof
