#include "coverage/gtsp/proof/subset_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace swallowtail::gtsp::proof {
namespace {

constexpr std::size_t kOrders = 6;  ///< of clusters, tried for a first tour
constexpr double kWorthIt = 0.8;    ///< share of the vertices left below which they are laid out anew
constexpr double kSlack = 1e-12;    ///< relative, of sums of doubles

std::size_t at(int i) { return static_cast<std::size_t>(i); }

template <class Cost>
class SubsetSearch {
 public:
  using Table = SubsetTable<Cost>;
  using Ways = typename Table::Ways;
  using End = typename Table::End;

  SubsetSearch(const SubsetProblem& problem, const SubsetLimits& limits, const StopCondition& stop)
      : problem_(problem), limits_(limits), stop_(stop), n_(problem.vertex_count()) {}

  SubsetAnswer run() {
    living_ = problem_.clusters;
    limit_ = limit_of(limits_.upper_bound);
    best_ = limits_.upper_bound;
    while (lay_out() && narrow()) {
    }
    return std::move(answer_);
  }

 private:
  Cost cost(int from, int to) const {
    const double value = problem_.cost[at(from) * n_ + at(to)];
    return value == kNoArc ? kNoWay<Cost> : static_cast<Cost>(value);
  }

  /// Costs that sums must be below.
  Cost limit_of(double upper_bound) const {
    if (upper_bound >= static_cast<double>(kNoWay<Cost>)) return kNoWay<Cost>;
    if constexpr (std::is_same_v<Cost, double>) {
      return upper_bound * (1.0 + kSlack);
    } else {
      return static_cast<Cost>(std::ceil(upper_bound));
    }
  }

  /// False: nothing is left to do.
  bool end(SubsetAnswer::Kind kind) {
    answer_.kind = kind;
    return false;
  }
  bool end(End end_of_fill) {
    return end(end_of_fill == End::kStopped ? SubsetAnswer::Kind::kStopped : SubsetAnswer::Kind::kTooMuch);
  }

  /// Slots and costs for what is left, from the root cluster with the fewest vertices.
  bool lay_out() {
    const auto is_smaller = [](const auto& a, const auto& b) { return a.size() < b.size(); };
    root_ = problem_.root >= 0
                ? problem_.root
                : static_cast<int>(std::min_element(living_.begin(), living_.end(), is_smaller) -
                                   living_.begin());
    slots_ = {.cluster = {}, .first = {0}, .vertex = {}};
    for (int c = 0; c < static_cast<int>(living_.size()); ++c) {
      if (c == root_) continue;
      slots_.cluster.push_back(c);
      slots_.vertex.insert(slots_.vertex.end(), living_[at(c)].begin(), living_[at(c)].end());
      while (slots_.vertex.size() % kSubsetLanes != 0) slots_.vertex.push_back(-1);
      slots_.first.push_back(static_cast<int>(slots_.vertex.size()));
    }
    const double bytes = std::ldexp(2.0 * sizeof(Cost) * slots_.count(), slots_.bits());
    if (bytes > limits_.max_bytes || work_of_all_ways() > work_left())
      return end(SubsetAnswer::Kind::kTooMuch);
    load_steps();
    load_needs();
    return true;
  }

  /// Steps of a table without a completion.
  double work_of_all_ways() const {
    double pairs = 0.0;
    for (int bit = 0; bit < slots_.bits(); ++bit)
      pairs += static_cast<double>(slots_.count() - slots_.width(bit)) * slots_.width(bit);
    return std::ldexp(pairs, slots_.bits() - 2);
  }

  void load_steps() {
    const std::size_t count = at(slots_.count());
    out_.steps.assign(count * count, kNoWay<Cost>);
    back_.steps = out_.steps;
    for (int bit = 0; bit < slots_.bits(); ++bit) {
      const int width = slots_.width(bit);
      Cost* out = out_.steps.data() + at(slots_.first[at(bit)]) * count;
      Cost* back = back_.steps.data() + at(slots_.first[at(bit)]) * count;
      for (const int u : slots_.vertex) {
        for (int lane = 0; lane < width; ++lane, ++out, ++back) {
          const int v = slots_.vertex[at(slots_.first[at(bit)] + lane)];
          if (u < 0 || v < 0) continue;
          *out = cost(u, v);
          *back = cost(v, u);
        }
      }
    }
  }

  /// Before the root there is nothing; on ways back, what comes after is already there.
  void load_needs() {
    out_.needs.assign(at(slots_.bits()), 0);
    back_.needs = out_.needs;
    if (problem_.before.empty()) return;
    std::vector<int> bit_of(living_.size(), -1);
    for (int bit = 0; bit < slots_.bits(); ++bit) bit_of[at(slots_.cluster[at(bit)])] = bit;
    for (int bit = 0; bit < slots_.bits(); ++bit) {
      for (const int earlier : problem_.before[at(slots_.cluster[at(bit)])]) {
        const int earlier_bit = bit_of[at(earlier)];
        if (earlier_bit < 0) continue;
        out_.needs[at(bit)] |= SubsetMask{1} << earlier_bit;
        back_.needs[at(earlier_bit)] |= SubsetMask{1} << bit;
      }
    }
  }

