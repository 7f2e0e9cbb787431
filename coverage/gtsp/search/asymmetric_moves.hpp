#pragma once

#include <algorithm>

#include "coverage/gtsp/search/array_tour.hpp"
#include "coverage/gtsp/search/candidates.hpp"

namespace swallowtail::gtsp::search {

/// Moves of a tour whose arcs cost differently each way: two neighbouring stretches of any length change
/// places (the 3-opt move that turns nothing round, found by near clusters [KANELLAKIS-PAPADIMITRIOU]), short
/// stretches are turned round, single clusters are brought elsewhere with whichever of their vertices fits. A
/// cluster met by a new arc may change its vertex at once [KARAPETYAN-GUTIN-LS].
template <class Costs>
class AsymmetricMoves {
 public:
  AsymmetricMoves(const Problem& problem, Candidates& candidates, Costs costs)
      : problem_(problem), candidates_(candidates), costs_(costs) {}

  /// As SymmetricMoves::improve.
  template <class Wake>
  Cost improve(ArrayTour& tour, int cluster, Wake wake) {
    tour_ = &tour;
    best_ = {};
    const int p = tour.position(cluster);
    look_from(p);
    look_reinsert(p);
    if (best_.delta < 0) apply(best_, wake);
    return best_.delta;
  }

 private:
  enum class Kind { kNone, kSwap, kTurn, kReinsert };
  struct Move {
    Cost delta = 0;
    Kind kind = Kind::kNone;
    int from = 0;    ///< position of the vertex the move begins at
    int to = 0;      ///< position of the vertex its new arc leads to
    int end = 0;     ///< kSwap: last position of the stretch that begins at `to`
    int vertex = 0;  ///< at `to` (kReinsert: at `from`)
  };

  void offer(const Move& move) {
    if (move.delta < best_.delta) best_ = move;
  }

  /// Whether going on from a one comes to b no later than to c.
  static bool is_between(int a, int b, int c) { return a <= c ? (a <= b && b <= c) : (a <= b || b <= c); }

  void look_from(int p) {
    const int v = tour_->vertex(p);
    const int q = tour_->next(p);
    const Cost broken = costs_(v, tour_->vertex(q));
    for (const Near& near : candidates_.out_of(v)) {
      if (near.cost >= broken) break;
      const int j = tour_->position_of(near.vertex);
      if (j == q) continue;
      const int r = tour_->vertex(j);
      look_swaps(p, j, near.vertex, near.cost - broken);
      if (r == near.vertex) continue;
      const Cost as_is = costs_(v, r);
      if (as_is < broken) look_swaps(p, j, r, as_is - broken);
    }
  }

  /// v | s … u | w … x | y becomes v | w … x | s … u | y, for every promising x; and v | s … w | y becomes v
  /// | w … s | y.
  void look_swaps(int p, int j, int w, Cost gain) {
    const int s = tour_->vertex(tour_->next(p));
    const int ju = tour_->previous(j);
    const int u = tour_->vertex(ju);
    const int r = tour_->vertex(j);
    const int after = tour_->vertex(tour_->next(j));
    const Cost left = gain - costs_(u, r);
    const Cost changed = w == r ? 0 : costs_(w, after) - costs_(r, after);
    const auto look = [&](int end) {
      const int y = tour_->vertex(tour_->next(end));
      const Cost closed = end == j ? costs_(w, s) - costs_(r, after)
                                   : costs_(tour_->vertex(end), s) - costs_(tour_->vertex(end), y) + changed;
      offer({left + costs_(u, y) + closed, Kind::kSwap, p, j, end, w});
    };
    if (j != p) look(j);
    for (const Near& near : candidates_.out_of(u)) {
      if (near.cost + left >= 0) break;
      const int end = tour_->previous(tour_->position_of(near.vertex));
      if (end != j && end != p && is_between(j, end, p)) look(end);
    }
    for (const Near& near : candidates_.into(s)) {
      if (near.cost + left >= 0) break;
      const int end = tour_->position_of(near.vertex);
      if (end != j && end != p && is_between(j, end, p)) look(end);
    }
    look_turn(p, j, w, gain);
  }

