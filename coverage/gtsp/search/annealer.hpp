#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "coverage/gtsp/search/gap_kicks.hpp"
#include "planner/base/rng.hpp"

namespace swallowtail::gtsp::search {

/// How one stretch of annealing goes.
struct Schedule {
  std::uint64_t kicks = 0;
  double hot = 0.0;   ///< first temperature, of the tour's mean arc
  double cold = 0.0;  ///< last temperature, likewise
};

/// Iterated local search on one tour [MARTIN-OTTO-FELTEN]: a local kick, local search around it, and the new
/// tour is kept if it is better or, as in annealing, not too much worse; else all is taken back.
/// Deterministic for its Rng as long as what `progress` answers depends on kicks alone.
template <class Costs>
class Annealer {
 public:
  Annealer(const Problem& problem, Candidates& candidates, Costs costs, Rng rng)
      : problem_(problem),
        candidates_(candidates),
        costs_(costs),
        rng_(rng),
        gap_kicks_(problem, candidates, costs) {}

  /// Lowers `tour` in place. progress(kicks so far), asked now and then: how much of the run is over, 0 … 1;
  /// at 1 it ends. report(tour, cost, kicks) is called with tours better than all before, and at the end.
  /// Returns the kicks.
  template <class Progress, class Report>
  std::uint64_t run(std::vector<int>& tour, const Schedule& schedule, Progress progress, Report report) {
    Climber<Costs> climber(problem_, candidates_, costs_, std::move(tour));
    climber.wake_all();
    climber.climb([&] { return progress(0) >= 1.0; });
    climber.tour().forget_changes();
    best_ = {climber.tour().vertices(), climber.cost(), false, false};
    report(best_.tour, best_.cost, std::uint64_t{0});
    mean_arc_ = static_cast<double>(without_missing(best_.cost)) / climber.tour().size();
    std::uint64_t kicks = 0;
    double temperature = 0.0;
    for (; kicks < schedule.kicks; ++kicks) {
      if (kicks % kKicksBetweenQuestions == 0) {
        const double done = progress(kicks);
        if (done >= 1.0) break;
        temperature = mean_arc_ * schedule.hot * std::pow(schedule.cold / schedule.hot, done);
      }
      if (kicks % kKicksBetweenReports == 0 && best_.is_news) {
        if (best_.is_current) keep(climber.tour());
        best_.is_news = false;
        report(best_.tour, best_.cost, kicks);
      }
      step(climber, temperature);
    }
    if (best_.is_current) keep(climber.tour());
    report(best_.tour, best_.cost, kicks);
    tour = std::move(best_.tour);
    return kicks;
  }

 private:
  static constexpr std::uint64_t kKicksBetweenQuestions = 64;
  static constexpr std::uint64_t kKicksBetweenReports = 1024;
  static constexpr int kLongestStretch = 50;
  static constexpr int kLongestSwap = 1000;
  static constexpr int kWalk = 3;
  /// What a missing arc costs a whole tour that would lose it, in mean arcs.
  static constexpr double kMissingCost = 3.0;

  struct Best {
    std::vector<int> tour;  ///< not yet written down while it is the current one
    Cost cost = 0;
    bool is_current = false;
    bool is_news = false;  ///< not yet reported
  };

  void keep(const ArrayTour& tour) {
    best_.tour = tour.vertices();
    best_.is_current = false;
  }

  void step(Climber<Costs>& climber, double temperature) {
    const Cost before = climber.cost();
    kick(climber);
    climber.climb();
    if (!accepts(climber.cost(), before, temperature)) {
      climber.take_back(before);
      return;
    }
    if (climber.cost() < best_.cost) {
      best_.cost = climber.cost();
      best_.is_current = true;
      best_.is_news = true;
    } else if (best_.is_current && climber.cost() > best_.cost) {
      ArrayTour left = climber.tour();
      left.take_back();
      keep(left);
    }
    climber.tour().forget_changes();
  }

  /// Half of the kicks cut the tour at places a few steps along it apart, the others at three that are near
  /// in cost: the former reach far, the latter let parts of the tour that pass each other exchange clusters.
  void kick(Climber<Costs>& climber) {
    if (climber.cost() >= kMissingArc && gap_kicks_.kick(climber, rng_)) return;
    if (!problem_.is_symmetric()) {
      kick_twice(climber);
      return;
    }
    if (rng_.below(2) == 0 && kick_near(climber)) return;
    const int first = place(climber.tour());
    const int middle = first + stretch(climber.tour(), 3);
    const int last = middle + 1 + stretch(climber.tour(), 3);
    const int m = climber.tour().size();
    climber.swap(first, middle % m, last % m);
  }

  int place(const ArrayTour& tour) {
    return static_cast<int>(rng_.below(static_cast<std::uint64_t>(tour.size())));
  }
  int stretch(const ArrayTour& tour, int stretches) {
    const int longest = std::min(kLongestStretch, (tour.size() - 2) / stretches);
    return static_cast<int>(rng_.below(static_cast<std::uint64_t>(longest)));
  }

  /// Three stretches in reverse order, each in its sense: the double bridge [MARTIN-OTTO-FELTEN], which the
  /// swaps of two stretches that the local search tries do not take back.
  void kick_twice(Climber<Costs>& climber) {
    const ArrayTour& tour = climber.tour();
    const int m = tour.size();
    const int first = place(tour);
    const int second = first + 1 + stretch(tour, 4);
    const int third = second + 1 + stretch(tour, 4);
    const int last = third + stretch(tour, 4);
    const int begin = tour.vertex(second % m);
    const int middle = tour.vertex((third - 1) % m);
    const int end = tour.vertex(last % m);
    climber.swap(first, (second - 1) % m, last % m);
    climber.swap(tour.position_of(begin), tour.position_of(middle), tour.position_of(end));
  }

  /// Three places by random walks over near clusters [APPLEGATE-COOK-ROHE]. False when they do not differ or
  /// lie so far apart that the swap would take long.
  bool kick_near(Climber<Costs>& climber) {
    const ArrayTour& tour = climber.tour();
    std::array<int, 3> cut{};
    cut[0] = static_cast<int>(rng_.below(static_cast<std::uint64_t>(tour.size())));
    for (std::size_t i = 1; i < cut.size(); ++i) {
      int v = tour.vertex(cut[0]);
      for (int step = 0; step < kWalk; ++step) {
        const auto near = candidates_.out_of(v);
        v = tour.vertex(tour.position_of(near[static_cast<std::size_t>(rng_.below(near.size()))].vertex));
      }
      cut[i] = tour.position_of(v);
    }
    std::sort(cut.begin(), cut.end());
    if (cut[0] == cut[1] || cut[1] == cut[2] || cut[2] - cut[0] > kLongestSwap) return false;
    climber.swap(cut[0] + 1, cut[1], cut[2]);
    return true;
  }

  /// As long as arcs are missing, the others' cost does not matter.
  bool accepts(Cost cost, Cost before, double temperature) {
    if (cost <= before) return true;
    const int missing = missing_in(cost) - missing_in(before);
    if (before >= kMissingArc) return missing <= 0;
    const double worse =
        static_cast<double>(without_missing(cost) - before) + missing * kMissingCost * mean_arc_;
    return worse < -temperature * std::log(1.0 - rng_.uniform());
  }

  const Problem& problem_;
  Candidates& candidates_;
  Costs costs_;
  Rng rng_;
  GapKicks<Costs> gap_kicks_;
  Best best_;
  double mean_arc_ = 0.0;
};

}  // namespace swallowtail::gtsp::search
