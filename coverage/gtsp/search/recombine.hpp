#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "coverage/gtsp/search/problem.hpp"

namespace swallowtail::gtsp::search {

/// Puts the best of two tours together: wherever a stretch of one tour visits the same clusters as a stretch
/// of the other, in whatever order (a common interval [UNO-YAGIURA]), the first takes over the other's way
/// through them if that makes it cheaper. Much the same as partition crossover [WHITLEY-HAINS-HOWE], with
/// vertices as well as orders handed on. Stretches of up to kLongest clusters. O(clusters × kLongest) a pass,
/// far less where tours are alike.
template <class Costs>
class Recombiner {
 public:
  Recombiner(const Problem& problem, Costs costs) : problem_(problem), costs_(costs) {}

  /// Improves `tour` by stretches of `other`; returns the change of its cost.
  Cost improve(std::vector<int>& tour, std::vector<int> other) {
    Cost change = 0;
    const std::size_t m = tour.size();
    for (Cost gain = -1; gain < 0;) {
      gain = 0;
      for (int half = 0; half < 2; ++half) {
        std::rotate(tour.begin(), tour.begin() + static_cast<std::ptrdiff_t>(m / 2), tour.end());
        line_up(tour, other);
        gain += pass(tour, other);
      }
      change += gain;
    }
    return change;
  }

  static constexpr std::size_t kLongest = 1000;

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// Rotates `other` to begin with the tour's first cluster, and sums up both.
  void line_up(const std::vector<int>& tour, std::vector<int>& other) {
    const int cluster = problem_.cluster_of(tour.front());
    const auto same = [&](int v) { return problem_.cluster_of(v) == cluster; };
    std::rotate(other.begin(), std::find_if(other.begin(), other.end(), same), other.end());
    position_.resize(other.size());
    for (std::size_t i = 0; i < other.size(); ++i) position_[at(problem_.cluster_of(other[i]))] = i;
    sum_up(other, forward_, false);
    sum_up(other, backward_, true);
    sum_up(tour, own_, false);
  }

  void sum_up(const std::vector<int>& tour, std::vector<Cost>& sums, bool against) const {
    sums.assign(tour.size(), 0);
    for (std::size_t i = 1; i < tour.size(); ++i)
      sums[i] = sums[i - 1] + (against ? costs_(tour[i], tour[i - 1]) : costs_(tour[i - 1], tour[i]));
  }

  Cost pass(std::vector<int>& tour, const std::vector<int>& other) {
    Cost change = 0;
    for (std::size_t first = 1; first + 1 < tour.size(); ++first) {
      std::size_t low = tour.size();
      std::size_t high = 0;
      for (std::size_t last = first; last + 1 < tour.size(); ++last) {
        const std::size_t p = position_[at(problem_.cluster_of(tour[last]))];
        low = std::min(low, p);
        high = std::max(high, p);
        if (high - low > kLongest || last - first > kLongest) break;
        if (high - low != last - first) continue;
        const Cost gain = take_over(tour, other, first, last, low, high);
        change += gain;
        if (gain < 0) break;
      }
    }
    return change;
  }

  Cost take_over(std::vector<int>& tour, const std::vector<int>& other, std::size_t first, std::size_t last,
                 std::size_t low, std::size_t high) {
    const int before = tour[first - 1];
    const int after = tour[last + 1];
    const Cost now = own_[last + 1] - own_[first - 1];
    const Cost along =
        costs_(before, other[low]) + forward_[high] - forward_[low] + costs_(other[high], after);
    const Cost against =
        costs_(before, other[high]) + backward_[high] - backward_[low] + costs_(other[low], after);
    if (std::min(along, against) >= now) return 0;
    const auto begin = other.begin() + static_cast<std::ptrdiff_t>(low);
    const auto end = other.begin() + static_cast<std::ptrdiff_t>(high) + 1;
    const auto to = tour.begin() + static_cast<std::ptrdiff_t>(first);
    if (along <= against) {
      std::copy(begin, end, to);
    } else {
      std::reverse_copy(begin, end, to);
    }
    sum_up(tour, own_, false);
    return std::min(along, against) - now;
  }

  const Problem& problem_;
  Costs costs_;
  std::vector<std::size_t> position_;  ///< in the other tour, by cluster
  std::vector<Cost> forward_;          ///< of the other tour, from its first vertex to each
  std::vector<Cost> backward_;         ///< and back
  std::vector<Cost> own_;              ///< of the tour
};

}  // namespace swallowtail::gtsp::search