  /// Cost by slot of the arc from (or to) the cheapest of `roots`.
  std::vector<Cost> least_from(const std::vector<int>& roots, bool is_outwards) const {
    std::vector<Cost> least(at(slots_.count()), kNoWay<Cost>);
    for (std::size_t slot = 0; slot < least.size(); ++slot) {
      const int v = slots_.vertex[slot];
      for (const int root : roots) {
        if (v >= 0) least[slot] = std::min(least[slot], is_outwards ? cost(root, v) : cost(v, root));
      }
    }
    return least;
  }

  /// Leaves out what no tour below the limit uses. True when it is worth starting anew; else all is done.
  bool narrow() {
    Table back(slots_);
    std::vector<int>& roots = living_[at(root_)];
    back_.start = least_from(roots, false);
    if (const End e = back.fill(back_, nullptr, work_left(), stop_); e != End::kFilled) return end(e);
    work_ += back.work();
    const std::vector<Cost> bounds = bounds_of(roots, back);
    const Cost least = bounds.empty() ? kNoWay<Cost> : *std::min_element(bounds.begin(), bounds.end());
    raise_bound(least);
    seek_tours(roots, bounds, back);
    std::vector<int> left;
    for (std::size_t i = 0; i < roots.size(); ++i) {
      if (bounds[i] < limit_) left.push_back(roots[i]);
    }
    const std::size_t before = total();
    roots = std::move(left);
    if (roots.empty()) return conclude();
    Table out(slots_);
    out_.start = least_from(roots, true);
    const typename Table::Completion completion{back, limit_};
    if (const End e = out.fill(out_, &completion, work_left(), stop_); e != End::kFilled) return end(e);
    work_ += out.work();
    drop_unused(out.is_used());
    if (std::any_of(living_.begin(), living_.end(), [](const auto& c) { return c.empty(); }))
      return conclude();
    if (static_cast<double>(total()) < kWorthIt * static_cast<double>(before)) return true;
    search_from_each(roots, back, out);
    return false;
  }

  double work_left() const { return limits_.work - work_; }
  std::size_t total() const {
    return std::accumulate(living_.begin(), living_.end(), std::size_t{0},
                           [](std::size_t sum, const auto& c) { return sum + c.size(); });
  }

  void raise_bound(Cost least) {
    const double bound = least >= kNoWay<Cost> ? kNoArc : static_cast<double>(least) * (1.0 - kSlack);
    const double rounded = std::is_same_v<Cost, double> ? bound : std::ceil(bound);
    answer_.lower_bound = std::max(answer_.lower_bound, std::min(rounded, best_));
  }

  /// By root vertex, the least way out of it and back to any.
  std::vector<Cost> bounds_of(const std::vector<int>& roots, const Table& back) const {
    std::vector<Cost> bounds;
    for (const int root : roots) {
      bounds.push_back(kNoWay<Cost>);
      for (int slot = 0; slot < slots_.count(); ++slot) {
        const int v = slots_.vertex[at(slot)];
        if (v >= 0) bounds.back() = std::min(bounds.back(), cost(root, v) + back.least(back.all(), slot));
      }
    }
    return bounds;
  }

  void drop_unused(const std::vector<char>& is_used) {
    for (int bit = 0; bit < slots_.bits(); ++bit) {
      std::vector<int>& vertices = living_[at(slots_.cluster[at(bit)])];
      vertices.clear();
      for (int slot = slots_.first[at(bit)]; slot < slots_.first[at(bit) + 1]; ++slot) {
        if (is_used[at(slot)] != 0) vertices.push_back(slots_.vertex[at(slot)]);
      }
    }
  }

  /// Indices, so that good tours come early.
  std::vector<std::size_t> by_value(const std::vector<Cost>& bounds) const {
    std::vector<std::size_t> order(bounds.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return bounds[a] < bounds[b]; });
    return order;
  }

  /// Tours that visit the clusters as the least ways back to any root vertex do.
  void seek_tours(const std::vector<int>& roots, const std::vector<Cost>& bounds, const Table& back) {
    std::size_t tried = 0;
    for (const std::size_t i : by_value(bounds)) {
      if (bounds[i] >= limit_ || tried++ == kOrders) return;
      int first = 0;
      const auto value = [&](int slot) {
        const Cost onwards = back.least(back.all(), slot);
        return onwards >= kNoWay<Cost> ? onwards : cost(roots[i], slots_.vertex[at(slot)]) + onwards;
      };
      for (int slot = 1; slot < slots_.count(); ++slot) {
        if (value(slot) < value(first)) first = slot;
      }
      std::vector<const std::vector<int>*> order;
      for (const int slot : back.way_back(back_, back.all(), first))
        order.push_back(&living_[at(cluster_of(slot))]);
      for (const int root : roots) try_order(root, order);
    }
  }

