#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "coverage/gtsp/search/climber.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp::search {

/// Kicks of a tour that lacks arcs, where one is missing (the gap): clusters around it are brought elsewhere,
/// or an arc that is there is put in and the gap moves on, as in the rotations of [POSA].
template <class Costs>
class GapKicks {
 public:
  GapKicks(const Problem& problem, Candidates& candidates, Costs costs)
      : problem_(problem), candidates_(candidates), costs_(costs) {}

  /// False when this kick came to nothing.
  bool kick(Climber<Costs>& climber, Rng& rng) {
    const int gap = gap_of(climber.tour(), rng);
    switch (rng.below(8)) {
      case 0:
        return false;
      case 1:
        bring_away(climber, rng, gap);
        return true;
      default:
        return rng.below(2) == 0 ? lead_out(climber, rng, gap) : lead_in(climber, rng, gap);
    }
  }

 private:
  static constexpr int kMostBrought = 6;
  static constexpr int kLongestStretch = 50;

  /// Position before a missing arc, the first after some place.
  int gap_of(const ArrayTour& tour, Rng& rng) const {
    int p = static_cast<int>(rng.below(static_cast<std::uint64_t>(tour.size())));
    for (int i = 0; i < tour.size() && costs_(tour.vertex(p), tour.vertex(tour.next(p))) < kMissingArc; ++i)
      p = tour.next(p);
    return p;
  }

  /// Each in turn of the clusters of a short stretch across the gap.
  void bring_away(Climber<Costs>& climber, Rng& rng, int gap) {
    const ArrayTour& tour = climber.tour();
    const auto count = static_cast<std::size_t>(1 + rng.below(kMostBrought));
    std::array<int, kMostBrought> clusters{};
    int p = gap;
    for (auto back = rng.below(count); back > 0; --back) p = tour.previous(p);
    for (std::size_t i = 0; i < count; ++i, p = tour.next(p))
      clusters[i] = problem_.cluster_of(tour.vertex(p));
    for (std::size_t i = count; i > 1; --i)
      std::swap(clusters[i - 1], clusters[static_cast<std::size_t>(rng.below(i))]);
    for (std::size_t i = 0; i < count; ++i) climber.move_away(tour.position(clusters[i]));
  }

  static const Near& drawn(std::span<const Near> near, Rng& rng) {
    return near[static_cast<std::size_t>(rng.below(near.size()))];
  }

  static int steps(const ArrayTour& tour, int from, int to) {
    return to >= from ? to - from : to - from + tour.size();
  }

  /// v | s … u | w … x | y, with the gap behind v, becomes v | w … x | s … u | y, or with a turn v | w … s |
  /// y: an arc from v to w.
  bool lead_out(Climber<Costs>& climber, Rng& rng, int gap) {
    const ArrayTour& tour = climber.tour();
    const int begin = tour.next(gap);
    const Near& near = drawn(candidates_.out_of(tour.vertex(gap)), rng);
    const int p = tour.position_of(near.vertex);
    if (near.cost >= kMissingArc || p == begin) return false;
    climber.set(p, near.vertex);
    if (problem_.is_symmetric()) {
      climber.turn(begin, p);
      return true;
    }
    const int most = std::min(kLongestStretch, steps(tour, p, gap));
    if (most < 1) return false;
    const int x = (p + static_cast<int>(rng.below(static_cast<std::uint64_t>(most)))) % tour.size();
    climber.swap(begin, tour.previous(p), x);
    return true;
  }

  /// The same with an arc from x to s.
  bool lead_in(Climber<Costs>& climber, Rng& rng, int gap) {
    const ArrayTour& tour = climber.tour();
    const int begin = tour.next(gap);
    const Near& near = drawn(candidates_.into(tour.vertex(begin)), rng);
    const int p = tour.position_of(near.vertex);
    if (near.cost >= kMissingArc || p == gap) return false;
    climber.set(p, near.vertex);
    if (problem_.is_symmetric()) {
      climber.turn(p, gap);
      return true;
    }
    const int most = std::min(kLongestStretch, steps(tour, begin, p));
    if (most < 1) return false;
    const int back = static_cast<int>(rng.below(static_cast<std::uint64_t>(most)));
    const int w = (p - back + tour.size()) % tour.size();
    climber.swap(begin, tour.previous(w), p);
    return true;
  }

  const Problem& problem_;
  Candidates& candidates_;
  Costs costs_;
};

}  // namespace swallowtail::gtsp::search
