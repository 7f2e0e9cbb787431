#include "coverage/gtsp/search/chains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

#include "coverage/gtsp/search/annealer.hpp"
#include "coverage/gtsp/search/recombine.hpp"
#include "coverage/gtsp/search/warm_tour.hpp"

namespace swallowtail::gtsp::search {
namespace {

constexpr int kNear = 10;
constexpr double kHot = 0.8;
constexpr double kCold = 0.05;
constexpr double kWarmHot = 0.02;
/// Up to so many clusters the second chain begins each round anew.
constexpr int kMostRestarted = 400;
/// Up to so many clusters a tour over few arcs is put together; that takes clusters × vertices steps.
constexpr int kMostPutTogether = 4'000;
/// Tours kept to be recombined with.
constexpr std::size_t kPool = 8;
/// Kicks of each chain in the first round and in the longest, per cluster.
constexpr std::uint64_t kFirstKicks = 6;
constexpr std::uint64_t kMostKicks = 400;
/// Fewer clusters than these are annealed in a moment, and it is better to begin anew than to go on: all
/// rounds are this long then.
constexpr int kFewClusters = 60;
constexpr std::uint64_t kShortKicks = 25;
/// From so many clusters on a short round undoes more than it mends: all rounds are long.
constexpr int kManyClusters = 2'000;

struct Chain {
  std::vector<int> tour;
  Cost cost = std::numeric_limits<Cost>::max();
  std::uint64_t kicks = 0;
  std::uint64_t share = 0;  ///< of this round's kicks
  bool is_new = false;      ///< this round it began from nothing
  double end_s = 0.0;       ///< of its share of the time, with a deadline
};

class Rounds {
 public:
  Rounds(const Problem& problem, const ChainSetup& setup, const ChainReport& report)
      : problem_(problem), setup_(setup), report_(report), rng_(setup.seed) {
    if (!problem.points().empty()) tree_ = std::make_unique<PointTree>(problem);
    for (int i = 0; i < kChains; ++i) candidates_.emplace_back(problem, tree_.get(), kNear);
  }