  /// The best vertices for an order of clusters, from and to the root vertex [FISCHETTI-SALAZAR-TOTH].
  void try_order(int root, const std::vector<const std::vector<int>*>& order) {
    std::vector<Cost> sum{0};
    std::vector<int> previous{root};
    std::vector<std::vector<int>> from;
    for (const std::vector<int>* const cluster : order) {
      std::vector<Cost> next(cluster->size(), kNoWay<Cost>);
      from.emplace_back(cluster->size(), 0);
      for (std::size_t v = 0; v < cluster->size(); ++v) {
        for (std::size_t u = 0; u < previous.size(); ++u) {
          const Cost way = sum[u] + cost(previous[u], (*cluster)[v]);
          if (way >= next[v]) continue;
          next[v] = way;
          from.back()[v] = static_cast<int>(u);
        }
      }
      sum = std::move(next);
      previous = *cluster;
    }
    std::size_t last = 0;
    for (std::size_t u = 0; u < sum.size(); ++u) {
      sum[u] += cost(previous[u], root);
      if (sum[u] < sum[last]) last = u;
    }
    if (sum[last] >= kNoWay<Cost> || static_cast<double>(sum[last]) >= best_) return;
    std::vector<int> tour;
    for (std::size_t i = order.size(); i-- > 0;) {
      tour.push_back((*order[i])[last]);
      last = at(from[i][last]);
    }
    tour.push_back(root);
    std::reverse(tour.begin(), tour.end());
    take(std::move(tour), *std::min_element(sum.begin(), sum.end()));
  }

  void take(std::vector<int> tour, Cost cost) {
    answer_.tour = std::move(tour);
    answer_.cost = static_cast<double>(cost);
    best_ = answer_.cost;
    limit_ = limit_of(best_);
  }

  void search_from_each(std::vector<int> roots, const Table& back, Table& out) {
    const std::vector<Cost> bounds = bounds_of(roots, back);
    for (const std::size_t i : by_value(bounds)) {
      raise_bound(bounds[i]);
      if (bounds[i] >= limit_) break;
      const std::vector<int> root{roots[i]};
      const typename Table::Completion completion{back, limit_};
      out_.start = least_from(root, true);
      const double before = out.work();
      const End e = out.fill(out_, &completion, work_left(), stop_);
      work_ += out.work() - before;
      if (e != End::kFilled) {
        end(e);
        return;
      }
      close(root, out);
    }
    conclude();
  }

  /// Nothing better than the best tour is left.
  bool conclude() {
    answer_.lower_bound = best_;
    return end(answer_.tour.empty() ? SubsetAnswer::Kind::kNone : SubsetAnswer::Kind::kTour);
  }

  void close(const std::vector<int>& root, const Table& out) {
    const std::vector<Cost> home = least_from(root, false);
    int last = -1;
    Cost least = limit_of(best_);
    for (int slot = 0; slot < slots_.count(); ++slot) {
      const Cost sum = out.least(out.all(), slot) + home[at(slot)];
      if (sum >= least || static_cast<double>(sum) >= best_) continue;
      least = sum;
      last = slot;
    }
    if (last < 0) return;
    std::vector<int> tour{root.front()};
    const std::vector<int> way = out.way_back(out_, out.all(), last);
    for (auto slot = way.rbegin(); slot != way.rend(); ++slot) tour.push_back(slots_.vertex[at(*slot)]);
    take(std::move(tour), least);
  }

  int cluster_of(int slot) const {
    const auto after = std::upper_bound(slots_.first.begin(), slots_.first.end(), slot);
    return slots_.cluster[at(static_cast<int>(after - slots_.first.begin()) - 1)];
  }

  const SubsetProblem& problem_;
  const SubsetLimits& limits_;
  const StopCondition& stop_;
  std::size_t n_;
  std::vector<std::vector<int>> living_;  ///< by cluster
  int root_ = 0;
  SubsetSlots slots_;
  Ways out_;
  Ways back_;
  Cost limit_ = kNoWay<Cost>;
  double best_ = kNoArc;  ///< cost of the best tour, or the upper bound
  double work_ = 0.0;
  SubsetAnswer answer_;
};

/// Whether every tour is well below kNoWay32.
bool is_small_integer(const SubsetProblem& problem) {
  const double most = kNoWay32 / static_cast<double>(problem.clusters.size()) / 2.0;
  return std::all_of(problem.cost.begin(), problem.cost.end(), [&](double cost) {
    return cost == kNoArc || (cost <= most && cost == std::floor(cost));
  });
}

}  // namespace

std::size_t SubsetProblem::vertex_count() const {
  return std::accumulate(clusters.begin(), clusters.end(), std::size_t{0},
                         [](std::size_t sum, const auto& c) { return sum + c.size(); });
}

SubsetAnswer search_subsets(const SubsetProblem& problem, const SubsetLimits& limits,
                            const StopCondition& stop) {
  if (problem.clusters.size() > kMostSubsetClusters || problem.vertex_count() > kMostSubsetVertices)
    return {};
  return is_small_integer(problem) ? SubsetSearch<std::int32_t>(problem, limits, stop).run()
                                   : SubsetSearch<double>(problem, limits, stop).run();
}

}  // namespace swallowtail::gtsp::proof