  void look_turn(int p, int j, int w, Cost gain) {
    const int q = tour_->next(p);
    const int length = j >= q ? j - q : j - q + tour_->size();
    if (length > kMaxTurned || j == p) return;
    Cost delta = gain;
    int before = tour_->vertex(q);
    for (int k = q; k != j;) {
      k = tour_->next(k);
      const int here = tour_->vertex(k);
      delta += costs_(k == j ? w : here, before) - costs_(before, here);
      before = here;
    }
    const int y = tour_->vertex(tour_->next(j));
    offer({delta + costs_(tour_->vertex(q), y) - costs_(before, y), Kind::kTurn, p, j, j, w});
  }

  /// The cluster at p, with any of its vertices, behind or before a cluster near to the one it has now or,
  /// where an arc is missing, near to that vertex.
  void look_reinsert(int p) {
    const int v = tour_->vertex(p);
    const int c = problem_.cluster_of(v);
    const int o = tour_->vertex(tour_->previous(p));
    const int s = tour_->vertex(tour_->next(p));
    const Cost in = costs_(o, v);
    const Cost out = costs_(v, s);
    const Cost removed = costs_(o, s) - in - out;
    const Cost broken = std::max(in, out);
    if (broken < kMissingArc) {
      look_beside(p, v, broken, removed, problem_.first(c), problem_.last(c));
      return;
    }
    for (int u = problem_.first(c); u < problem_.last(c); ++u) look_beside(p, u, broken, removed, u, u + 1);
  }

  /// The cluster at p, with each vertex first … last − 1, behind or before the clusters near to v.
  void look_beside(int p, int v, Cost broken, Cost removed, int first, int last) {
    for (const Near& near : candidates_.out_of(v)) {
      if (near.cost >= broken) break;
      look_between(p, tour_->previous(tour_->position_of(near.vertex)), removed, first, last);
    }
    for (const Near& near : candidates_.into(v)) {
      if (near.cost >= broken) break;
      look_between(p, tour_->position_of(near.vertex), removed, first, last);
    }
  }

  void look_between(int p, int j, Cost removed, int first, int last) {
    if (j == p || j == tour_->previous(p)) return;
    const int r = tour_->vertex(j);
    const int y = tour_->vertex(tour_->next(j));
    const Cost base = removed - costs_(r, y);
    for (int u = first; u < last; ++u)
      offer({base + costs_(r, u) + costs_(u, y), Kind::kReinsert, p, j, j, u});
  }

  template <class Wake>
  void apply(const Move& move, Wake wake) {
    const int p = move.from;
    const int q = tour_->next(p);
    const int changed = move.kind == Kind::kReinsert ? p : move.to;
    if (tour_->vertex(changed) != move.vertex) tour_->set(changed, move.vertex);
    for (const int k : {p, q, tour_->previous(p), move.to, tour_->previous(move.to), tour_->next(move.to),
                        move.end, tour_->next(move.end)})
      wake(problem_.cluster_of(tour_->vertex(k)));
    switch (move.kind) {
      case Kind::kSwap:
        tour_->swap_stretches(q, tour_->previous(move.to), move.end);
        break;
      case Kind::kTurn:
        tour_->turn(q, move.to);
        break;
      case Kind::kReinsert:
        tour_->swap_stretches(p, p, move.to);
        break;
      case Kind::kNone:
        break;
    }
  }

  static constexpr int kMaxTurned = 30;

  const Problem& problem_;
  Candidates& candidates_;
  Costs costs_;
  ArrayTour* tour_ = nullptr;
  Move best_;
};

}  // namespace swallowtail::gtsp::search
