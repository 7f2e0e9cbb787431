#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "coverage/gtsp/search/array_tour.hpp"
#include "coverage/gtsp/search/asymmetric_moves.hpp"
#include "coverage/gtsp/search/candidates.hpp"
#include "coverage/gtsp/search/symmetric_moves.hpp"
#include "coverage/gtsp/search/vertex_choice.hpp"
#include "coverage/gtsp/search/work_queue.hpp"

namespace swallowtail::gtsp::search {

/// A tour and the local search on it: the vertices around all changes are chosen anew (dynamic programming on
/// windows), then clusters that were changed or met by a change are looked at until no move of theirs helps,
/// and so on until neither helps. Vertices come first because those from before a kick speak for the order
/// before it: moves alone would take most kicks back. Work is in proportion to what was changed, not to the
/// tour.
template <class Costs>
class Climber {
 public:
  Climber(const Problem& problem, Candidates& candidates, Costs costs, std::vector<int> tour)
      : problem_(problem),
        candidates_(candidates),
        costs_(costs),
        tour_(std::move(tour), problem.cluster_of()),
        symmetric_(problem, candidates, costs),
        asymmetric_(problem, candidates, costs),
        choice_(problem, costs),
        queue_(problem.cluster_count()),
        is_touched_(at(problem.cluster_count()), 0) {
    for (int p = 0; p < tour_.size(); ++p) cost_ += costs_(tour_.vertex(p), tour_.vertex(tour_.next(p)));
  }

  ArrayTour& tour() { return tour_; }
  Cost cost() const { return cost_; }

  void wake(int c) {
    queue_.push(c);
    if (is_touched_[at(c)] == 0) {
      is_touched_[at(c)] = 1;
      touched_.push_back(c);
    }
  }

  void wake_all() {
    for (int c = 0; c < problem_.cluster_count(); ++c) wake(c);
  }

  /// The stretches first … middle and middle+1 … last (cyclic) change places.
  void swap(int first, int middle, int last) {
    const int o = tour_.vertex(tour_.previous(first));
    const int a = tour_.vertex(first);
    const int b = tour_.vertex(middle);
    const int c = tour_.vertex(tour_.next(middle));
    const int d = tour_.vertex(last);
    const int e = tour_.vertex(tour_.next(last));
    cost_ += costs_(o, c) + costs_(d, a) + costs_(b, e) - costs_(o, a) - costs_(b, c) - costs_(d, e);
    tour_.swap_stretches(first, middle, last);
    for (const int v : {o, a, b, c, d, e}) wake(problem_.cluster_of(v));
  }

  /// first … last turned round, where costs are the same each way.
  void turn(int first, int last) {
    const int o = tour_.vertex(tour_.previous(first));
    const int a = tour_.vertex(first);
    const int d = tour_.vertex(last);
    const int e = tour_.vertex(tour_.next(last));
    cost_ += costs_(o, d) + costs_(a, e) - costs_(o, a) - costs_(d, e);
    tour_.turn_shorter(first, last);
    for (const int v : {o, a, d, e}) wake(problem_.cluster_of(v));
  }

  /// Another vertex of the cluster at p.
  void set(int p, int v) {
    const int o = tour_.vertex(tour_.previous(p));
    const int w = tour_.vertex(p);
    const int s = tour_.vertex(tour_.next(p));
    if (v == w) return;
    cost_ += costs_(o, v) + costs_(v, s) - costs_(o, w) - costs_(w, s);
    tour_.set(p, v);
    for (const int u : {o, v, s}) wake(problem_.cluster_of(u));
  }

