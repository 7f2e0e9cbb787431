#include "coverage/gtsp/detail/exact.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace swallowtail::gtsp::detail {
namespace {

using Mask = std::uint32_t;

constexpr double kMaxTableBytes = 256.0 * 1024 * 1024;
constexpr Mask kMasksBetweenStops = 64;

/// reach_[mask][v]: cheapest way from the root vertex through the clusters in mask, each once, that ends at
/// v.
class SubsetTable {
 public:
  SubsetTable(const Instance& instance, const Anchor& anchor, const Reduced& reduced)
      : reduced_(reduced), n_(at(reduced.size())) {
    root_ = reduced.anchor() >= 0 ? reduced.cluster_of(reduced.anchor()) : 0;
    for (int c = 0; c < reduced.cluster_count() && reduced.anchor() < 0; ++c) {
      if (reduced.cluster_size(c) < reduced.cluster_size(root_)) root_ = c;
    }
    for (int c = 0; c < reduced.cluster_count(); ++c) {
      if (c != root_) others_.push_back(c);
    }
    instance_ = &instance;
    anchor_ = &anchor;
  }

  double work() const {
    const double n = static_cast<double>(n_);
    return std::ldexp(n * n / 4.0, static_cast<int>(others_.size())) * reduced_.cluster_size(root_);
  }
  double bytes() const { return std::ldexp(8.0 * static_cast<double>(n_), static_cast<int>(others_.size())); }

  ExactAnswer solve(const StopCondition& stop) {
    load_costs();
    ExactAnswer answer{ExactAnswer::Kind::kNoTour, {}};
    double best = kNoArc;
    for (int start = reduced_.first(root_); start < reduced_.last(root_); ++start) {
      if (!fill(start, stop)) return {ExactAnswer::Kind::kStopped, {}};
      const auto [end, cost] = best_end(start);
      if (cost >= best) continue;
      best = cost;
      answer = {ExactAnswer::Kind::kSolved, trace(start, end)};
    }
    return answer;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  Mask full() const { return (Mask{1} << others_.size()) - 1; }
  double& reach(Mask mask, int v) { return reach_[mask * n_ + at(v)]; }
  double cost(int from, int to) const { return cost_into_[at(to) * n_ + at(from)]; }

  void load_costs() {
    cost_into_.assign(n_ * n_, kNoArc);
    for (int u = 0; u < reduced_.size(); ++u) {
      for_each_arc(*instance_, *anchor_, reduced_.original(u), [&](int original_to, double arc) {
        const int v = reduced_.reduced(original_to);
        if (v >= 0) cost_into_[at(v) * n_ + at(u)] = arc;
      });
    }
    reach_.resize(n_ << others_.size());
  }

  bool fill(int start, const StopCondition& stop) {
    std::fill(reach_.begin(), reach_.end(), kNoArc);
    for (std::size_t bit = 0; bit < others_.size(); ++bit) {
      for (int v = reduced_.first(others_[bit]); v < reduced_.last(others_[bit]); ++v)
        reach(Mask{1} << bit, v) = cost(start, v);
    }
    for (Mask mask = 1; mask <= full(); ++mask) {
      if (mask % kMasksBetweenStops == 0 && stop.reached(0, 0)) return false;
      if (!std::has_single_bit(mask)) fill_subset(mask);
    }
    return true;
  }

  void fill_subset(Mask mask) {
    for (Mask rest = mask; rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      const Mask before = mask & ~(Mask{1} << bit);
      for (int v = reduced_.first(others_[at(bit)]); v < reduced_.last(others_[at(bit)]); ++v)
        reach(mask, v) = cheapest_into(before, v);
    }
  }

  double cheapest_into(Mask before, int v) const {
    const double* const from = reach_.data() + before * n_;
    const double* const arc = cost_into_.data() + at(v) * n_;
    double best = kNoArc;
    for (Mask rest = before; rest != 0; rest &= rest - 1) {
      const int cluster = others_[at(std::countr_zero(rest))];
      for (int u = reduced_.first(cluster); u < reduced_.last(cluster); ++u)
        best = std::min(best, from[u] + arc[u]);
    }
    return best;
  }

  std::pair<int, double> best_end(int start) {
    std::pair<int, double> best{-1, kNoArc};
    for (const int cluster : others_) {
      for (int v = reduced_.first(cluster); v < reduced_.last(cluster); ++v) {
        const double sum = reach(full(), v) + cost(v, start);
        if (sum < best.second) best = {v, sum};
      }
    }
    return best;
  }

  int bit_of(int v) const {
    return static_cast<int>(std::find(others_.begin(), others_.end(), reduced_.cluster_of(v)) -
                            others_.begin());
  }

  /// Back from the end: each step finds the predecessor whose sum is the stored one.
  std::vector<int> trace(int start, int end) {
    std::vector<int> order;
    Mask mask = full();
    for (int v = end; v >= 0;) {
      order.push_back(v);
      const Mask before = mask & ~(Mask{1} << bit_of(v));
      int previous = -1;
      for (Mask rest = before; rest != 0 && previous < 0; rest &= rest - 1) {
        const int cluster = others_[at(std::countr_zero(rest))];
        for (int u = reduced_.first(cluster); u < reduced_.last(cluster) && previous < 0; ++u) {
          if (reach(before, u) + cost(u, v) == reach(mask, v)) previous = u;
        }
      }
      mask = before;
      v = previous;
    }
    order.push_back(start);
    std::reverse(order.begin(), order.end());
    return order;
  }

  const Reduced& reduced_;
  const Instance* instance_ = nullptr;
  const Anchor* anchor_ = nullptr;
  std::size_t n_;
  int root_ = 0;
  std::vector<int> others_;
  std::vector<double> cost_into_;  ///< by (to, from)
  std::vector<double> reach_;
};

}  // namespace

ExactAnswer solve_exactly(const Instance& instance, const Anchor& anchor, const Reduced& reduced,
                          double work_limit, const StopCondition& stop) {
  SubsetTable table(instance, anchor, reduced);
  const bool fits =
      reduced.cluster_count() <= 24 && table.work() <= work_limit && table.bytes() <= kMaxTableBytes;
  return fits ? table.solve(stop) : ExactAnswer{};
}

}  // namespace swallowtail::gtsp::detail
