#include "coverage/gtsp/detail/bound.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "coverage/gtsp/detail/least_arcs.hpp"

namespace swallowtail::gtsp::detail {
namespace {

/// Successive shortest augmenting paths; rows and columns count from 1, column 0 is the row that looks for a
/// partner.
class Assignment {
 public:
  explicit Assignment(const LeastArcs& least_arcs)
      : least_arcs_(least_arcs),
        m_(least_arcs.cluster_count()),
        row_price_(size(), 0.0),
        column_price_(size(), 0.0),
        row_of_(size(), 0),
        via_(size(), 0) {}

  Bound solve() {
    for (int row = 1; row <= m_; ++row) {
      if (!augment(row)) return {kNoArc, 0.0, row - 1};
    }
    double sum = 0.0;
    for (int column = 1; column <= m_; ++column) sum += least_arcs_(row_of_[at(column)] - 1, column - 1);
    return {sum, 0.0, -1};
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::size_t size() const { return at(m_) + 1; }

  bool augment(int row) {
    std::vector<double> slack(size(), kNoArc);
    std::vector<char> is_done(size(), 0);
    row_of_[0] = row;
    int column = 0;
    do {
      is_done[at(column)] = 1;
      const int next = relax(column, slack, is_done);
      if (next < 0) return false;
      column = next;
    } while (row_of_[at(column)] != 0);
    for (; column != 0; column = via_[at(column)]) row_of_[at(column)] = row_of_[at(via_[at(column)])];
    return true;
  }

  /// The nearest column not done, after shifting the prices by its distance; −1 when none can be reached.
  int relax(int column, std::vector<double>& slack, const std::vector<char>& is_done) {
    const int row = row_of_[at(column)];
    double least = kNoArc;
    int nearest = -1;
    for (int j = 1; j <= m_; ++j) {
      if (is_done[at(j)] != 0) continue;
      const double reduced_cost = least_arcs_(row - 1, j - 1) - row_price_[at(row)] - column_price_[at(j)];
      if (reduced_cost < slack[at(j)]) {
        slack[at(j)] = reduced_cost;
        via_[at(j)] = column;
      }
      if (slack[at(j)] < least) {
        least = slack[at(j)];
        nearest = j;
      }
    }
    if (nearest < 0) return -1;
    for (int j = 0; j <= m_; ++j) {
      if (is_done[at(j)] != 0) {
        row_price_[at(row_of_[at(j)])] += least;
        column_price_[at(j)] -= least;
      } else {
        slack[at(j)] -= least;
      }
    }
    return nearest;
  }

  const LeastArcs& least_arcs_;
  int m_;
  std::vector<double> row_price_;
  std::vector<double> column_price_;
  std::vector<int> row_of_;
  std::vector<int> via_;
};

Bound assigned(const LeastArcs& least_arcs) {
  Bound bound = Assignment(least_arcs).solve();
  if (bound.starved_cluster >= 0) bound.starved_cluster = least_arcs.cluster(bound.starved_cluster);
  return bound;
}

Bound cheapest_arcs(const Instance& instance, const Anchor& anchor, const Pruning& pruning) {
  const int n = instance.vertex_count();
  const auto cluster_of = [&](int v) {
    return static_cast<std::size_t>(v == n ? instance.cluster_count() : instance.cluster_of(v));
  };
  const auto is_alive = [&](int v) { return pruning.is_alive[static_cast<std::size_t>(v)] != 0; };
  const auto clusters = static_cast<std::size_t>(instance.cluster_count()) + 1;
  std::vector<double> out(clusters, kNoArc);
  std::vector<double> in(clusters, kNoArc);
  std::vector<char> is_left(clusters, 0);
  for (int u = 0; u <= n; ++u) {
    if (!is_alive(u)) continue;
    is_left[cluster_of(u)] = 1;
    for_each_arc(instance, anchor, u, [&](int v, double cost) {
      if (!is_alive(v)) return;
      out[cluster_of(u)] = std::min(out[cluster_of(u)], cost);
      in[cluster_of(v)] = std::min(in[cluster_of(v)], cost);
    });
  }
  double out_sum = 0.0;
  double in_sum = 0.0;
  for (std::size_t c = 0; c < clusters; ++c) {
    if (is_left[c] == 0) continue;
    if (std::isinf(out[c]) || std::isinf(in[c])) return {kNoArc, 0.0, static_cast<int>(c)};
    out_sum += out[c];
    in_sum += in[c];
  }
  return {std::max(out_sum, in_sum), 0.0, -1};
}

}  // namespace

Bound lower_bound(const Instance& instance, const Anchor& anchor, const Pruning& pruning) {
  Bound bound = instance.cluster_count() <= kMaxAssignedClusters
                    ? assigned(LeastArcs(instance, anchor, pruning))
                    : cheapest_arcs(instance, anchor, pruning);
  const bool is_integer = std::isinf(bound.value) || bound.value == std::floor(bound.value);
  if (!is_integer) {
    bound.rounding = 2e-10 * bound.value;
    bound.value *= 1.0 - 1e-10;
  }
  return bound;
}

}  // namespace swallowtail::gtsp::detail
