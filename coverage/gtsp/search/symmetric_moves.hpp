#pragma once

#include <algorithm>
#include <utility>

#include "coverage/gtsp/search/array_tour.hpp"
#include "coverage/gtsp/search/candidates.hpp"

namespace swallowtail::gtsp::search {

/// Moves of a tour whose arcs cost the same both ways: 2-opt, stretches of up to three clusters brought
/// beside a near one in either sense (or-opt), and single clusters brought there with whichever of their
/// vertices fits. As in [KARAPETYAN-GUTIN-LS], a cluster met by a new arc may change its vertex at once. A
/// move must begin with a new arc that is shorter than one it breaks [LIN-KERNIGHAN], so that only near
/// clusters are looked at.
template <class Costs>
class SymmetricMoves {
 public:
  SymmetricMoves(const Problem& problem, Candidates& candidates, Costs costs)
      : problem_(problem), candidates_(candidates), costs_(costs) {}

  /// Makes the best move that begins at the cluster, if it makes the tour cheaper; returns the change of
  /// cost. Calls wake(cluster) for each cluster with a new arc or vertex.
  template <class Wake>
  Cost improve(ArrayTour& tour, int cluster, Wake wake) {
    tour_ = &tour;
    best_ = {};
    const int p = tour.position(cluster);
    look_from(p, 1);
    look_from(p, -1);
    look_reinsert(p);
    if (best_.delta < 0) apply(best_, wake);
    return best_.delta;
  }

 private:
  enum class Kind { kNone, kTwoOpt, kPull, kPush, kReinsert };
  struct Move {
    Cost delta = 0;
    Kind kind = Kind::kNone;
    int direction = 1;
    int from = 0;    ///< position of the vertex the move begins at
    int length = 1;  ///< of a pushed stretch
    int to = 0;      ///< position of the vertex it is brought to
    int other = 0;   ///< position of that one's neighbour on the broken arc
    int vertex = 0;  ///< at `to` (kReinsert: of the cluster moved)
  };

  int step(int p, int direction) const { return direction > 0 ? tour_->next(p) : tour_->previous(p); }

  void offer(const Move& move) {
    if (move.delta < best_.delta) best_ = move;
  }

  void look_from(int p, int direction) {
    const int v = tour_->vertex(p);
    const int q = step(p, direction);
    const int s = tour_->vertex(q);
    const Cost broken = costs_(v, s);
    for (const Near& near : candidates_.out_of(v)) {
      if (near.cost >= broken) break;
      const int j = tour_->position_of(near.vertex);
      if (j == q) continue;
      const int r = tour_->vertex(j);
      if (r == near.vertex) {
        look_pair(p, direction, broken, j, r, near.cost);
      } else {
        const Cost as_is = costs_(v, r);
        if (as_is < broken) look_pair(p, direction, broken, j, r, as_is);
        look_pair(p, direction, broken, j, near.vertex, near.cost);
      }
    }
  }

  /// Moves that break the arc from p on in `direction` and join p to `w`, of the cluster at j.
  void look_pair(int p, int direction, Cost broken, int j, int w, Cost joined) {
    const int v = tour_->vertex(p);
    const int s = tour_->vertex(step(p, direction));
    const int jy = step(j, direction);
    const int jz = step(j, -direction);
    const int r = tour_->vertex(j);
    const int y = tour_->vertex(jy);
    const int z = tour_->vertex(jz);
    const Cost ry = costs_(r, y);
    const Cost rz = costs_(r, z);
    const bool is_other = w != r;
    const Cost wz = is_other ? costs_(w, z) - rz : 0;
    const Cost wy = is_other ? costs_(w, y) - ry : 0;
    const Cost gain = joined - broken;
    if (y != v) offer({gain + costs_(s, y) - ry + wz, Kind::kTwoOpt, direction, p, 1, j, jy, w});
    offer({gain + costs_(w, s) + costs_(z, y) - rz - ry, Kind::kPull, direction, p, 1, j, jy, w});
    int pe = p;
    for (int length = 1; length <= kMaxPushed; ++length, pe = step(pe, -direction)) {
      if (pe == j) break;
      const int px = step(pe, -direction);
      if (px == j && is_other) break;
      const int e = tour_->vertex(pe);
      const int x = tour_->vertex(px);
      const Cost base = gain + costs_(s, x) - costs_(e, x);
      if (y != e && y != v)
        offer({base + costs_(e, y) - ry + wz, Kind::kPush, direction, p, length, j, jy, w});
      if (z != e && z != v)
        offer({base + costs_(e, z) - rz + wy, Kind::kPush, direction, p, length, j, jz, w});
      if (px == j) break;
    }
  }

