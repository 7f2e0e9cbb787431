#include "coverage/gtsp/detail/bound.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

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

Bound cheapest_arcs(const LeastArcs& least_arcs) {
  const int m = least_arcs.cluster_count();
  double out_sum = 0.0;
  double in_sum = 0.0;
  for (int a = 0; a < m; ++a) {
    double out = kNoArc;
    double in = kNoArc;
    for (int b = 0; b < m; ++b) {
      out = std::min(out, least_arcs(a, b));
      in = std::min(in, least_arcs(b, a));
    }
    if (std::isinf(out) || std::isinf(in)) return {kNoArc, 0.0, a};
    out_sum += out;
    in_sum += in;
  }
  return {std::max(out_sum, in_sum), 0.0, -1};
}

}  // namespace

Bound lower_bound(const LeastArcs& least_arcs) {
  Bound bound = least_arcs.cluster_count() <= kMaxAssignedClusters ? Assignment(least_arcs).solve()
                                                                   : cheapest_arcs(least_arcs);
  const bool is_integer = std::isinf(bound.value) || bound.value == std::floor(bound.value);
  if (!is_integer) {
    bound.rounding = 2e-10 * bound.value;
    bound.value *= 1.0 - 1e-10;
  }
  return bound;
}

}  // namespace swallowtail::gtsp::detail