  /// The cluster at p goes, with whichever of its vertices, beside the near cluster where that adds least, if
  /// there is one; not to where it is.
  void move_away(int p) {
    const int c = problem_.cluster_of(tour_.vertex(p));
    const int before = tour_.previous(p);
    Cost least = std::numeric_limits<Cost>::max();
    int place = -1;
    int vertex = -1;
    const auto look = [&](int j, int v) {
      if (j == p || j == before) return;
      const int a = tour_.vertex(j);
      const int b = tour_.vertex(tour_.next(j));
      const Cost added = costs_(a, v) + costs_(v, b) - costs_(a, b);
      if (added >= least) return;
      least = added;
      place = j;
      vertex = v;
    };
    for (int v = problem_.first(c); v < problem_.last(c); ++v) {
      for (const Near& near : candidates_.out_of(v)) look(tour_.previous(tour_.position_of(near.vertex)), v);
      for (const Near& near : candidates_.into(v)) look(tour_.position_of(near.vertex), v);
    }
    if (place < 0) return;
    set(p, vertex);
    swap(p, p, place);
  }

  /// Until nothing helps or interrupted(), asked now and then, says so; what was to be looked at is then
  /// forgotten.
  template <class Interrupted>
  void climb(Interrupted interrupted) {
    const auto wake_cluster = [this](int c) { wake(c); };
    choose_around_touched();
    for (int looks = 1; !queue_.empty() || !touched_.empty(); ++looks) {
      if (queue_.empty()) choose_around_touched();
      if (queue_.empty()) continue;
      if (tour_.size() < kLeastMoved) {
        queue_.pop();
        continue;
      }
      const int c = queue_.pop();
      const Cost change = problem_.is_symmetric() ? symmetric_.improve(tour_, c, wake_cluster)
                                                  : asymmetric_.improve(tour_, c, wake_cluster);
      cost_ += change;
      if (looks % kLooksBetweenQuestions == 0 && interrupted()) forget();
    }
  }
  void climb() {
    climb([] { return false; });
  }

  /// Takes back all since the tour's changes were last forgotten; `before` is what the tour cost then.
  void take_back(Cost before) {
    tour_.take_back();
    cost_ = before;
  }

 private:
  static constexpr int kLooksBetweenQuestions = 1024;
  /// Clusters to each side of a change whose vertices are chosen anew.
  static constexpr int kWindow = 3;
  /// In shorter tours moves would meet themselves.
  static constexpr int kLeastMoved = 5;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  void forget() {
    while (!queue_.empty()) queue_.pop();
    for (const int c : touched_) is_touched_[at(c)] = 0;
    touched_.clear();
  }

  /// Best vertices for the stretches around what changed.
  void choose_around_touched() {
    const int m = tour_.size();
    spans_.clear();
    for (const int c : touched_) {
      is_touched_[at(c)] = 0;
      spans_.push_back(tour_.position(c));
    }
    touched_.clear();
    std::sort(spans_.begin(), spans_.end());
    for (std::size_t i = 0; i < spans_.size();) {
      const int first = spans_[i] - kWindow;
      int last = spans_[i] + kWindow;
      for (++i; i < spans_.size() && spans_[i] - kWindow <= last; ++i) last = spans_[i] + kWindow;
      choose(first, std::min(last - first + 1, m - 1));
    }
  }

  void choose(int first, int length) {
    while (first < 0) first += tour_.size();
    cost_ += choice_.improve(tour_, first, length, [&](int p, int v) {
      tour_.set(p, v);
      wake(problem_.cluster_of(v));
      wake(problem_.cluster_of(tour_.vertex(tour_.next(p))));
      wake(problem_.cluster_of(tour_.vertex(tour_.previous(p))));
    });
  }

  const Problem& problem_;
  Candidates& candidates_;
  Costs costs_;
  ArrayTour tour_;
  SymmetricMoves<Costs> symmetric_;
  AsymmetricMoves<Costs> asymmetric_;
  VertexChoice<Costs> choice_;
  WorkQueue queue_;
  std::vector<char> is_touched_;
  std::vector<int> touched_;
  std::vector<int> spans_;
  Cost cost_ = 0;
};

}  // namespace swallowtail::gtsp::search