  /// The cluster at p, with any of its vertices, beside a cluster near to the one it has now or, where
  /// an arc is missing, near to that vertex.
  void look_reinsert(int p) {
    const int v = tour_->vertex(p);
    const int c = problem_.cluster_of(v);
    const Cost in = costs_(tour_->vertex(tour_->previous(p)), v);
    const Cost out = costs_(v, tour_->vertex(tour_->next(p)));
    const Cost between = costs_(tour_->vertex(tour_->previous(p)), tour_->vertex(tour_->next(p)));
    const Cost broken = std::max(in, out);
    if (broken < kMissingArc) {
      look_beside(p, v, broken, between - in - out, problem_.first(c), problem_.last(c));
      return;
    }
    for (int u = problem_.first(c); u < problem_.last(c); ++u)
      look_beside(p, u, broken, between - in - out, u, u + 1);
  }

  /// The cluster at p, with each vertex first … last − 1, beside the clusters near to v.
  void look_beside(int p, int v, Cost broken, Cost removed, int first, int last) {
    const int before = tour_->previous(p);
    const int after = tour_->next(p);
    for (const Near& near : candidates_.out_of(v)) {
      if (near.cost >= broken) break;
      const int j = tour_->position_of(near.vertex);
      const int r = tour_->vertex(j);
      for (const int k : {tour_->next(j), tour_->previous(j)}) {
        if (k == p || (j == before && k == after) || (j == after && k == before)) continue;
        const int y = tour_->vertex(k);
        const Cost base = removed - costs_(r, y);
        for (int u = first; u < last; ++u)
          offer({base + costs_(r, u) + costs_(u, y), Kind::kReinsert, 1, p, 1, j, k, u});
      }
    }
  }

  void change_vertex(int p, int v) {
    if (tour_->vertex(p) != v) tour_->set(p, v);
  }

  template <class Wake>
  void apply(const Move& move, Wake wake) {
    const int d = move.direction;
    const int p = move.from;
    if (move.kind == Kind::kReinsert) {
      change_vertex(p, move.vertex);
    } else {
      change_vertex(move.to, move.vertex);
    }
    const int v = tour_->vertex(p);
    const int r = tour_->vertex(move.to);
    const int s = tour_->vertex(step(p, d));
    const int y = tour_->vertex(step(move.to, d));
    const int z = tour_->vertex(step(move.to, -d));
    const int o = tour_->vertex(step(p, -d));
    for (const int w : {v, r, s, y, z, o}) wake(problem_.cluster_of(w));
    switch (move.kind) {
      case Kind::kTwoOpt:
        exchange(v, s, r);
        break;
      case Kind::kPull:
        if (z == s) {
          exchange(v, s, r);
        } else if (y == v) {
          exchange(z, r, v);
        } else {
          move_stretch(z, r, r, y, v, s);
        }
        break;
      case Kind::kPush:
        push(move, wake);
        break;
      case Kind::kReinsert: {
        const int other = tour_->vertex(move.other);
        move_stretch(o, v, v, s, r, other);
        break;
      }
      case Kind::kNone:
        break;
    }
  }

  template <class Wake>
  void push(const Move& move, Wake wake) {
    const int d = move.direction;
    int pe = move.from;
    for (int i = 1; i < move.length; ++i) pe = step(pe, -d);
    const int e = tour_->vertex(pe);
    const int x = tour_->vertex(step(pe, -d));
    wake(problem_.cluster_of(e));
    wake(problem_.cluster_of(x));
    move_stretch(tour_->vertex(step(move.from, d)), tour_->vertex(move.from), e, x, tour_->vertex(move.to),
                 tour_->vertex(move.other));
  }

  /// The neighbours a–b and c with its neighbour in the same sense, d, are joined anew: a–c and b–d.
  void exchange(int a, int b, int c) {
    const int pa = tour_->position_of(a);
    const int pb = tour_->position_of(b);
    const int pc = tour_->position_of(c);
    if (tour_->next(pa) == pb) {
      tour_->turn_shorter(pb, pc);
    } else {
      tour_->turn_shorter(pc, pb);
    }
  }

  /// The stretch f … e, between o and x, goes between the neighbours a and b: a to f, e to b.
  void move_stretch(int o, int f, int e, int x, int a, int b) {
    if (tour_->next(tour_->position_of(o)) != tour_->position_of(f)) {
      std::swap(o, x);
      std::swap(f, e);
      std::swap(a, b);
    }
    if (tour_->next(tour_->position_of(b)) == tour_->position_of(a)) {
      exchange(o, f, b);
      exchange(o, b, x);
    } else {
      exchange(o, f, a);
      exchange(o, a, x);
      exchange(a, e, f);
    }
  }

  static constexpr int kMaxPushed = 3;

  const Problem& problem_;
  Candidates& candidates_;
  Costs costs_;
  ArrayTour* tour_ = nullptr;
  Move best_;
};

}  // namespace swallowtail::gtsp::search
