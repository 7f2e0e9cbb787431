#pragma once

#include <deque>
#include <vector>

#include "coverage/gtsp/proof/ng_walks.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::gtsp::proof {

/// Raises a lower bound on closed tours: a price for visiting each cluster, moved by subgradients so that the
/// cheapest walk visits each once [HELD-KARP-2], and a memory that grows where walks repeat clusters
/// [ROBERTI-MINGOZZI]. With an upper bound, arcs that no better tour uses are dropped on the way. Anytime;
/// deterministic for its work.
class WalkAscent {
 public:
  /// Bounds tours that cost less than `upper_bound` (kNoArc: all). Lists the graph's arcs anew.
  WalkAscent(WalkGraph& graph, double upper_bound);
  /// The same on a copy of the graph.
  WalkAscent on(WalkGraph& copy) const;

  enum class End {
    kWork,     ///< used up
    kStopped,  ///< by the stop condition
    kNoWalk,   ///< there is no closed walk: no tour below the upper bound
    kTour,     ///< the cheapest walk is a tour: it is the best one
    kProved,   ///< no tour costs less than the upper bound
    kStalled,  ///< it would take a larger memory than is allowed
  };
  /// Goes on for `work` elementary steps.
  End climb(double work, const StopCondition& stop);

  /// No tour below the upper bound costs less; may be more than the upper bound.
  double bound() const { return bound_; }
  /// As it was for the best bound by whole walks, or by windows before there was one; by cluster of the
  /// graph.
  const std::vector<double>& price() const { return best_price_; }
  NgWalks& walks() { return walks_; }
  const std::vector<int>& tour() const { return tour_; }  ///< after kTour: vertices of the graph, root first
  double work() const { return work_; }

  /// Least cost of a tour that a bound of `value` leaves open: up to the next integer, if costs are.
  double rounded(double value) const;
  /// Drops arcs that no tour costing up to `cut` uses, judged by the least walks through them at the present
  /// prices. False when more than `limit` would be left.
  bool drop_arcs(double cut, std::size_t limit);

 private:
  WalkAscent(WalkGraph& copy, const WalkAscent& original);
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void set_first_prices();
  void list_leaps();
  void remember_nearest();
  /// By windows of the tour, much cheaper than whole walks, and potentials for what lies beyond them.
  End climb_by_windows(double work, const StopCondition& stop);
  double window_work(int arcs) const;
  double look_through_windows(int arcs, std::vector<double>& missing);
  bool widen_windows(int arcs, double work_left);
  bool note_walk(const NgWalks::Walk& walk);
  void note_value(double value);
  void move_prices(double value, const std::vector<double>& missing);
  void step_back();
  bool widen(double work_left);
  std::vector<std::vector<int>> widened(int longest, std::size_t most) const;
  double target() const;

  WalkGraph& graph_;
  NgWalks walks_;
  double upper_bound_;
  double bound_ = 0.0;
  double level_ = 0.0;  ///< best value of what climbs at present, windows or walks
  double work_ = 0.0;
  double step_ = 1.0;
  int stall_ = 0;
  std::vector<WalkGraph::Bundle> leaps_;  ///< seen since arcs were listed
  int walks_since_listing_ = 0;
  bool is_warm_ = false;
  std::vector<double> price_;
  std::vector<double> best_price_;
  std::vector<double> best_potential_;
  std::vector<double> direction_;
  std::deque<std::vector<int>> recent_;  ///< clusters of the last walks
  std::vector<int> tour_;
};

}  // namespace swallowtail::gtsp::proof
