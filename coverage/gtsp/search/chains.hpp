#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "coverage/gtsp/search/problem.hpp"
#include "planner/base/stop.hpp"

namespace swallowtail::gtsp::search {

/// Chains of annealing that run side by side, on as many threads as are given: the result is the same
/// whatever their number, as long as no clock ends it.
inline constexpr int kChains = 2;

struct ChainSetup {
  std::uint64_t seed = 1;
  int threads = 1;
  std::uint64_t kicks = 0;  ///< of all chains and rounds together
  /// The search ends when so many chains, each begun from nothing, have ended at the best cost.
  int enough_hits = std::numeric_limits<int>::max();
  StopCondition stop = {};
  std::vector<int> start = {};  ///< a tour of all clusters to begin from; empty: from nothing
};

/// Given a chain, its best tour so far and the kicks it took in this round; called from the chain's thread.
using ChainReport = std::function<void(int, const std::vector<int>&, std::uint64_t)>;

/// Minimises tours of the problem, missing arcs before cost. Rounds of annealing, each twice as long as the
/// one before until a chain meets the best cost from nothing, so that an easy instance is solved at once and
/// a hard one gets most of the work in a few long runs [LUBY-SINCLAIR-ZUCKERMAN]; of thousands of clusters
/// all rounds are long. The first chain goes on from the best tour, the other from its own; where tours are
/// short the other begins anew each round, and so does the first once it no longer gets better. While the
/// best tour lacks arcs, both go on from what they have. Fewer than kLeastKicked clusters are only searched
/// locally, from many orders. Returns the kicks.
std::uint64_t run_chains(const Problem& problem, const ChainSetup& setup, const ChainReport& report);

inline constexpr int kLeastKicked = 8;

}  // namespace swallowtail::gtsp::search
