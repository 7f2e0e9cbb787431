#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "coverage/gtsp/search/climber.hpp"
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
      : problem_(problem), candidates_(candidates), costs_(costs), rng_(rng) {}

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
    const double mean_arc = static_cast<double>(best_.cost) / climber.tour().size();
    std::uint64_t kicks = 0;
    double temperature = 0.0;
    for (; kicks < schedule.kicks; ++kicks) {
      if (kicks % kKicksBetweenQuestions == 0) {
        const double done = progress(kicks);
        if (done >= 1.0) break;
        temperature = mean_arc * schedule.hot * std::pow(schedule.cold / schedule.hot, done);
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

  void kick(Climber<Costs>& climber) {
    const int m = climber.tour().size();
    const auto longest = static_cast<std::uint64_t>(std::min(kLongestStretch, (m - 2) / 3));
    const int first = static_cast<int>(rng_.below(static_cast<std::uint64_t>(m)));
    const int a = 1 + static_cast<int>(rng_.below(longest));
    const int b = 1 + static_cast<int>(rng_.below(longest));
    climber.kick(first, a, b);
  }

  bool accepts(Cost cost, Cost before, double temperature) {
    if (cost <= before) return true;
    return static_cast<double>(cost - before) < -temperature * std::log(1.0 - rng_.uniform());
  }

  const Problem& problem_;
  Candidates& candidates_;
  Costs costs_;
  Rng rng_;
  Best best_;
};

}  // namespace swallowtail::gtsp::search
