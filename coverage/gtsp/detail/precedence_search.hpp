#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "coverage/gtsp/detail/incumbents.hpp"
#include "coverage/gtsp/solver.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp::detail {

/// Missing arcs first, then cost: how tours that are not yet tours compare.
struct Score {
  int missing = 0;
  double cost = 0.0;

  void add(double arc) {
    if (std::isinf(arc)) {
      ++missing;
    } else {
      cost += arc;
    }
  }
  void subtract(double arc) {
    if (std::isinf(arc)) {
      --missing;
    } else {
      cost -= arc;
    }
  }
  friend bool operator<(const Score& a, const Score& b) {
    return a.missing != b.missing ? a.missing < b.missing : a.cost < b.cost;
  }
};

/// Search for tours that keep Options::precedence: clusters are taken out and put back at the cheapest place
/// their predecessors and successors leave them, under simulated annealing; the best tours' vertices are then
/// chosen anew by dynamic programming [FISCHETTI-SALAZAR-TOTH]. Small instances are solved over all subsets
/// of clusters that hold their predecessors instead. One thread. Options must be valid.
class PrecedenceSearch {
 public:
  PrecedenceSearch(const Instance& instance, const Options& options);
  Solution solve();

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int cluster_count() const { return instance_.cluster_count(); }
  bool precedes(int a, int b) const { return precedes_[at(a) * at(cluster_count()) + at(b)] != 0; }
  void close_precedence();
  void begin();
  bool try_warm_tour();
  int last_place() const { return static_cast<int>(tour_.size()) - (end_ ? 1 : 0); }
  int neighbour(int place) const;
  Score insertion(int place, int v) const;
  void put_in(int cluster);
  void take_out(int count, std::vector<int>& removed);
  Score score_of(const std::vector<int>& tour) const;
  void choose_vertices();
  void offer(std::uint64_t iteration);
  void anneal();
  bool accepts(const Score& candidate, const Score& current, double temperature);

  bool solve_over_subsets();
  void judge();

  const Instance& instance_;
  const Options& options_;
  Incumbents incumbents_;
  Rng rng_;
  bool is_closed_;
  std::vector<int> lead_;
  std::optional<int> end_;
  std::vector<char> precedes_;  ///< closed under transitivity
  std::vector<int> free_;       ///< clusters that are neither in the lead nor the end
  std::vector<int> tour_;
  Found best_;
  Solution solution_;
};

}  // namespace swallowtail::gtsp::detail