  std::uint64_t run() {
    std::uint64_t left = setup_.kicks;
    const auto m = static_cast<std::uint64_t>(problem_.cluster_count());
    const bool is_small = problem_.cluster_count() < kFewClusters;
    std::uint64_t most = kicks_of_first_round() * m;
    for (int round = 0; round == 0 || (left > 0 && !setup_.stop.reached(0, 0)); ++round) {
      prepare(round, left, most);
      run_round(round);
      count_hits();
      recombine();
      if (hits_ >= setup_.enough_hits) break;
      if (!is_small && hits_ == 0) most = std::min(2 * most, kMostKicks * m);
      for (const Chain& chain : chains_) left -= chain.share;
    }
    std::uint64_t kicks = 0;
    for (const Chain& chain : chains_) kicks += chain.kicks;
    return kicks;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  /// Per cluster.
  std::uint64_t kicks_of_first_round() const {
    if (!is_kicked()) return 1;
    if (problem_.cluster_count() < kFewClusters) return kShortKicks;
    return problem_.cluster_count() < kManyClusters ? kFirstKicks : kMostKicks;
  }

  /// A few clusters leave a kick no room: they are begun anew from other orders instead.
  bool is_kicked() const { return problem_.cluster_count() >= kLeastKicked; }

  /// The first chain goes on from the best tour as long as that gets better, the other from its own; where
  /// tours are short both begin anew instead.
  void prepare(int round, std::uint64_t left, std::uint64_t most) {
    const bool is_cold = setup_.start.empty();
    const bool is_complete = best_cost_ < kMissingArc;
    const bool is_restarted =
        is_cold && (is_complete ? problem_.cluster_count() <= kMostRestarted : !is_kicked());
    // Where costs differ each way, the best tour's sense is the one thing that local moves cannot change.
    const bool is_turned = round % 2 == 1 && is_cold && !problem_.is_symmetric();
    for (int i = 0; i < kChains; ++i) {
      Chain& chain = chains_[at(i)];
      chain.share = std::min(most, i == 0 ? left - left / 2 : left / 2);
      if (!is_cold && round == 0 && i > 0) chain.share = 0;  // the first has then all of a short deadline
      if (round == 0) {
        chain.is_new = is_cold;
      } else {
        chain.is_new = is_restarted && (i > 0 ? !is_turned : !is_better_);
        if (i == 0) chain.tour = best_;
        if (i > 0 && is_turned) chain.tour.assign(best_.rbegin(), best_.rend());
      }
      if (chain.is_new) {
        chain.tour = new_tour(chain_rng(round, i).split(1));
      } else if (round == 0) {
        chain.tour = setup_.start;
      }
    }
  }

  /// Of the chains that began from nothing, those that ended at the best cost of all. That several did is the
  /// best sign there is that none is better.
  void count_hits() {
    const Cost least = std::min(chains_[0].cost, chains_[1].cost);
    is_better_ = least < best_cost_;
    if (is_better_) hits_ = 0;
    best_cost_ = std::min(best_cost_, least);
    if (is_better_) best_ = chains_[chains_[1].cost < chains_[0].cost ? 1 : 0].tour;
    if (best_cost_ >= kMissingArc) return;
    for (const Chain& chain : chains_) {
      if (chain.is_new && chain.share > 0 && chain.cost == best_cost_) ++hits_;
    }
  }

  /// Makes the best tour the best that can be put together from all.
  void recombine() {
    if (setup_.stop.reached(0, 0)) return;
    for (const Chain& chain : chains_) {
      if (pool_.size() >= kPool) pool_.erase(pool_.begin());
      pool_.push_back(chain.tour);
    }
    problem_.with_costs([&](const auto& costs) {
      Recombiner recombiner(problem_, costs);
      for (Cost gain = -1; gain < 0;) {
        gain = 0;
        for (const std::vector<int>& other : pool_) gain += recombiner.improve(best_, other);
        if (gain == 0) break;
        best_cost_ += gain;
        hits_ = 0;
        is_better_ = true;
      }
    });
    report_(0, best_, 0);
  }

  Rng chain_rng(int round, int chain) const {
    return rng_.split(static_cast<std::uint64_t>(round) * kChains + static_cast<std::uint64_t>(chain));
  }

  /// Along the tree over the points, or else in random order: local search does not need more, unless arcs
  /// are missing; clusters are then put in where they fit, in random order.
  std::vector<int> new_tour(Rng rng) const {
    const int m = problem_.cluster_count();
    std::vector<int> tour;
    if (tree_) {
      std::vector<char> is_in(at(m), 0);
      for (const int v : tree_->order()) {
        if (std::exchange(is_in[at(problem_.cluster_of(v))], 1) == 0) tour.push_back(v);
      }
      return tour;
    }
    for (int c = 0; c < m; ++c) {
      const auto size = static_cast<std::uint64_t>(problem_.cluster_size(c));
      tour.push_back(problem_.first(c) + static_cast<int>(rng.below(size)));
    }
    for (std::size_t i = tour.size(); i > 1; --i)
      std::swap(tour[i - 1], tour[static_cast<std::size_t>(rng.below(i))]);
    return problem_.has_missing() && m <= kMostPutTogether ? put_together(tour) : tour;
  }

  /// The clusters of the tour's vertices, each put in after those before it.
  std::vector<int> put_together(const std::vector<int>& tour) const {
    std::vector<int> clusters;
    for (std::size_t i = 1; i < tour.size(); ++i) clusters.push_back(problem_.cluster_of(tour[i]));
    std::vector<int> together{tour.front()};
    insert_all(problem_, clusters, together);
    return together;
  }

  void run_round(int round) {
    const double begin_s = now_s();
    const bool is_timed = setup_.stop.clock != nullptr && std::isfinite(setup_.stop.deadline_s);
    const auto run_one = [&](int i) {
      if ((round > 0 || i > 0) && chains_[at(i)].share == 0) return;
      problem_.with_costs([&](const auto& costs) { run_chain(round, i, costs); });
    };
    const bool is_parallel = setup_.threads > 1;
    chains_[0].end_s = is_timed && !is_parallel && chains_[1].share > 0
                           ? (begin_s + setup_.stop.deadline_s) / 2.0
                           : setup_.stop.deadline_s;
    chains_[1].end_s = setup_.stop.deadline_s;
    if (is_parallel) {
      const std::jthread other([&] { run_one(1); });
      run_one(0);
    } else {
      run_one(0);
      if (!setup_.stop.reached(0, 0)) run_one(1);
    }
  }

  double now_s() const { return setup_.stop.clock != nullptr ? setup_.stop.clock->now_s() : 0.0; }

  template <class Costs>
  void run_chain(int round, int index, const Costs& costs) {
    Chain& chain = chains_[at(index)];
    const double begin_s = now_s();
    const auto progress = [&](std::uint64_t kicks) {
      if (setup_.stop.reached(0, 0)) return 1.0;
      const double by_work =
          static_cast<double>(kicks) / static_cast<double>(std::max<std::uint64_t>(1, chain.share));
      if (setup_.stop.clock == nullptr || std::isinf(chain.end_s)) return by_work;
      return std::max(by_work, (now_s() - begin_s) / (chain.end_s - begin_s));
    };
    Annealer<Costs> annealer(problem_, candidates_[at(index)], costs, chain_rng(round, index));
    const Schedule schedule{is_kicked() ? chain.share : 0, setup_.start.empty() ? kHot : kWarmHot,
                            std::min(kCold, setup_.start.empty() ? kHot : kWarmHot)};
    chain.kicks += annealer.run(chain.tour, schedule, progress,
                                [&](const std::vector<int>& tour, Cost cost, std::uint64_t kicks) {
                                  chain.cost = cost;
                                  report_(index, tour, kicks);
                                });
  }

  const Problem& problem_;
  const ChainSetup& setup_;
  const ChainReport& report_;
  Rng rng_;
  std::unique_ptr<PointTree> tree_;
  std::vector<Candidates> candidates_;
  std::array<Chain, kChains> chains_;
  std::vector<std::vector<int>> pool_;
  std::vector<int> best_;
  Cost best_cost_ = std::numeric_limits<Cost>::max();
  bool is_better_ = false;  ///< than before the last round
  int hits_ = 0;            ///< chains that reached the best cost from nothing
};

}  // namespace

std::uint64_t run_chains(const Problem& problem, const ChainSetup& setup, const ChainReport& report) {
  return Rounds(problem, setup, report).run();
}

}  // namespace swallowtail::gtsp::search
